//! Comparisons of values with `approx`, by their components.

use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, BlinnPhong, ConditionalAccuracy, Frame, GaussianDistribution, GaussianSplit,
    Ggx, KurtoticDistribution, OffsetBeckmann, StudentT, Ward, normal_table::Deviation,
};
use asperity_tests::approx::{RelativeEq, UlpsEq};
use glam::{Vec2, Vec3};

/// Asserts that two values that differ by 1e-3 in a component near 1 are equal within 2e-3 but not
/// within 5e-4.
#[track_caller]
fn differ<T: RelativeEq<Epsilon = f32> + UlpsEq>(of: impl Fn(f32) -> T) {
    let (a, b) = (of(1.0), of(1.001));
    assert!(a.abs_diff_eq(&b, 2e-3) && a.abs_diff_ne(&b, 5e-4), "absolute");
    assert!(a.relative_eq(&b, 0.0, 2e-3) && a.relative_ne(&b, 0.0, 5e-4), "relative");
    assert!(a.ulps_eq(&b, 0.0, 1 << 14) && a.ulps_ne(&b, 0.0, 1 << 12), "in the last place");
    assert!(a.ulps_eq(&a, 0.0, 0), "to itself");
}

#[test]
fn approx_compares_components() {
    differ(|x| Frame { bitangent: Vec3::new(0.0, x, 0.0), ..Frame::IDENTITY });
    differ(|x| Ggx::new(0.2, x).unwrap());
    differ(|x| Beckmann::new(x, 0.2).unwrap());
    differ(|x| Ward::new(0.2, x).unwrap());
    differ(|x| StudentT::new(0.2, x, 3.0).unwrap());
    differ(|x| BlinnPhong::new(x).unwrap());
    differ(|x| AshikhminShirley::new(3.0, x).unwrap());
    differ(|x| GaussianSplit::new(Vec2::new(x, 0.3), 0.5));
    differ(|x| OffsetBeckmann::new(Vec2::new(0.3, x), [0.09, 0.0, 0.04]).unwrap());
    differ(|x| GaussianDistribution::new(x).unwrap());
    differ(|x| KurtoticDistribution::new(x, 0.3).unwrap());
    differ(|x| Deviation { largest: x, rms: 0.1 });
    differ(|x| ConditionalAccuracy { variation: 0.1, coordinates: x });
}
