//! Strategies of proptest: directions, roughness and points of the unit square, those on the edge included.

use glam::{Vec2, Vec3};
use proptest::prelude::*;

use crate::density::roughness::{MAX_ALPHA, MIN_ALPHA};
use asperity_core::math;

/// Unit vectors of the upper half of the sphere: uniform ones, grazing ones down to 1e-6 above the horizon, ones as near to the zenith,
/// and the zenith itself.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Microfacet, strategies};
/// use proptest::prelude::*;
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// proptest!(|(v in strategies::direction(), u in strategies::unit_square())| {
///     let m = ggx.sample_visible(v, u);
///     prop_assert!((m.length() - 1.0).abs() < 1e-5 && m.z > 0.0);
/// });
/// # Ok::<(), asperity_ndf_sampling::RangeError>(())
/// ```
pub fn direction() -> impl Strategy<Value = Vec3> {
    let tenth = |digits: f64| math::exp_f64(-digits * core::f64::consts::LN_10);
    let up = prop_oneof![
        4 => (0.0..1.0_f64).prop_map(|u| 1.0 - u),
        2 => (0.0..6.0_f64).prop_map(tenth),
        1 => (0.0..6.0_f64).prop_map(move |digits| 1.0 - tenth(digits + 1.0)),
        1 => Just(1.0),
    ];
    (up, 0.0..core::f64::consts::TAU).prop_map(|(z, phi)| {
        let across = math::sqrt_f64(1.0 - z * z);
        let (x, y) = (across * math::cos_f64(phi), across * math::sin_f64(phi));
        Vec3::new(x as f32, y as f32, z as f32)
    })
}

/// Roughness α, as likely in each decade from [`MIN_ALPHA`] to [`MAX_ALPHA`], and either end.
///
/// ```
/// use asperity_ndf_sampling::{Beckmann, strategies};
/// use proptest::prelude::*;
///
/// proptest!(|(alpha in strategies::roughness())| {
///     prop_assert_eq!(Beckmann::isotropic(alpha)?.alpha_x(), alpha);
/// });
/// ```
pub fn roughness() -> impl Strategy<Value = f32> {
    let (least, most) = (math::ln_f64(f64::from(MIN_ALPHA)), math::ln_f64(f64::from(MAX_ALPHA)));
    prop_oneof![
        8 => (least..most).prop_map(|x| (math::exp_f64(x) as f32).clamp(MIN_ALPHA, MAX_ALPHA)),
        1 => Just(MIN_ALPHA),
        1 => Just(MAX_ALPHA),
    ]
}

/// Points of the unit square [0, 1)², those on its edges included.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Ndf, strategies};
/// use proptest::prelude::*;
///
/// let ggx = Ggx::isotropic(0.3)?;
/// proptest!(|(u in strategies::unit_square())| {
///     prop_assert!(u.min_element() >= 0.0 && u.max_element() < 1.0 && ggx.sample(u).z > 0.0);
/// });
/// # Ok::<(), asperity_ndf_sampling::RangeError>(())
/// ```
pub fn unit_square() -> impl Strategy<Value = Vec2> {
    let number = || prop_oneof![6 => 0.0..1.0_f32, 1 => Just(0.0), 1 => Just(1.0 - 0.5 * f32::EPSILON)];
    (number(), number()).prop_map(|(x, y)| Vec2::new(x, y))
}
