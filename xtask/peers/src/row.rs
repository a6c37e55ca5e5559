//! The rows of the comparison: a form of evaluation, a dimension, a kind of noise.

use std::fmt;

/// Calling form: point by point, a grid, a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Values on a grid.
    Grid,
    /// Values and gradients on a grid.
    GridGradients,
    /// Values at arbitrary points, structure of arrays.
    Points,
    /// Values and gradients at arbitrary points, structure of arrays.
    PointsGradients,
    /// One value per call.
    Calls,
    /// One value and gradient per call.
    CallsGradients,
}

/// The kind of noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Gradient noise of 2002.
    Perlin,
    /// Value noise.
    Value,
    /// Simplex noise.
    Simplex,
    /// Five unrotated octaves of gradient noise, lacunarity 2, gain 0.5.
    Octaves,
}

/// One line of the comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Row {
    pub(crate) form: Form,
    pub(crate) dimension: u8,
    pub(crate) kind: Kind,
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let form = match self.form {
            Form::Grid => "fill_grid",
            Form::GridGradients => "fill_grid_with_gradients",
            Form::Points => "fill_points",
            Form::PointsGradients => "fill_points_with_gradients",
            Form::Calls => "value",
            Form::CallsGradients => "sample",
        };
        let kind = match self.kind {
            Kind::Perlin => "perlin-2002",
            Kind::Value => "value-quintic",
            Kind::Simplex => "simplex-continuous",
            Kind::Octaves => "perlin-2002-octaves-5",
        };
        write!(f, "{form}/{}-d/{kind}", self.dimension)
    }
}

/// Every row, in the order of the table.
pub(crate) fn all() -> Vec<Row> {
    let mut rows = Vec::new();
    let mut add = |form, dimensions: &[u8], kinds: &[Kind]| {
        for &kind in kinds {
            rows.extend(dimensions.iter().map(|&dimension| Row { form, dimension, kind }));
        }
    };
    let every = [Kind::Perlin, Kind::Value, Kind::Simplex, Kind::Octaves];
    add(Form::Grid, &[2, 3], &every);
    add(Form::GridGradients, &[2, 3], &every);
    for form in [Form::Points, Form::PointsGradients] {
        add(form, &[2, 3], &[Kind::Perlin, Kind::Simplex]);
    }
    for form in [Form::Calls, Form::CallsGradients] {
        add(form, &[2, 3, 4], &[Kind::Value, Kind::Perlin, Kind::Simplex]);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_has_a_name_of_its_own() {
        let mut names: Vec<_> = all().iter().map(Row::to_string).collect();
        assert!(names.contains(&"fill_grid/3-d/perlin-2002".to_owned()), "{names:?}");
        names.sort_unstable();
        let count = names.len();
        names.dedup();
        assert_eq!(names.len(), count);
    }
}
