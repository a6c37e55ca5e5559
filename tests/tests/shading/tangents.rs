//! Bumps and facets do not depend on the parametrization of a surface: rotated, stretched, sheared
//! and mirrored.

use asperity_shading::bump::{
    bumped_normal, displace, gradient_of_normal, project_to_tangent_plane, surface_gradient,
};
use asperity_shading::glam::{Mat2, Vec2, Vec3};
use asperity_shading::level_of_detail::ResolvedBumps;
use asperity_shading::material::SeamPattern;
use asperity_shading::ndf_sampling::BlinnPhong;
use asperity_shading::reflectance::{BlinnPhongBrdf, BlinnPhongNormalization, OrenNayar, OrenNayarVariant};
use asperity_shading::{
    Beckmann, Brdf, Carpet, CarpetParameters, CookTorrance, Dielectric, EnergyPreservingOrenNayar, Footprint,
    Frame, Ggx, LevelOfDetail, Material, MetallicPaint, MetallicPaintParameters, Ndf, Phong, SurfacePoint,
    TemperedGlass, TemperedGlassParameters, Variations, VariationsParameters,
};
use proptest::prelude::*;

use crate::bad_input::unit;

fn config() -> ProptestConfig {
    let rng_seed = proptest::test_runner::RngSeed::Fixed(0x7A_96E7);
    ProptestConfig { cases: 2000, rng_seed, failure_persistence: None, ..ProptestConfig::default() }
}

fn angle() -> impl Strategy<Value = f32> {
    0.0..std::f32::consts::TAU
}

fn plane() -> impl Strategy<Value = Vec2> {
    [-3.0..3.0_f32, -3.0..3.0_f32].prop_map(Vec2::from)
}

/// A linear map of the plane far from singular, with or without reflection.
fn linear() -> impl Strategy<Value = Mat2> {
    (angle(), angle(), 0.2..3.0_f32, 0.2..3.0_f32, any::<bool>()).prop_map(|(a, b, x, y, over)| {
        let y = if over { -y } else { y };
        Mat2::from_angle(a) * Mat2::from_diagonal(Vec2::new(x, y)) * Mat2::from_angle(b)
    })
}

/// Returns the derivatives of the position by (u′, v′), where (u, v) = map (u′, v′).
fn mapped([p_u, p_v]: [Vec3; 2], map: Mat2) -> [Vec3; 2] {
    [map.x_axis, map.y_axis].map(|by| p_u * by.x + p_v * by.y)
}

/// Returns a direction in a frame rotated about its normal.
fn turned(v: Vec3, by: f32) -> Vec3 {
    Vec2::from_angle(-by).rotate(v.truncate()).extend(v.z)
}

/// Two spans of at most three (a length) over sides of at least a fifth, and the rounding of about
/// ten operations.
const ROUNDING: f32 = 3e-5;

