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
        kautz::sphere::SPHERE,
        kautz::ndf::NDF,
        kautz::pipeline::PIPELINE,
        kautz::teapot::TEAPOT,
        kautz::isotropic::ISOTROPIC,
    ],
    &[
        cochran::curves::FUNCTIONS,
        cochran::contractions::CONTRACTIONS,
        cochran::curves::INTEGRALS,
        cochran::second_integrals::SECOND_INTEGRALS,
        cochran::dimension::DIMENSION,
        cochran::bounds::BOUNDS,
        cochran::bounds::DESCENT,
        cochran::mirrors::MIRRORS,
        cochran::corner::CORNER,
        cochran::models::MODELS,
        cochran::zoom::ZOOM,
        cochran::landscape::LANDSCAPE,
        cochran::area::AREA,
    ],
    &[
        asperity::mean_radiance::MEAN_RADIANCE,
        asperity::zoom_means::ZOOM_MEANS,
        asperity::horizon::HORIZON,
        asperity::normal_maps::ANTIALIASING,
    ],
    &[asperity::reflectance::REFLECTANCE],
    &[
        cohen::bump::BUMP,
        cohen::brick::BRICK,
        cohen::bevel::BEVEL,
        cohen::patterns::PATTERNS,
        cohen::patterns::SPECTRUM,
        cohen::still_lifes::VASE,
        cohen::still_lifes::CUP,
        scenes::WALLS,
    ],
    &[scenes::TEAPOTS],
    &[nilsson::prng::PRNG, scenes::CAR, scenes::ROOM],
    &[
        nilsson::zoom::ZOOM,
        nilsson::sliders::CARPET,
        nilsson::sliders::PAINT,
        nilsson::sliders::GLASS,
        nilsson::sliders::VARIATIONS,
        nilsson::sliders::SCRATCHES,
        nilsson::sliders::FIBRES,
    ],
    ndf::densities::DENSITIES,
    &[ndf::masking::MASKING, ndf::conditional::CONDITIONAL],
    &[ndf::table::TABLE],
    &[ndf::bump_maps::DETAIL, ndf::bump_maps::ESTIMATE],
    noise::kinds::KINDS,
    &[noise::patterns::PATTERNS, noise::slope::SLOPE, noise::footprint::FOOTPRINT],
    &[noise::gradients::GRADIENTS, noise::warp::WARP, noise::curl::CURL, noise::tiled::TILED],
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
        let page = include_str!("../../../../docs/coverage.md");
        let pictures = names(page, |row| row.rsplit('|').next());
        assert!(pictures.len() > 50);
        for name in pictures {
            assert!(figures().any(|figure| is_of(&name, figure)), "{name}");
        }
    }

    #[test]
    fn the_review_has_a_line_for_every_figure_and_no_other() {
        let reviewed = names(include_str!("../../../../docs/gallery-review.md"), |row| row.split('|').next());
        for name in &reviewed {
            assert!(figures().any(|figure| is_of(name, figure)), "{name} is no figure");
        }
        for figure in figures() {
            assert!(reviewed.iter().any(|name| is_of(name, figure)), "{} has no line", figure.name);
        }
    }
}
