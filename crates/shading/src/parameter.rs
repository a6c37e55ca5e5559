//! Validation of parameters.

use glam::{Vec2, Vec3};

use crate::error::ShadingError;

/// Parameters with their defaults, each with a check that the corresponding part of the material
/// does not make itself.
///
/// With the feature `serde` a file contains the parameters that differ from the defaults; an
/// unknown name is an error.
macro_rules! parameters {
    (
        $(#[$about:meta])*
        pub struct $name:ident of $material:ident {
            $($(#[doc = $doc:literal])* $field:ident: $kind:ty = $default:expr $(, $check:expr)?;)*
        }
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default, deny_unknown_fields))]
        pub struct $name {
            $($(#[doc = $doc])* pub $field: $kind,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        impl $material {
            /// The parameters.
            #[must_use]
            pub const fn parameters(&self) -> &$name {
                &self.parameters
            }
        }

        impl $name {
            /// Names of the parameters, each with its documentation: ranges and defaults.
            pub const FIELDS: &'static [(&'static str, &'static str)] =
                &[$((stringify!($field), concat!($($doc),*))),*];

            /// Returns an error for the first parameter that is out of its range.
            fn check(&self) -> Result<(), ShadingError> {
                $($($check(stringify!($field), self.$field)?;)?)*
                Ok(())
            }
        }
    };
}

pub(crate) use parameters;

/// Returns the value if it is in the range.
pub(crate) fn within(parameter: &'static str, value: f32, [min, max]: [f32; 2]) -> Result<f32, ShadingError> {
    if (min..=max).contains(&value) {
        Ok(value)
    } else {
        Err(ShadingError::OutOfRange { parameter, value, min, max })
    }
}

/// The check of a number in a closed range, for [`parameters`].
pub(crate) fn range(range: [f32; 2]) -> impl Fn(&'static str, f32) -> Result<f32, ShadingError> {
    move |parameter, value| within(parameter, value, range)
}

/// A size in units of the surface positions: within [10⁻⁶, 10⁶].
pub(crate) fn as_size(parameter: &'static str, value: f32) -> Result<f32, ShadingError> {
    within(parameter, value, [1e-6, 1e6])
}

/// A fraction or a strength: within [0, 1].
pub(crate) fn as_share(parameter: &'static str, value: f32) -> Result<f32, ShadingError> {
    within(parameter, value, [0.0, 1.0])
}

/// The roughness α of a lobe: within [0.01, 1].
pub(crate) fn as_roughness(parameter: &'static str, value: f32) -> Result<f32, ShadingError> {
    within(parameter, value, [0.01, 1.0])
}

/// Returns the value if it is finite and positive.
pub(crate) fn positive(parameter: &'static str, value: f32) -> Result<f32, ShadingError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(ShadingError::NotPositive { parameter, value })
    }
}

/// Returns the value if it is finite and not negative.
pub(crate) fn not_negative(parameter: &'static str, value: f32) -> Result<f32, ShadingError> {
    within(parameter, value, [0.0, f32::MAX])
}

/// Returns a color if every component is in `[0, 1]`.
pub(crate) fn color(parameter: &'static str, value: Vec3) -> Result<Vec3, ShadingError> {
    value.to_array().into_iter().try_for_each(|c| as_share(parameter, c).map(|_| ()))?;
    Ok(value)
}

/// The unit vector along a direction.
pub(crate) fn direction(parameter: &'static str, value: Vec3) -> Result<Vec3, ShadingError> {
    // Scaled first, because squares of very large or small components leave the range of `f32`.
    let scale = value.abs().max_element();
    let unit = (value / scale).normalize_or_zero();
    if value.is_finite() && unit.is_finite() && unit != Vec3::ZERO {
        Ok(unit)
    } else {
        Err(ShadingError::Direction { parameter, value })
    }
}

/// The unit vector along a direction in the plane.
pub(crate) fn direction_in_plane(parameter: &'static str, value: Vec2) -> Result<Vec2, ShadingError> {
    direction(parameter, value.extend(0.0)).map(Vec3::truncate)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use asperity_core::assert_abs_diff_eq;
    use std::string::ToString;

    #[test]
    fn ranges_are_closed_and_reject_nan() {
        assert_eq!((as_share("a", 0.0), as_share("a", 1.0)), (Ok(0.0), Ok(1.0)));
        for bad in [-1e-9, 1.001, f32::NAN, f32::INFINITY] {
            assert!(as_share("a", bad).is_err(), "{bad}");
        }
        assert!(color("c", Vec3::new(0.0, 0.5, f32::NAN)).is_err());
    }

    #[test]
    fn errors_contain_the_parameter_and_its_value() {
        let refused = [
            (as_share("a", 1.5), "`a` must be between 0 and 1, got 1.5"),
            (as_size("a", -1e-7), "`a` must be between 1e-6 and 1e6, got -1e-7"),
            (not_negative("a", -0.5), "`a` must be finite and at least 0, got -0.5"),
            (positive("b", f32::NAN), "`b` must be finite and positive, got NaN"),
            (direction("c", Vec3::ZERO).map(|v| v.x), "`c` must be a finite, non-zero vector, got [0, 0, 0]"),
            (
                direction_in_plane("d", Vec2::new(0.5, f32::INFINITY)).map(|v| v.x),
                "`d` must be a finite, non-zero vector, got [0.5, inf, 0]",
            ),
        ];
        for (result, sentence) in refused {
            let error = result.unwrap_err();
            assert_eq!(error.to_string(), sentence);
            assert_eq!(error.parameter(), &sentence[1..2]);
        }
    }

    #[test]
    fn directions_are_normalized() {
        for length in [1e-30, 1.0, 1e30] {
            let unit = direction_in_plane("d", Vec2::new(3.0, -4.0) * length).unwrap();
            assert_abs_diff_eq!(unit, Vec2::new(0.6, -0.8), epsilon = 1e-6, "{length}");
        }
        for bad in [Vec3::ZERO, Vec3::NAN, Vec3::new(f32::INFINITY, 0.0, 0.0)] {
            assert!(direction("d", bad).is_err(), "{bad}");
        }
    }
}
