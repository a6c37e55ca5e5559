//! Every figure of the gallery, in the order of the page.

mod asperity;
mod cochran;
mod cohen;
mod kautz;
mod ndf;
mod nilsson;
mod noise;
mod scenes;

use crate::gallery::figure::Figure;

/// The figures by source, in the order of their pages.
const FIGURES: &[&[Figure]] = &[
    &[
        Figure { name: "kautz-1-sphere", draw: kautz::sphere::draw },
        Figure { name: "kautz-2-ndf", draw: kautz::ndf::draw },
        Figure { name: "kautz-3-pipeline", draw: kautz::pipeline::draw },
        Figure { name: "kautz-4-teapot", draw: kautz::teapot::draw },
        Figure { name: "kautz-5-isotropic", draw: kautz::isotropic::draw },
    ],
    &[
        Figure { name: "cochran-1-functions", draw: cochran::curves::draw_functions },
        Figure { name: "cochran-2-contractions", draw: cochran::contractions::draw },
        Figure { name: "cochran-3-integrals", draw: cochran::curves::draw_integrals },
        Figure { name: "cochran-3-second-integrals", draw: cochran::second_integrals::draw },
        Figure { name: "cochran-dimension", draw: cochran::dimension::draw },
        Figure { name: "cochran-4-bounds", draw: cochran::bounds::draw_bounds },
        Figure { name: "cochran-4-descent", draw: cochran::bounds::draw_descent },
        Figure { name: "cochran-6-mirrors", draw: cochran::mirrors::draw },
        Figure { name: "cochran-7-corner", draw: cochran::corner::draw },
        Figure { name: "cochran-models", draw: cochran::models::draw },
        Figure { name: "cochran-zoom", draw: cochran::zoom::draw },
        Figure { name: "cochran-landscape", draw: cochran::landscape::draw },
        Figure { name: "cochran-area", draw: cochran::area::draw },
    ],
    &[
        Figure { name: "asperity-mean-radiance", draw: asperity::mean_radiance::draw },
        Figure { name: "asperity-zoom-means", draw: asperity::zoom_means::draw },
        Figure { name: "asperity-horizon", draw: asperity::horizon::draw },
        Figure { name: "asperity-normal-map-antialiasing", draw: asperity::normal_maps::draw },
    ],
    &[Figure { name: "shading-reflectance", draw: asperity::reflectance::draw }],
    &[
        Figure { name: "cohen-bump-mapping", draw: cohen::bump::draw },
        Figure { name: "cohen-brick", draw: cohen::brick::draw },
        Figure { name: "cohen-bevel", draw: cohen::bevel::draw },
        Figure { name: "cohen-wallpaper", draw: cohen::patterns::draw },
        Figure { name: "cohen-marble-colours", draw: cohen::patterns::draw_marble },
        Figure { name: "cohen-marble-vase", draw: cohen::still_lifes::draw_vase },
        Figure { name: "cohen-tea-cup", draw: cohen::still_lifes::draw_cup },
        Figure { name: "cohen-walls", draw: scenes::draw_walls },
    ],
    &[Figure { name: "asperity-teapots", draw: scenes::draw_teapots }],
    &[
        Figure { name: "nilsson-prng", draw: nilsson::prng::draw },
        Figure { name: "nilsson-car", draw: scenes::draw_car },
        Figure { name: "nilsson-carpet-room", draw: scenes::draw_room },
    ],
    &[
        Figure { name: "nilsson-zoom", draw: nilsson::zoom::draw },
        Figure { name: "nilsson-carpet-sliders", draw: nilsson::sliders::carpet },
        Figure { name: "nilsson-paint-sliders", draw: nilsson::sliders::paint },
        Figure { name: "nilsson-glass-sliders", draw: nilsson::sliders::glass },
        Figure { name: "nilsson-variation-sliders", draw: nilsson::sliders::variations },
        Figure { name: "nilsson-scratch-sliders", draw: nilsson::sliders::scratches },
        Figure { name: "nilsson-fibre-sliders", draw: nilsson::sliders::fibres },
    ],
    ndf::densities::DENSITIES,
    &[
        Figure { name: "ndf-masking", draw: ndf::masking::draw },
        Figure { name: "ndf-conditional", draw: ndf::conditional::draw },
    ],
    &[Figure { name: "ndf-table-l", draw: ndf::table::draw }],
    &[
        Figure { name: "ndf-map-detail", draw: ndf::bump_maps::draw_detail },
        Figure { name: "ndf-map-estimate", draw: ndf::bump_maps::draw_estimate },
    ],
    noise::kinds::KINDS,
    &[
        Figure { name: "noise-sum-patterns", draw: noise::patterns::draw },
        Figure { name: "noise-sum-slope", draw: noise::slope::draw },
        Figure { name: "noise-sum-footprint", draw: noise::footprint::draw },
    ],
    &[
        Figure { name: "noise-gradients", draw: noise::gradients::draw },
        Figure { name: "noise-warp", draw: noise::warp::draw },
        Figure { name: "noise-curl", draw: noise::curl::draw },
        Figure { name: "noise-tiled", draw: noise::tiled::draw },
    ],
];

/// Every figure, in the order of the pages.
pub(crate) fn figures() -> Vec<&'static Figure> {
    FIGURES.iter().copied().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::captions::captions;

    #[test]
    fn every_figure_has_its_words_and_no_words_are_left_over() {
        let words = captions();
        for figure in figures() {
            let caption = words.of(figure.name).unwrap();
            let texts = [caption.page, caption.section, caption.title, caption.source, &caption.text];
            assert!(texts.iter().all(|text| !text.is_empty() && !text.contains('#')), "{}", figure.name);
        }
        assert_eq!(words.figures.len(), figures().len());
        assert_eq!(words.pages[0].title, "Asperity");
        assert!(words.pages.iter().all(|page| page.about.ends_with('.')));
    }

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
        let page = include_str!("../../../../docs/coverage.md");
        let pictures = names(page, |row| row.rsplit('|').next());
        assert!(pictures.len() > 50);
        for name in pictures {
            assert!(figures().iter().any(|figure| is_of(&name, figure)), "{name}");
        }
    }

    #[test]
    fn the_review_has_a_line_for_every_figure_and_no_other() {
        let reviewed = names(include_str!("../../../../docs/gallery-review.md"), |row| row.split('|').next());
        for name in &reviewed {
            assert!(figures().iter().any(|figure| is_of(name, figure)), "{name} is no figure");
        }
        for figure in figures() {
            assert!(reviewed.iter().any(|name| is_of(name, figure)), "{} has no line", figure.name);
        }
    }
}
