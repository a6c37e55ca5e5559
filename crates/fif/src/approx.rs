//! The traits of `approx` for intervals, values with bounds, jets, rays and hits.

use approx::{AbsDiffEq, RelativeEq, UlpsEq};

use crate::numeric::estimate::Estimate;
use crate::numeric::interval::{Bounded, Interval};
use crate::ray::ray::{Hit, Ray};
#[cfg(feature = "alloc")]
use crate::table::jet::jet::Jet;

/// Both there and equal, or both absent.
fn alike<T>(a: &Option<T>, b: &Option<T>, equal: impl Fn(&T, &T) -> bool) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => equal(a, b),
        (None, None) => true,
        _ => false,
    }
}

/// Field by field, with one tolerance; optional fields must be there in both.
macro_rules! approximate {
    ($type:ty: $($field:ident)* $(, $option:ident)*) => {
        impl AbsDiffEq for $type {
            type Epsilon = f64;

            fn default_epsilon() -> f64 {
                f64::EPSILON
            }

            fn abs_diff_eq(&self, other: &Self, epsilon: f64) -> bool {
                $(AbsDiffEq::abs_diff_eq(&self.$field, &other.$field, epsilon))&&*
                    $(&& alike(&self.$option, &other.$option, |a, b| AbsDiffEq::abs_diff_eq(a, b, epsilon)))*
            }
        }

        impl RelativeEq for $type {
            fn default_max_relative() -> f64 {
                f64::EPSILON
            }

            fn relative_eq(&self, other: &Self, epsilon: f64, most: f64) -> bool {
                $(RelativeEq::relative_eq(&self.$field, &other.$field, epsilon, most))&&*
                    $(&& alike(&self.$option, &other.$option, |a, b| RelativeEq::relative_eq(a, b, epsilon, most)))*
            }
        }

        impl UlpsEq for $type {
            fn default_max_ulps() -> u32 {
                4
            }

            fn ulps_eq(&self, other: &Self, epsilon: f64, most: u32) -> bool {
                $(UlpsEq::ulps_eq(&self.$field, &other.$field, epsilon, most))&&*
                    $(&& alike(&self.$option, &other.$option, |a, b| UlpsEq::ulps_eq(a, b, epsilon, most)))*
            }
        }
    };
}

approximate!(Interval: lo hi);
approximate!(Bounded: value bound);
approximate!(Estimate: value bound condition);
#[cfg(feature = "alloc")]
approximate!(Jet: value slope integral);
approximate!(Ray: origin direction);
approximate!(Hit: t x y height, gradient, normal);

#[cfg(test)]
mod tests {
    use crate::{HeightField, Intersect, Interval, Ray, glam::DVec3, paper};
    use approx::{assert_abs_diff_eq, assert_abs_diff_ne, assert_relative_eq, assert_ulps_eq};

    #[test]
    fn fields_are_compared_one_by_one() {
        let a = Interval::new(1.0, 2.0);
        assert_abs_diff_eq!(a, Interval::new(1.0, 2.0 + 1e-9), epsilon = 1e-8);
        assert_abs_diff_ne!(a, Interval::new(1.0 + 1e-7, 2.0), epsilon = 1e-8);
        assert_relative_eq!(a.scaled(1e9), Interval::new(1e9, 2e9), max_relative = 1e-15);
        assert_ulps_eq!(a, Interval::new(1.0_f64.next_up(), 2.0));
        let surface = HeightField::new(paper::f_hat().unwrap(), paper::f_hat().unwrap());
        let ray = Ray { origin: DVec3::new(0.3, 0.4, 9.0), direction: DVec3::NEG_Z };
        let hit = surface.first_hit(&ray).unwrap();
        let near = crate::Hit { t: hit.t + 1e-9, ..hit };
        assert_abs_diff_eq!(hit, near, epsilon = 1e-8);
        assert_abs_diff_ne!(hit, crate::Hit { normal: None, ..hit }, epsilon = 1e-8);
    }
}
