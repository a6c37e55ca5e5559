//! Every figure of the gallery, in page order.

mod asperity;
mod cochran;
mod cohen;
mod kautz;
mod ndf;
mod nilsson;
mod noise;
mod scenes;

use crate::figure::{Figure, figure};

/// The figures in page order. Lists of figures of one type are in separate files.
const FIGURES: &[&[Figure]] = &[
    &[
        figure("kautz-1-sphere", kautz::objects::draw_sphere),
        figure("kautz-2-ndf", kautz::ndf::draw),
        figure("kautz-3-pipeline", kautz::objects::draw_pipeline),
        figure("kautz-4-teapot", kautz::objects::draw_teapot),
        figure("kautz-5-isotropic", kautz::objects::draw_isotropic),
        figure("cochran-1-functions", cochran::curves::draw_functions),
        figure("cochran-2-contractions", cochran::bounds::draw_contractions),
        figure("cochran-3-integrals", cochran::curves::draw_integrals),
        figure("cochran-3-second-integrals", cochran::curves::draw_second_integrals),
        figure("cochran-dimension", cochran::curves::draw_dimension),
        figure("cochran-4-bounds", cochran::bounds::draw_bounds),
        figure("cochran-4-descent", cochran::bounds::draw_descent),
        figure("cochran-5-orders", cochran::orders::draw),
        figure("cochran-6-mirrors", cochran::mirrors::draw),
        figure("cochran-7-corner", cochran::corner::draw),
        figure("cochran-models", cochran::models::draw),
        figure("cochran-zoom", cochran::zoom::draw),
        figure("cochran-landscape", cochran::landscape::draw),
        figure("cochran-area", cochran::area::draw),
        figure("asperity-height-bumps", asperity::height_bumps::draw),
        figure("asperity-mean-radiance", asperity::mean_radiance::draw),
        figure("asperity-zoom-means", asperity::measured::draw_means),
        figure("asperity-microfacet-zoom", asperity::visible_zoom::draw),
        figure("asperity-furnace", asperity::furnace::draw),
        figure("asperity-fuzz", asperity::fuzz::draw),
        figure("asperity-standard-material", asperity::standard_material::draw),
        figure("asperity-glints", asperity::glints::draw),
        figure("asperity-horizon", asperity::measured::draw_horizon),
        figure("asperity-normal-map-antialiasing", asperity::normal_maps::draw),
        figure("gpu-teapot", asperity::graphics_card::draw_teapot),
        figure("gpu-plane", asperity::graphics_card::draw_plane),
        figure("gpu-textured", asperity::graphics_card::draw_textured),
        figure("gpu-materials", asperity::graphics_card::draw_materials),
        figure("shading-reflectance", asperity::reflectance::draw),
        figure("cohen-bump-mapping", cohen::bumps::draw_bumps),
        figure("cohen-brick", cohen::bumps::draw_brick),
        figure("cohen-bevel", cohen::bumps::draw_bevel),
        figure("cohen-wallpaper", cohen::patterns::draw),
        figure("cohen-marble-colors", cohen::patterns::draw_marble),
        figure("cohen-marble-vase", cohen::still_lifes::draw_vase),
        figure("cohen-tea-cup", cohen::still_lifes::draw_cup),
        figure("cohen-walls", scenes::draw_walls),
        figure("asperity-teapots", scenes::draw_teapots),
        figure("nilsson-prng", nilsson::prng::draw),
        figure("nilsson-car", scenes::draw_car),
        figure("nilsson-carpet-room", scenes::draw_room),
        figure("nilsson-zoom", nilsson::zoom::draw),
    ],
    nilsson::sliders::SLIDERS,
    ndf::densities::DENSITIES,
    &[
        figure("ndf-masking", ndf::masking::draw),
        figure("ndf-conditional", ndf::conditional::draw),
        figure("ndf-table-l", ndf::table::draw),
        figure("ndf-map-detail", ndf::bump_maps::draw_detail),
        figure("ndf-map-estimate", ndf::bump_maps::draw_estimate),
    ],
    noise::kinds::KINDS,
    &[
        figure("noise-cellular", noise::cellular::draw),
        figure("noise-sum-patterns", noise::patterns::draw),
        figure("noise-sum-slope", noise::slope::draw),
        figure("noise-sum-footprint", noise::footprint::draw),
        figure("noise-gradients", noise::gradients::draw),
        figure("noise-warp", noise::gradients::draw_warp),
        figure("noise-curl", noise::curl::draw),
        figure("noise-tiled", noise::patterns::draw_tiles),
    ],
];

/// Returns every figure, in page order.
pub(crate) fn figures() -> Vec<&'static Figure> {
    FIGURES.iter().copied().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::captions::CAPTIONS;

    #[test]
    fn every_figure_has_texts_and_no_text_is_unused() {
        for figure in figures() {
            let caption = CAPTIONS.of(figure.name).unwrap();
            let texts = [caption.page, caption.section, caption.title, caption.source, &caption.text];
            assert!(texts.iter().all(|text| !text.is_empty() && !text.contains('#')), "{}", figure.name);
        }
        assert_eq!(CAPTIONS.figures.len(), figures().len());
        assert_eq!(CAPTIONS.pages[0].title, "Asperity");
        assert!(CAPTIONS.pages.iter().all(|page| page.about.ends_with('.')));
    }

    /// Returns the words in backticks of the last cell, for every row of a page's tables.
    fn last_names(page: &str) -> Vec<&str> {
        let rows = page.lines().filter(|line| line.starts_with('|'));
        let cells = rows.filter_map(|row| row.trim_matches('|').rsplit('|').next());
        cells.flat_map(|cell| cell.split('`').skip(1).step_by(2)).collect()
    }

    /// Whether a name, or a pattern with a star, matches a figure.
    fn is_of(name: &str, figure: &Figure) -> bool {
        name.split_once('*').map_or(figure.name == name, |(start, end)| {
            figure.name.starts_with(start) && figure.name.ends_with(end)
        })
    }

    #[test]
    fn coverage_page_names_existing_figures() {
        let page = include_str!("../../../../docs/coverage.md");
        let pictures = last_names(page);
        assert!(pictures.len() > 50);
        for name in &pictures {
            assert!(figures().iter().any(|figure| is_of(name, figure)), "{name} is not a figure");
        }
    }
}
