//! Why a system of maps is refused, and the checks that refuse it.

use core::fmt;

/// An end of a map's interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// `x_{j−1}`, the image of `x_0`.
    Left,
    /// `x_j`, the image of `x_N`.
    Right,
}

/// A list that a constructor was given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum List {
    /// Ordinates, one per knot.
    Ordinates,
    /// Slopes, one per knot.
    Slopes,
    /// Vertical factors, one per map.
    Factors,
    /// Polynomials, one per map.
    Polynomials,
    /// The storage that is to hold the maps.
    Storage,
}

/// Why a system of maps was refused. Maps are counted from 1, as in the literature, knots and powers from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SystemError {
    /// A system needs two maps, three knots, at least.
    TooFewMaps {
        /// The number of maps.
        maps: usize,
    },
    /// A list's length does not fit the number of knots.
    Length {
        /// Which list.
        list: List,
        /// The length that fits.
        expected: usize,
        /// Its length.
        found: usize,
    },
    /// A knot is NaN or infinite.
    KnotNotFinite {
        /// Which knot, from 0.
        knot: usize,
        /// Its value.
        value: f64,
    },
    /// A knot does not lie to the right of the one before.
    KnotOrder {
        /// Which knot, from 0.
        knot: usize,
        /// The knot before.
        left: f64,
        /// The knot.
        right: f64,
    },
    /// An ordinate is NaN or infinite.
    OrdinateNotFinite {
        /// Which knot, from 0.
        knot: usize,
        /// Its value.
        value: f64,
    },
    /// A slope is NaN or infinite.
    SlopeNotFinite {
        /// Which knot, from 0.
        knot: usize,
        /// Its value.
        value: f64,
    },
    /// A vertical factor is not in `(−1, 1)`.
    VerticalFactor {
        /// Which map, from 1.
        map: usize,
        /// Its value.
        alpha: f64,
    },
    /// A vertical factor is too steep for a continuous derivative, `|α_j| ≥ a_j`.
    SteepFactor {
        /// Which map, from 1.
        map: usize,
        /// Its vertical factor.
        alpha: f64,
        /// Its horizontal factor.
        a: f64,
    },
    /// A coefficient of a polynomial is NaN or infinite.
    CoefficientNotFinite {
        /// Which map, from 1.
        map: usize,
        /// The power of x.
        power: usize,
        /// Its value.
        value: f64,
    },
    /// A map does not send an end of the graph to a knot.
    JoinUp {
        /// Which map, from 1.
        map: usize,
        /// Which end.
        end: End,
        /// The ordinate there.
        expected: f64,
        /// The image of the end of the graph.
        found: f64,
    },
    /// The image of a map does not begin where that of the map before ends, or the last not at the end of the domain.
    Tiling {
        /// Which map, from 1.
        map: usize,
        /// The end that its image should have.
        expected: f64,
        /// The end that it has.
        found: f64,
    },
    /// No finite bound of the function could be proved: the numbers overflow, or a factor is a rounding error from 1.
    Unbounded {
        /// The largest `|α_j|`.
        alpha: f64,
    },
    /// The polynomials need more coefficients than their type holds.
    Degree {
        /// The coefficients that are needed.
        expected: usize,
        /// The coefficients that the type holds.
        found: usize,
    },
}

impl fmt::Display for SystemError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::TooFewMaps { maps } => write!(f, "a system needs at least 2 maps, this one has {maps}"),
            Self::Length { list, expected, found } => {
                let list = match list {
                    List::Ordinates => "ordinates",
                    List::Slopes => "slopes",
                    List::Factors => "vertical factors",
                    List::Polynomials => "polynomials",
                    List::Storage => "places for maps",
                };
                write!(f, "{expected} {list} are needed, {found} are given")
            }
            Self::KnotNotFinite { knot, value } => write!(f, "knot {knot} is {value}, not finite"),
            Self::KnotOrder { knot, left, right } => {
                write!(f, "knot {knot} at {right} is not right of the one before at {left}")
            }
            Self::OrdinateNotFinite { knot, value } => {
                write!(f, "the ordinate of knot {knot} is {value}, not finite")
            }
            Self::SlopeNotFinite { knot, value } => {
                write!(f, "the slope at knot {knot} is {value}, not finite")
            }
            Self::VerticalFactor { map, alpha } => {
                write!(f, "the vertical factor of map {map} is {alpha}, not in (-1, 1)")
            }
            Self::SteepFactor { map, alpha, a } => {
                write!(f, "the vertical factor of map {map} is {alpha}, not under its horizontal factor {a}")
            }
            Self::CoefficientNotFinite { map, power, value } => {
                write!(f, "the coefficient of x^{power} of map {map} is {value}, not finite")
            }
            Self::JoinUp { map, end, expected, found } => {
                let end = if end == End::Left { "left" } else { "right" };
                write!(f, "map {map} sends its {end} end to {found}, the knot is at {expected}")
            }
            Self::Tiling { map, expected, found } => {
                write!(f, "the image of map {map} begins or ends at {found}, not at {expected}")
            }
            Self::Unbounded { alpha } => {
                write!(
                    f,
                    "no finite bound can be proved with numbers this large and a vertical factor of {alpha}"
                )
            }
            Self::Degree { expected, found } => {
                write!(f, "{expected} coefficients are needed, the type holds {found}")
            }
        }
    }
}

