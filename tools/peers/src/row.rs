//! The rows of the comparison: evaluation form, dimension, noise.

use std::fmt;

/// Order of evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    /// A whole grid per call.
    Grid,
    /// Arbitrary points per call, structure of arrays.
    Points,
    /// One arbitrary point per call.
    Calls,
}

/// The type of noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Gradient noise of 2002.
    Perlin,
    /// Value noise.
    Value,
    /// Simplex noise.
    Simplex,
    /// Five unrotated octaves of gradient noise, lacunarity 2, gain 0.5.
    Fbm,
    /// Cellular noise: the Euclidean distance to the nearest feature point.
    Cellular,
}

/// A row of the comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Row {
    pub(crate) order: Order,
    /// Whether gradients are computed in addition to the values.
    pub(crate) gradients: bool,
    pub(crate) dimension: u8,
    pub(crate) kind: Kind,
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let form = match (self.order, self.gradients) {
            (Order::Grid, false) => "fill_grid",
            (Order::Grid, true) => "fill_grid_with_gradients",
            (Order::Points, false) => "fill_points",
            (Order::Points, true) => "fill_points_with_gradients",
            (Order::Calls, false) => "value",
            (Order::Calls, true) => "sample",
        };
        let kind = match self.kind {
            Kind::Perlin => "perlin-2002",
            Kind::Value => "value-quintic",
            Kind::Simplex => "simplex-continuous",
            Kind::Fbm => "perlin-2002-octaves-5",
            Kind::Cellular => "cellular-f1",
        };
        write!(f, "{form}/{}-d/{kind}", self.dimension)
    }
}

/// Returns every row, in table order.
pub(crate) fn all() -> Vec<Row> {
    let mut rows = Vec::new();
    for (order, dimensions, kinds) in [
        (Order::Grid, 2..=3, &[Kind::Perlin, Kind::Value, Kind::Simplex, Kind::Fbm, Kind::Cellular][..]),
        (Order::Points, 2..=3, &[Kind::Perlin, Kind::Simplex]),
        (Order::Calls, 2..=4, &[Kind::Value, Kind::Perlin, Kind::Simplex]),
    ] {
        for gradients in [false, true] {
            for &kind in kinds {
                rows.extend(dimensions.clone().map(|dimension| Row { order, gradients, dimension, kind }));
            }
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn row_names_are_unique() {
        let mut names: Vec<_> = all().iter().map(Row::to_string).collect();
        assert!(names.contains(&"fill_grid/3-d/perlin-2002".to_owned()), "{names:?}");
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{names:?}");
    }
}
