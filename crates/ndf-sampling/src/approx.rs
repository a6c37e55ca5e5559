//! Comparisons by the crate `approx`.

/// The traits of `approx` for a value, by its numbers; nothing without the feature of that name.
macro_rules! compared {
    ($type:ty, |$value:ident| $numbers:expr) => {
        #[cfg(feature = "approx")]
        impl ::approx::AbsDiffEq for $type {
            type Epsilon = f32;

            fn default_epsilon() -> f32 {
                f32::EPSILON
            }

            fn abs_diff_eq(&self, other: &Self, epsilon: f32) -> bool {
                let numbers = |$value: &Self| $numbers;
                numbers(self).iter().zip(&numbers(other)).all(|(a, b)| a.abs_diff_eq(b, epsilon))
            }
        }

        #[cfg(feature = "approx")]
        impl ::approx::RelativeEq for $type {
            fn default_max_relative() -> f32 {
                f32::EPSILON
            }

            fn relative_eq(&self, other: &Self, epsilon: f32, max_relative: f32) -> bool {
                let numbers = |$value: &Self| $numbers;
                numbers(self)
                    .iter()
                    .zip(&numbers(other))
                    .all(|(a, b)| a.relative_eq(b, epsilon, max_relative))
            }
        }

        #[cfg(feature = "approx")]
        impl ::approx::UlpsEq for $type {
            fn default_max_ulps() -> u32 {
                f32::default_max_ulps()
            }

            fn ulps_eq(&self, other: &Self, epsilon: f32, max_ulps: u32) -> bool {
                let numbers = |$value: &Self| $numbers;
                numbers(self).iter().zip(&numbers(other)).all(|(a, b)| a.ulps_eq(b, epsilon, max_ulps))
            }
        }
    };
}
pub(crate) use compared;