/// Returns the radiance that a material scatters along the normal from a lamp to the side.
fn lit(material: &dyn Material, point: &SurfacePoint) -> Vec3 {
    let wo = point.normal;
    let wi = (wo + 0.5 * wo.any_orthonormal_vector()).normalize();
    material.bsdf(point, wo).eval_cos(wo, wi)
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn height_gradient_is_independent_of_parametrization(n in unit(), first in linear(), map in linear(), slope in plane()) {
        let frame = Frame::from_normal(n);
        let p = mapped([frame.tangent, frame.bitangent], first);
        let slopes = map.transpose() * slope;
        let [one, other] =
            [surface_gradient(frame.normal, p, slope), surface_gradient(frame.normal, mapped(p, map), slopes)];
        prop_assert!(one.distance(other) < ROUNDING * (1.0 + one.length()), "{one} {other}");
        let [a, b] = [one, other].map(|gradient| bumped_normal(frame.normal, gradient));
        prop_assert!(a.distance(b) < ROUNDING, "{a} {b}");
        let bend = mapped([0.3 * frame.tangent, -0.2 * frame.bitangent], first);
        let [a, b] = [(p, bend, slope), (mapped(p, map), mapped(bend, map), slopes)]
            .map(|(p, bend, slope)| displace(n, frame.normal, p, bend, 0.4, slope).normal);
        prop_assert!(a.distance(b) < ROUNDING, "{a} {b}");
    }

    #[test]
    fn frames_that_are_turned_give_the_same_bumps(n in unit(), m in unit(), by in angle(), g in unit()) {
        let frame = Frame::from_normal(n);
        let along = frame.to_world(Vec2::from_angle(by).extend(0.0));
        let other = Frame::from_normal_tangent(frame.normal, along);
        let m = Vec3::new(m.x, m.y, m.z.abs() + 0.1).normalize();
        let [a, b] = [gradient_of_normal(&frame, m), gradient_of_normal(&other, turned(m, by))];
        prop_assert!(a.distance(b) < ROUNDING * (1.0 + a.length()), "{a} {b}");
        // The tangential part of a spatial gradient depends only on the gradient along any two
        // tangents.
        let [a, b] = [project_to_tangent_plane(frame.normal, g), other.tangent * other.tangent.dot(g) + other.bitangent * other.bitangent.dot(g)];
        prop_assert!(a.distance(b) < ROUNDING, "{a} {b}");
    }

    #[test]
    fn facets_of_isotropic_densities_turn_with_their_noise(
        alpha in 0.05..1.0_f32, h in unit(), z in plane(), share in 0.0..0.9_f32, fade in 0.0..=1.0_f32, by in angle(),
    ) {
        let densities: [&dyn Ndf; 3] = [
            &Ggx::isotropic(alpha).unwrap(),
            &Beckmann::isotropic(alpha).unwrap(),
            &BlinnPhong::new(2.0 / (alpha * alpha)).unwrap(),
        ];
        let h = Vec3::new(h.x, h.y, h.z.abs());
        let one = ResolvedBumps { z, variance: share, blend: fade };
        let other = ResolvedBumps { z: Vec2::from_angle(-by).rotate(z), variance: share, blend: fade };
        for ndf in densities {
            for rule in [LevelOfDetail::Exact, LevelOfDetail::Fractal] {
                let [a, b] = [rule.normal(ndf, one), rule.normal(ndf, other)];
                prop_assert!(turned(a, by).distance(b) < ROUNDING, "{rule:?}: {a} {b}");
                let [a, b] = [rule.radiance(ndf, h, one), rule.radiance(ndf, turned(h, by), other)];
                // An exponent e amplifies the rounding of its terms by e.
                let tolerance = 1e-4 * (1.0 + (a.max(1e-30) / ndf.d(Vec3::Z)).ln().abs());
                prop_assert!((a - b).abs() <= tolerance * a.max(1e-6), "{rule:?}: {a} {b}");
            }
        }
    }

    #[test]
    fn isotropic_reflectances_turn_with_their_frame(wi in unit(), wo in unit(), by in angle()) {
        let [wi, wo] = [wi, wo].map(|w| Vec3::new(w.x, w.y, w.z.abs().max(1e-2)).normalize());
        let gray = Vec3::splat(0.5);
        let all: [(&str, Box<dyn Brdf>); 6] = [
            ("rough", Box::new(EnergyPreservingOrenNayar::new(gray, 0.7).unwrap())),
            ("Oren-Nayar", Box::new(OrenNayar::new(gray, 0.7, OrenNayarVariant::Full).unwrap())),
            ("GGX", Box::new(CookTorrance::new(Ggx::isotropic(0.3).unwrap(), Dielectric::new(1.5).unwrap()))),
            ("Beckmann", Box::new(CookTorrance::new(Beckmann::isotropic(0.3).unwrap(), Dielectric::new(1.5).unwrap()))),
            ("Phong", Box::new(Phong::new(gray, 20.0).unwrap())),
            ("Blinn-Phong", Box::new(BlinnPhongBrdf::new(gray, 20.0, BlinnPhongNormalization::Albedo).unwrap())),
        ];
        for (name, brdf) in all {
            let [a, b] = [brdf.eval(wo, wi).x, brdf.eval(turned(wo, by), turned(wi, by)).x];
            prop_assert!((a - b).abs() <= 1e-4 * a.max(1e-3), "{name}: {a} {b}");
            let [a, b] = [brdf.pdf(wo, wi), brdf.pdf(turned(wo, by), turned(wi, by))];
            prop_assert!((a - b).abs() <= 1e-4 * a.max(1e-3), "{name}, density: {a} {b}");
        }
    }

    #[test]
    fn materials_in_space_do_not_ask_for_tangents(n in unit(), position in unit(), uv in plane(), map in linear()) {
        let footprint = Footprint::from_width(1e-3);
        let one = SurfacePoint::new(position, n, footprint);
        let other = one.with_uv(uv, mapped(one.tangents, map));
        let all: [Box<dyn Material>; 3] = [
            Box::new(TemperedGlass::new(TemperedGlassParameters { roughness: 0.3, ..Default::default() }).unwrap()),
            Box::new(MetallicPaint::new(MetallicPaintParameters::default()).unwrap()),
            Box::new(Variations::new(VariationsParameters::default()).unwrap()),
        ];
        for material in all {
            let [a, b] = [one, other].map(|point| lit(&material, &point));
            prop_assert!((a - b).abs().max_element() <= 1e-4 * a.max_element().max(1e-3), "{a} {b}");
        }
    }
}

proptest! {
    // Each case measures the fibers of two carpets.
    #![proptest_config(ProptestConfig { cases: 40, ..config() })]

    #[test]
    fn seams_are_independent_of_texture_rotation_and_scale(
        n in unit(), position in unit(), uv in plane(), by in angle(), scale in 0.2..3.0_f32, grid in any::<bool>(),
    ) {
        let seams_pattern = if grid { SeamPattern::Grid } else { SeamPattern::Lines };
        // Fibers are hashed from texture coordinates, so other coordinates give other fibers.
        let parameters = CarpetParameters {
            seams_pattern,
            seam_distance: 0.5,
            fiber_strength: 0.0,
            fiber_bump_strength: 0.0,
            ..Default::default()
        };
        let one = SurfacePoint::new(position, n, Footprint::from_width(1e-3));
        let one = one.with_uv(uv, one.tangents);
        // (u, v) = map (u′, v′).
        let map = Mat2::from_angle(by) * Mat2::from_diagonal(Vec2::splat(1.0 / scale));
        let back = map.inverse();
        let other = one.with_uv(back * uv, mapped(one.tangents, map));
        let same = CarpetParameters {
            seam_distance: parameters.seam_distance * scale,
            seams_propagation: back * parameters.seams_propagation,
            ..parameters
        };
        let [a, b] = [(parameters, one), (same, other)]
            .map(|(parameters, point)| lit(&Carpet::new(parameters).unwrap(), &point));
        // Phases of up to 27 are rounded by 4e-6, and the curvature of a rounded crease is 1/(π/20)
        // of that.
        prop_assert!(a.distance(b) < 1e-4, "{a} {b}");
    }
}
