//! Every figure of the gallery, in the order of the page.

mod asperity_horizon;
mod asperity_mean_radiance;
mod asperity_normal_maps;
mod asperity_zoom_means;
mod cochran_area;
mod cochran_bounds;
mod cochran_contractions;
mod cochran_corner;
mod cochran_curves;
mod cochran_dimension;
mod cochran_landscape;
mod cochran_mirrors;
mod cochran_models;
mod cochran_second_integrals;
mod cochran_zoom;
mod cohen_bevel;
mod cohen_brick;
mod cohen_bump;
mod cohen_patterns;
mod cohen_still_lifes;
mod kautz_isotropic;
mod kautz_ndf;
mod kautz_pipeline;
mod kautz_sphere;
mod kautz_teapot;
mod ndf_bump_maps;
mod ndf_conditional;
mod ndf_densities;
mod ndf_masking;
mod ndf_table;
mod nilsson_prng;
mod nilsson_sliders;
mod nilsson_zoom;
mod noise_curl;
mod noise_footprint;
mod noise_gradients;
mod noise_kinds;
mod noise_patterns;
mod noise_plane;
mod noise_slope;
mod noise_tiled;
mod noise_warp;
mod panels;
mod power_spectrum;
mod scenes;
mod shading_reflectance;

use crate::figure::Figure;

/// The figures by source, in the order of their pages.
const FIGURES: &[&[Figure]] = &[
    &[
        kautz_sphere::SPHERE,
        kautz_ndf::NDF,
        kautz_pipeline::PIPELINE,
        kautz_teapot::TEAPOT,
        kautz_isotropic::ISOTROPIC,
    ],
    &[
        cochran_curves::FUNCTIONS,
        cochran_contractions::CONTRACTIONS,
        cochran_curves::INTEGRALS,
        cochran_second_integrals::SECOND_INTEGRALS,
        cochran_dimension::DIMENSION,
        cochran_bounds::BOUNDS,
        cochran_bounds::DESCENT,
        cochran_mirrors::MIRRORS,
        cochran_corner::CORNER,
        cochran_models::MODELS,
        cochran_zoom::ZOOM,
        cochran_landscape::LANDSCAPE,
        cochran_area::AREA,
    ],
    &[
        asperity_mean_radiance::MEAN_RADIANCE,
        asperity_zoom_means::ZOOM_MEANS,
        asperity_horizon::HORIZON,
        asperity_normal_maps::ANTIALIASING,
    ],
    &[shading_reflectance::REFLECTANCE],
    &[
        cohen_bump::BUMP,
        cohen_brick::BRICK,
        cohen_bevel::BEVEL,
        cohen_patterns::PATTERNS,
        cohen_patterns::SPECTRUM,
        cohen_still_lifes::VASE,
        cohen_still_lifes::CUP,
        scenes::WALLS,
    ],
    &[scenes::TEAPOTS],
    &[nilsson_prng::PRNG, scenes::CAR, scenes::ROOM],
    &[
        nilsson_zoom::ZOOM,
        nilsson_sliders::CARPET,
        nilsson_sliders::PAINT,
        nilsson_sliders::GLASS,
        nilsson_sliders::VARIATIONS,
        nilsson_sliders::SCRATCHES,
        nilsson_sliders::FIBRES,
    ],
    ndf_densities::DENSITIES,
    &[ndf_masking::MASKING, ndf_conditional::CONDITIONAL],
    &[ndf_table::TABLE],
    &[ndf_bump_maps::DETAIL, ndf_bump_maps::ESTIMATE],
    noise_kinds::KINDS,
    &[noise_patterns::PATTERNS, noise_slope::SLOPE, noise_footprint::FOOTPRINT],
    &[noise_gradients::GRADIENTS, noise_warp::WARP, noise_curl::CURL, noise_tiled::TILED],
];

/// Every figure, in the order of the pages.
pub(crate) fn figures() -> impl Iterator<Item = &'static Figure> {
    FIGURES.iter().copied().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The words in backticks of a cell of every row of a page's tables: the first one, or the last.
    fn names(page: &str, cell: fn(&str) -> Option<&str>) -> Vec<String> {
        let rows = page.lines().filter(|line| line.starts_with('|'));
        let cells = rows.filter_map(|row| cell(row.trim_matches('|')));
        cells
            .flat_map(|cell| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>())
            .collect()
    }

    /// Whether a name, or a family with a star in its name, is a figure's.
    fn is_of(name: &str, figure: &Figure) -> bool {
        match name.split_once('*') {
            Some((start, end)) => figure.name.starts_with(start) && figure.name.ends_with(end),
            None => figure.name == name,
        }
    }

    #[test]
    fn the_coverage_page_names_pictures_that_there_are() {
        let page = include_str!("../../../docs/coverage.md");
        let pictures = names(page, |row| row.rsplit('|').next());
        assert!(pictures.len() > 50);
        for name in pictures {
            assert!(figures().any(|figure| is_of(&name, figure)), "{name}");
        }
    }

    #[test]
    fn the_review_has_a_line_for_every_figure_and_no_other() {
        let reviewed = names(include_str!("../../../docs/gallery-review.md"), |row| row.split('|').next());
        for name in &reviewed {
            assert!(figures().any(|figure| is_of(name, figure)), "{name} is no figure");
        }
        for figure in figures() {
            assert!(reviewed.iter().any(|name| is_of(name, figure)), "{} has no line", figure.name);
        }
    }
}