impl core::error::Error for SystemError {}

pub(crate) fn check_knots(x: &[f64]) -> Result<usize, SystemError> {
    let maps = x.len().saturating_sub(1);
    if maps < 2 {
        return Err(SystemError::TooFewMaps { maps });
    }
    if let Some((knot, &value)) = x.iter().enumerate().find(|(_, x)| !x.is_finite()) {
        return Err(SystemError::KnotNotFinite { knot, value });
    }
    let pairs = x.iter().zip(x.iter().skip(1)).enumerate();
    for (knot, (&left, &right)) in pairs {
        if left >= right {
            return Err(SystemError::KnotOrder { knot: knot + 1, left, right });
        }
    }
    Ok(maps)
}

pub(crate) fn check_length(list: List, expected: usize, found: usize) -> Result<(), SystemError> {
    if expected == found { Ok(()) } else { Err(SystemError::Length { list, expected, found }) }
}

pub(crate) fn check_data(maps: usize, y: &[f64], alpha: &[f64]) -> Result<(), SystemError> {
    check_length(List::Ordinates, maps + 1, y.len())?;
    check_length(List::Factors, maps, alpha.len())?;
    if let Some((knot, &value)) = y.iter().enumerate().find(|(_, y)| !y.is_finite()) {
        return Err(SystemError::OrdinateNotFinite { knot, value });
    }
    check_factors(alpha)
}

pub(crate) fn check_factors(alpha: &[f64]) -> Result<(), SystemError> {
    match alpha.iter().enumerate().find(|(_, alpha)| alpha.is_nan() || alpha.abs() >= 1.0) {
        Some((j, &alpha)) => Err(SystemError::VerticalFactor { map: j + 1, alpha }),
        None => Ok(()),
    }
}

