//! The traits of `approx` for values with bounds, jets, rays and hits.
//!
//! `asperity-core` implements them for intervals.

use crate::numeric::estimate::{Bounded, Estimate};
use crate::ray::ray::{Hit, Ray};
#[cfg(feature = "alloc")]
use crate::table::jet::jet::Jet;

/// The difference between absent and present is infinite.
fn presence<T: Copy>(part: Option<T>) -> f64 {
    if part.is_some() { 0.0 } else { f64::INFINITY }
}

asperity_core::impl_approx! { f64;
    Bounded: v => v.value, v.bound;
    Estimate: v => v.value, v.bound, v.condition;
    Ray: r => r.origin, r.direction;
    Hit: h => h.t, h.x, h.y, h.height, presence(h.gradient), h.gradient.unwrap_or_default(), presence(h.normal),
        h.normal.unwrap_or_default();
}
#[cfg(feature = "alloc")]
asperity_core::impl_approx! { f64; Jet: j => j.value, j.slope, j.integral; }

#[cfg(test)]
mod tests {
    use crate::{HeightField, Intersect, Interval, Ray, cochran_2000, glam::DVec3};
    use approx::{assert_abs_diff_eq, assert_abs_diff_ne, assert_relative_eq, assert_ulps_eq};

    #[test]
    fn approx_compares_every_field() {
        let a = Interval::new(1.0, 2.0);
        assert_abs_diff_eq!(a, Interval::new(1.0, 2.0 + 1e-9), epsilon = 1e-8);
        assert_abs_diff_ne!(a, Interval::new(1.0 + 1e-7, 2.0), epsilon = 1e-8);
        assert_relative_eq!(a.scaled(1e9), Interval::new(1e9, 2e9), max_relative = 1e-15);
        assert_ulps_eq!(a, Interval::new(1.0_f64.next_up(), 2.0));
        let surface = HeightField::new(cochran_2000::f_hat().unwrap(), cochran_2000::f_hat().unwrap());
        let ray = Ray { origin: DVec3::new(0.3, 0.4, 9.0), direction: DVec3::NEG_Z };
        let hit = surface.intersect(&ray).unwrap();
        let near = crate::Hit { t: hit.t + 1e-9, ..hit };
        assert_abs_diff_eq!(hit, near, epsilon = 1e-8);
        assert_abs_diff_ne!(hit, crate::Hit { normal: None, ..hit }, epsilon = 1e-8);
    }
}
