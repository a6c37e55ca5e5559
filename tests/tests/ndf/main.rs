//! Normal densities: properties, references, statistics and pinned values.

mod bad_input;
mod batch;
mod checked;
mod compared;
mod conditional;
mod conditional_table;
mod detail;
mod exact_map;
mod facet_chi_square;
mod facet_maps;
mod facet_reference;
mod frame;
mod gaussian_maps;
mod golden;
mod golden_facets;
mod golden_tables;
mod map_chi_square;
mod marginals;
mod noise_cdf;
mod normal_table;
mod packed_map;
mod reflecting;
mod table_variation;
mod visible;
mod visible_facets;