pub(crate) fn check_coefficients<const C: usize>(q: &[[f64; C]]) -> Result<(), SystemError> {
    for (j, q) in q.iter().enumerate() {
        if let Some((power, &value)) = q.iter().enumerate().find(|(_, c)| !c.is_finite()) {
            return Err(SystemError::CoefficientNotFinite { map: j + 1, power, value });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FixedFif;
    use alloc::string::ToString;

    const X: [f64; 3] = [0.0, 1.0, 2.0];
    const Y: [f64; 3] = [0.0, 1.0, 0.0];
    const ALPHA: [f64; 2] = [0.5, 0.5];
    const Q: [[f64; 2]; 2] = [[0.0, 0.5], [1.0, -0.5]];

    fn affine(x: &[f64], y: &[f64], alpha: &[f64]) -> SystemError {
        FixedFif::<2, 2>::affine(x, y, alpha).unwrap_err()
    }

    fn polynomials(alpha: &[f64], q: &[[f64; 2]]) -> SystemError {
        FixedFif::<2, 2>::new(&X, alpha, q).unwrap_err()
    }

    fn says(error: SystemError, message: &str) {
        assert_eq!(error.to_string(), message);
    }

    #[test]
    fn fewer_than_two_maps_are_refused() {
        says(affine(&[0.0, 1.0], &[0.0, 1.0], &[0.5]), "a system needs at least 2 maps, this one has 1");
        says(affine(&[], &[], &[]), "a system needs at least 2 maps, this one has 0");
    }

    #[test]
    fn knots_must_be_finite_and_rise() {
        says(affine(&[0.0, f64::NAN, 2.0], &Y, &ALPHA), "knot 1 is NaN, not finite");
        says(affine(&[0.0, 1.0, f64::INFINITY], &Y, &ALPHA), "knot 2 is inf, not finite");
        says(affine(&[0.0, 1.0, 1.0], &Y, &ALPHA), "knot 2 at 1 is not right of the one before at 1");
        says(affine(&[0.0, 3.0, 2.0], &Y, &ALPHA), "knot 2 at 2 is not right of the one before at 3");
    }

    #[test]
    fn vertical_factors_must_contract() {
        for (alpha, text) in
            [(1.0, "1"), (-1.0, "-1"), (1.5, "1.5"), (f64::NAN, "NaN"), (f64::NEG_INFINITY, "-inf")]
        {
            let message = alloc::format!("the vertical factor of map 2 is {text}, not in (-1, 1)");
            says(affine(&X, &Y, &[0.5, alpha]), &message);
            says(polynomials(&[0.5, alpha], &Q), &message);
        }
    }

    #[test]
    fn data_must_be_finite() {
        says(affine(&X, &[0.0, f64::NAN, 0.0], &ALPHA), "the ordinate of knot 1 is NaN, not finite");
        says(
            polynomials(&ALPHA, &[[0.0, 0.5], [1.0, f64::INFINITY]]),
            "the coefficient of x^1 of map 2 is inf, not finite",
        );
        let error = FixedFif::<2, 4>::hermite(&X, &Y, &[0.0, f64::NAN, 1.0], &[0.1, 0.1]).unwrap_err();
        says(error, "the slope at knot 1 is NaN, not finite");
    }

    #[test]
    fn lengths_must_fit() {
        says(affine(&X, &[0.0, 1.0], &ALPHA), "3 ordinates are needed, 2 are given");
        says(affine(&X, &[0.0; 4], &ALPHA), "3 ordinates are needed, 4 are given");
        says(affine(&X, &Y, &[0.5; 3]), "2 vertical factors are needed, 3 are given");
        says(affine(&X, &Y, &[0.5]), "2 vertical factors are needed, 1 are given");
        says(polynomials(&ALPHA, &Q[..1]), "2 polynomials are needed, 1 are given");
        says(
            affine(&[0.0, 1.0, 2.0, 3.0], &[0.0; 4], &[0.5; 3]),
            "3 places for maps are needed, 2 are given",
        );
        let error = FixedFif::<2, 4>::hermite(&X, &Y, &[0.0, 1.0], &[0.1, 0.1]).unwrap_err();
        says(error, "3 slopes are needed, 2 are given");
    }

    #[test]
    fn maps_must_join_up() {
        let error = polynomials(&ALPHA, &[[0.0, 1.0], [1.0, -0.5]]);
        says(error, "map 2 sends its left end to 1, the knot is at 2");
        let error = FixedFif::<2, 2>::with_ordinates(&X, &[0.0, 1.5, 0.0], &ALPHA, &Q).unwrap_err();
        says(error, "map 1 sends its right end to 1, the knot is at 1.5");
        let error = FixedFif::<2, 2>::with_ordinates(&X, &[0.25, 1.0, 0.0], &ALPHA, &Q).unwrap_err();
        says(error, "map 1 sends its left end to 0.125, the knot is at 0.25");
        // Within the tolerance: the rounding of decimal data does not matter.
        let nearly = [[0.0, 0.5], [1.0 + 1e-13, -0.5]];
        assert!(FixedFif::<2, 2>::with_ordinates(&X, &Y, &ALPHA, &nearly).is_ok());
    }

    #[test]
    fn hermite_needs_gentle_factors() {
        let error = FixedFif::<2, 4>::hermite(&X, &Y, &[0.0; 3], &[0.1, -0.5]).unwrap_err();
        says(error, "the vertical factor of map 2 is -0.5, not under its horizontal factor 0.5");
    }

    #[test]
    fn what_cannot_be_bounded_is_refused() {
        let error = affine(&X, &[0.0, 1e308, -1e308], &[0.9, -0.9]);
        assert!(matches!(error, SystemError::Unbounded { .. } | SystemError::JoinUp { .. }), "{error}");
        let error = affine(&[-1e308, 0.0, 1e308], &Y, &ALPHA);
        assert!(matches!(error, SystemError::Unbounded { .. } | SystemError::JoinUp { .. }), "{error}");
        let nearest = 1.0_f64.next_down();
        let error = affine(&X, &Y, &[nearest, nearest]);
        assert!(matches!(error, SystemError::Unbounded { .. }), "{error}");
    }

    #[test]
    fn integrals_need_room() {
        let f = crate::paper::f().unwrap();
        let error = f.integral::<[crate::system::Piece<2>; 2], 2>(0.0).unwrap_err();
        says(error, "3 coefficients are needed, the type holds 2");
        let error = f.integral::<[crate::system::Piece<3>; 3], 3>(0.0).unwrap_err();
        says(error, "2 places for maps are needed, 3 are given");
        let error = f.integral::<[crate::system::Piece<3>; 2], 3>(f64::NAN).unwrap_err();
        says(error, "the ordinate of knot 0 is NaN, not finite");
        let error =
            crate::paper::f_hat().unwrap().derivative::<[crate::system::Piece<1>; 2], 1>().unwrap_err();
        says(error, "2 coefficients are needed, the type holds 1");
    }
}
