//! Error for invalid systems of maps, and the checks.

use asperity_core::error_enum;

/// An end of the interval of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// `x_{j−1}`, the image of `x_0`.
    Left,
    /// `x_j`, the image of `x_N`.
    Right,
}

error_enum! {
    /// Error of every function of this crate: what is invalid, its value and the rule.
    ///
    /// Maps are counted from 1, as in the literature. Knots, points, powers, cells and nodes are
    /// counted from 0.
    pub enum FifError {
        /// A list is too short.
        TooFew { parameter: &'static str, min: usize, got: usize } =>
            "`{parameter}` must have at least {min} elements, got {got}";
        /// The length of a list does not match another parameter.
        Length { parameter: &'static str, expected: usize, got: usize } =>
            "`{parameter}` must have {expected} elements, got {got}";
        /// A number is outside its range.
        OutOfRange { parameter: &'static str, value: usize, min: usize, max: usize } =>
            "`{parameter}` must be between {min} and {max}, got {value}";
        /// A knot, an ordinate or a slope is NaN or infinite.
        NotFinite { parameter: &'static str, index: usize, value: f64 } =>
            "`{parameter}[{index}]` must be finite, got {value}";
        /// A knot is not to the right of the previous one.
        KnotOrder { knot: usize, left: f64, right: f64 } => "knots must be strictly increasing: `x[{knot}]` = {right} follows {left}";
        /// A cell is narrower than 2⁻¹⁰⁰⁰ of the domain.
        NarrowCell { map: usize, width: f64, domain: f64 } =>
            "cell is too narrow: `x[{map}]` - `x[{}]` = {width:e} (at least {:e})",
            map.saturating_sub(1), domain * NARROWEST;
        /// A vertical scaling is not in `(−1, 1)`.
        Scaling { map: usize, alpha: f64 } => "`alpha` of map {map} must be in (-1, 1), got {alpha}";
        /// A vertical scaling is too large for a continuous derivative, `|α_j| ≥ a_j`.
        SteepScaling { map: usize, alpha: f64, a: f64 } =>
            "`alpha` of map {map} must be under {a} in magnitude, got {alpha}";
        /// A coefficient of a polynomial is NaN or infinite.
        Coefficient { map: usize, power: usize, value: f64 } =>
            "`q` of map {map} must have a finite coefficient of x^{power}, got {value}";
        /// The polynomials need more coefficients than their type has.
        Coefficients { expected: usize, got: usize } => "`C` must be at least {expected}, got {got}";
        /// A map does not send an end of the graph to a knot: the ordinate is `got` instead of
        /// `expected`.
        JoinUp { map: usize, end: End, expected: f64, got: f64 } =>
            "`q` of map {map} must send the {} end to {expected}, got {got}",
            if end == End::Left { "left" } else { "right" };
        /// The image of a map does not begin where the previous one ends, or the last does not end
        /// at the end of the domain.
        Tiling { map: usize, expected: f64, got: f64 } =>
            "`maps` must tile the domain, map {map} at {expected}, got {got}";
        /// No finite bound of the function could be proved.
        ///
        /// The numbers or the width of their range overflow, or the largest `|α_j|` is a rounding
        /// error from 1.
        Unbounded { alpha: f64 } => "`alpha` and `q` are too large for a finite bound: largest factor {alpha}";
        /// A grid needs equally spaced knots.
        UnequalKnots => "`x` must be equally spaced, got unequal knots";
        /// The number of cells of a grid, one less than its nodes, is not a power of the number of
        /// maps.
        GridLength { maps: usize, got: usize } =>
            "`out` must have one element more than a power of {maps}, got {got}";
        /// A table with an error under the tolerance would need more steps per evaluation.
        TableDepth { alpha: f64, steps: u32, bound: f64 } =>
            "`alpha` is too close to 1 for the tolerance: {alpha} leaves {bound:e} after {steps} composites";
        /// A source of a recurrent system does not go from a knot to a later knot; `last` is the
        /// last knot.
        Source { map: usize, from: usize, to: usize, last: usize } =>
            "`sources` of map {map} must increase within 0 to {last}, got {from} to {to}";
        /// A source of a recurrent system is not wider than its image.
        Expansion { map: usize, source: f64, image: f64 } =>
            "`sources` of map {map} must be wider than its image of {image}, got {source}";
        /// The knots of a fit are not increasing indices of three or more points, from the first to
        /// the last.
        ///
        /// Entry `at` is `index`, or the number of points if it is missing.
        FitKnots { at: usize, index: usize } =>
            "`knots[{at}]` must increase from the first point to the last, at least three, got {index}";
        /// A tolerance is NaN or negative.
        Tolerance { value: f64 } => "`tolerance` must be at least 0, got {value}";
        /// The degree of an integrand is too high, e.g. `k + p (C − 1)` of `xᵏ fᵖ`.
        Degree { parameter: &'static str, max: usize, got: usize } =>
            "degree of {parameter} must be at most {max}, got {got}";
        /// A knot or the scaling of a map differs between two systems that are combined.
        Unequal { parameter: &'static str, index: usize, left: f64, right: f64 } =>
            "`other` must have {parameter} {index} at {left}, got {right}";
        /// The number of nodes along a side of a periodic surface is not a power of two between 2
        /// and 2¹⁵.
        Side { value: usize } => "`side` must be a power of two from 2 to 32768, got {value}";
        /// The matrix of a periodic surface creates fewer than two replicas, `|det M| < 2`.
        Determinant { value: i64 } => "`matrix` must have a determinant of magnitude at least 2, got {value}";
        /// A knot of an axis is NaN or infinite, or not greater than the previous one by more than
        /// the rounding of the domain.
        NotIncreasing { parameter: &'static str, index: usize, value: f64 } =>
            "`{parameter}[{index}]` must be finite and greater than the previous knot, got {value}";
        /// The vertical scaling of a surface is NaN or too large for slopes to converge.
        ///
        /// `|s| ‖M‖₂ ≥ 1` for a periodic surface, at least the fraction of the narrowest cell on a
        /// folded grid.
        SurfaceScaling { value: f64, max: f64 } => "`scaling` must be under {max} in magnitude, got {value}";
        /// The vertical scaling at a node is NaN or at least 1 in magnitude, so values do not
        /// converge.
        NodeScaling { node: [usize; 2], value: f64 } =>
            "`scaling` must be under 1 in magnitude, got {value} at node ({}, {})", node[0], node[1];
        /// A height or a component of a gradient is NaN or infinite.
        NodeNotFinite { node: [usize; 2], value: f64 } =>
            "`z` and `d` must be finite, got {value} at node ({}, {})", node[0], node[1];
        /// The magnitude of heights or gradients is so large that bounds of the surface overflow.
        TooLarge { magnitude: f64 } =>
            "`z` and `d` are too large: magnitude {magnitude} overflows the error bounds";
        /// An axis of a height field is not differentiable, so there are no normals.
        Rough => "surface must have slopes along both axes";
        /// A rectangle does not intersect the domain, or has NaN bounds.
        Empty => "rectangle does not intersect the domain";
    }
}

/// Relative width of the narrowest valid cell: 2⁻¹⁰⁰⁰, so that the reciprocal is finite.
pub(crate) const NARROWEST: f64 = f64::from_bits((1023 - 1000) << 52);

/// The number of maps.
pub(crate) fn check_knots(x: &[f64]) -> Result<usize, FifError> {
    if x.len() < 3 {
        return Err(FifError::TooFew { parameter: "x", min: 3, got: x.len() });
    }
    check_finite("x", x)?;
    for (knot, (&left, &right)) in (1..).zip(x.iter().zip(x.iter().skip(1))) {
        if left >= right {
            return Err(FifError::KnotOrder { knot, left, right });
        }
    }
    let maps = x.len() - 1;
    check_cells(maps, &|j| x.get(j).copied().unwrap_or(0.0))?;
    Ok(maps)
}

/// Checks that knots are in order.
pub(crate) fn check_cells(maps: usize, x: &dyn Fn(usize) -> f64) -> Result<(), FifError> {
    // Half of it, which does not overflow.
    let half = 0.5 * x(maps) - 0.5 * x(0);
    for map in 1..=maps {
        let width = x(map) - x(map - 1);
        if width <= 2.0 * (half * NARROWEST) {
            return Err(FifError::NarrowCell { map, width, domain: 2.0 * half });
        }
    }
    Ok(())
}

pub(crate) fn check_length(parameter: &'static str, expected: usize, got: usize) -> Result<(), FifError> {
    if expected == got { Ok(()) } else { Err(FifError::Length { parameter, expected, got }) }
}

pub(crate) fn check_finite(parameter: &'static str, list: &[f64]) -> Result<(), FifError> {
    match list.iter().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((knot, &value)) => Err(FifError::NotFinite { parameter, index: knot, value }),
        None => Ok(()),
    }
}

pub(crate) fn check_data(maps: usize, y: &[f64], alpha: &[f64]) -> Result<(), FifError> {
    check_length("y", maps + 1, y.len())?;
    check_length("alpha", maps, alpha.len())?;
    check_finite("y", y)?;
    (1..).zip(alpha).try_for_each(|(map, &alpha)| check_factor(map, alpha))
}

pub(crate) fn check_factor(map: usize, alpha: f64) -> Result<(), FifError> {
    let contracts = alpha.abs() < 1.0;
    if contracts { Ok(()) } else { Err(FifError::Scaling { map, alpha }) }
}

pub(crate) fn check_coefficients<const C: usize>(map: usize, q: &[f64; C]) -> Result<(), FifError> {
    match q.iter().enumerate().find(|(_, c)| !c.is_finite()) {
        Some((power, &value)) => Err(FifError::Coefficient { map, power, value }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FixedFif;
    use crate::system::Piece;
    use alloc::string::ToString;

    const X: [f64; 3] = [0.0, 1.0, 2.0];
    const Y: [f64; 3] = [0.0, 1.0, 0.0];
    const ALPHA: [f64; 2] = [0.5, 0.5];
    const Q: [[f64; 2]; 2] = [[0.0, 0.5], [1.0, -0.5]];

    fn affine(x: &[f64], y: &[f64], alpha: &[f64]) -> FifError {
        FixedFif::<2, 2>::affine(x, y, alpha).unwrap_err()
    }

    #[test]
    fn constructor_errors_name_the_parameter() {
        let new = |alpha: &[f64], q: &[[f64; 2]]| FixedFif::<2, 2>::new(&X, alpha, q).unwrap_err();
        let with =
            |y: &[f64], q: &[[f64; 2]]| FixedFif::<2, 2>::with_ordinates(&X, y, &ALPHA, q).unwrap_err();
        let hermite =
            |slope: &[f64], alpha: [f64; 2]| FixedFif::<2, 4>::hermite(&X, &Y, slope, &alpha).unwrap_err();
        let f = crate::cochran_2000::f().unwrap();
        for (error, message) in [
            (affine(&[0.0, 1.0], &[0.0, 1.0], &[0.5]), "`x` must have at least 3 elements, got 2"),
            (affine(&[], &[], &[]), "`x` must have at least 3 elements, got 0"),
            (affine(&[0.0, f64::NAN, 2.0], &Y, &ALPHA), "`x[1]` must be finite, got NaN"),
            (affine(&[0.0, 1.0, f64::INFINITY], &Y, &ALPHA), "`x[2]` must be finite, got inf"),
            (affine(&[0.0, 1.0, 1.0], &Y, &ALPHA), "knots must be strictly increasing: `x[2]` = 1 follows 1"),
            (affine(&[0.0, 3.0, 2.0], &Y, &ALPHA), "knots must be strictly increasing: `x[2]` = 2 follows 3"),
            (affine(&X, &[0.0, f64::NAN, 0.0], &ALPHA), "`y[1]` must be finite, got NaN"),
            (
                new(&ALPHA, &[[0.0, 0.5], [1.0, f64::INFINITY]]),
                "`q` of map 2 must have a finite coefficient of x^1, got inf",
            ),
            (hermite(&[0.0, f64::NAN, 1.0], [0.1; 2]), "`slope[1]` must be finite, got NaN"),
            (affine(&X, &[0.0, 1.0], &ALPHA), "`y` must have 3 elements, got 2"),
            (affine(&X, &Y, &[0.5; 3]), "`alpha` must have 2 elements, got 3"),
            (new(&ALPHA, &Q[..1]), "`q` must have 2 elements, got 1"),
            (affine(&[0.0, 1.0, 2.0, 3.0], &[0.0; 4], &[0.5; 3]), "`storage` must have 3 elements, got 2"),
            (hermite(&[0.0, 1.0], [0.1; 2]), "`slope` must have 3 elements, got 2"),
            (new(&ALPHA, &[[0.0, 1.0], [1.0, -0.5]]), "`q` of map 2 must send the left end to 2, got 1"),
            (with(&[0.0, 1.5, 0.0], &Q), "`q` of map 1 must send the right end to 1.5, got 1"),
            (with(&[0.25, 1.0, 0.0], &Q), "`q` of map 1 must send the left end to 0.25, got 0.125"),
            (hermite(&[0.0; 3], [0.1, -0.5]), "`alpha` of map 2 must be under 0.5 in magnitude, got -0.5"),
            (f.integral::<[Piece<2>; 2], 2>(0.0).unwrap_err(), "`C` must be at least 3, got 2"),
            (f.integral::<[Piece<3>; 3], 3>(0.0).unwrap_err(), "`storage` must have 2 elements, got 3"),
            (f.integral::<[Piece<3>; 2], 3>(f64::NAN).unwrap_err(), "`y[0]` must be finite, got NaN"),
        ] {
            assert_eq!(error.to_string(), message);
        }
        for alpha in [1.0, -1.0, 1.5, f64::NAN, f64::NEG_INFINITY] {
            let message = alloc::format!("`alpha` of map 2 must be in (-1, 1), got {alpha}");
            assert_eq!(affine(&X, &Y, &[0.5, alpha]).to_string(), message);
            assert_eq!(new(&[0.5, alpha], &Q).to_string(), message);
        }
        // Within the tolerance, so the rounding of decimal data does not matter.
        let nearly = [[0.0, 0.5], [1.0 + 1e-13, -0.5]];
        assert!(FixedFif::<2, 2>::with_ordinates(&X, &Y, &ALPHA, &nearly).is_ok());
    }

    #[test]
    fn cells_of_subnormal_width_are_an_error() {
        let error = affine(&[0.0, 5e-324, 1.0], &Y, &ALPHA);
        assert_eq!(error, FifError::NarrowCell { map: 1, width: 5e-324, domain: 1.0 });
        let text = "cell is too narrow: `x[1]` - `x[0]` = 5e-324 (at least 9.332636185032189e-302)";
        assert_eq!(error.to_string(), text);
        // In units of an equally small domain no cell is narrow; in a large domain others are.
        assert!(FixedFif::<2, 2>::affine(&[0.0, 1e-250, 2e-250], &Y, &ALPHA).is_ok());
        for x in [[-1e300, 0.0, 1e-10], [0.0, 1e-302, 1.0], [0.0, 1.0, f64::MAX]] {
            assert!(matches!(affine(&x, &Y, &ALPHA), FifError::NarrowCell { .. }), "{x:?}");
        }
        assert!(FixedFif::<2, 2>::affine(&[0.0, 1e-301, 1.0], &Y, &ALPHA).is_ok());
    }

    #[test]
    fn unbounded_systems_are_an_error() {
        let error = affine(&X, &[0.0, 1e308, -1e308], &[0.9, -0.9]);
        assert!(matches!(error, FifError::Unbounded { .. } | FifError::JoinUp { .. }), "{error}");
        let error = affine(&[-1e308, 0.0, 1e308], &Y, &ALPHA);
        assert!(matches!(error, FifError::Unbounded { .. } | FifError::JoinUp { .. }), "{error}");
        // The first polynomial overflows to NaN, the second one is finite.
        let (x, slopes) = ([-1.5, -0.25, -0.15], [f64::MAX, 1e306, 1e306]);
        let error = FixedFif::<2, 4>::hermite(&x, &[0.0, -1e9, 1e9], &slopes, &[-0.1, -0.01]).unwrap_err();
        assert!(matches!(error, FifError::Unbounded { .. }), "{error}");
        // Both ends of the range are numbers, but its width is not.
        let error = affine(&[0.0, 0.5, 1.0], &[1.8e307, -1.62e307, 1.8e306], &[0.9, -0.9]);
        assert!(matches!(error, FifError::Unbounded { .. }), "{error}");
        let nearest = 1.0_f64.next_down();
        let error = affine(&X, &Y, &[nearest, nearest]);
        assert!(matches!(error, FifError::Unbounded { .. }), "{error}");
    }
}
