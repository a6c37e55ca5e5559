//! Visible normals as a map of Gaussian numbers, and their distribution when a part is resolved.

use asperity_ndf_sampling::{
    Ggx, Microfacet, Ndf, VisibleFacets, VisibleWarp,
    glam::{Vec2, Vec3},
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;

const ALPHAS: [[f32; 2]; 5] = [[0.3, 0.3], [0.5, 0.2], [0.05, 0.6], [1e-3, 1e-3], [1.0, 0.1]];

fn view(tilt: f32, azimuth: f32) -> Vec3 {
    Vec3::new(tilt.sin() * azimuth.cos(), tilt.sin() * azimuth.sin(), tilt.cos())
}

fn views() -> impl Iterator<Item = Vec3> {
    [0.0_f32, 1e-3, 0.3, 0.8, 1.2, 1.45, 1.55, 1.57]
        .into_iter()
        .enumerate()
        .map(|(k, tilt)| view(tilt, 0.7 * k as f32))
}

/// Every roughness with every view, 500 times.
fn cases() -> impl Iterator<Item = (Ggx, Vec3)> {
    let densities =
        ALPHAS.map(|[alpha_x, alpha_y]| Ggx::new(alpha_x, alpha_y).expect("a roughness in range"));
    densities.into_iter().flat_map(|ggx| views().flat_map(move |v| (0..500).map(move |_| (ggx, v))))
}

#[test]
fn warp_visible_is_sample_visible_of_exponential_and_azimuth() {
    let mut random = Random(2);
    for (ggx, v) in cases() {
        let u = Vec2::new(random.uniform() as f32, random.uniform() as f32);
        let rho = (-2.0 * f64::from(-u.y).ln_1p()).sqrt();
        let (sin, cos) = (core::f64::consts::TAU * f64::from(u.x)).sin_cos();
        let m = ggx.warp_visible(v, Vec2::new((rho * cos) as f32, (rho * sin) as f32));
        // Normals whose terms cancel, see `Ggx`, amplify rounding.
        assert_abs_diff_eq!(m, ggx.sample_visible(v, u), epsilon = 3e-5, "{ggx:?} {v} {u}");
    }
}

#[test]
fn warp_visible_at_the_zenith_is_warp_gaussian() {
    let mut random = Random(5);
    for [alpha_x, alpha_y] in ALPHAS {
        let ggx = Ggx::new(alpha_x, alpha_y).unwrap();
        for _ in 0..1000 {
            let z = Vec2::from(random.gaussians().map(|z| z as f32));
            let (m, n) = (ggx.warp_visible(Vec3::Z, z), ggx.warp_gaussian(z));
            assert_abs_diff_eq!(m, n, epsilon = 4e-7, "{z}");
            assert_abs_diff_eq!(ggx.invert_visible(Vec3::Z, n), z, epsilon = 1e-5);
        }
    }
}

#[test]
fn invert_visible_round_trip() {
    let mut random = Random(7);
    for (ggx, v) in cases() {
        let z = Vec2::from(random.gaussians().map(|z| z as f32));
        let m = ggx.warp_visible(v, z);
        assert!(m.is_normalized() && m.z > 0.0, "{v} {z} {m}");
        let error = (ggx.invert_visible(v, m) - z).abs().max_element();
        // Measured: 1.8e-5 at a grazing view, whose cap ends next to the horizon.
        assert!(error < 4e-5, "{ggx:?} {v} {z}: {error}");
    }
}

/// `∫ p_v dω` by the midpoint rule in the slopes of the stretched space, where GGX has roughness 1.
fn integral(seen: &VisibleFacets<Ggx>, [alpha_x, alpha_y]: [f32; 2]) -> f64 {
    const ROWS: u32 = 700;
    const COLUMNS: u32 = 1400;
    let mut sum = 0.0;
    for row in 0..ROWS {
        // tan² = r/(1 − r), of density dr.
        let r = (f64::from(row) + 0.5) / f64::from(ROWS);
        let tan = (r / (1.0 - r)).sqrt();
        for column in 0..COLUMNS {
            let phi = core::f64::consts::TAU * (f64::from(column) + 0.5) / f64::from(COLUMNS);
            let slope = [f64::from(alpha_x) * tan * phi.cos(), f64::from(alpha_y) * tan * phi.sin()];
            let length2 = 1.0 + slope[0] * slope[0] + slope[1] * slope[1];
            let m = Vec3::new(slope[0] as f32, slope[1] as f32, 1.0) / length2.sqrt() as f32;
            // dω = m_z³ ds, ds = αx αy tan dtan dφ, tan dtan = dr/(2 (1 − r)²)
            let area =
                f64::from(alpha_x) * f64::from(alpha_y) * length2.powf(-1.5) / (2.0 * (1.0 - r).powi(2));
            sum += f64::from(seen.pdf(m)) * area;
        }
    }
    sum * core::f64::consts::TAU / (f64::from(ROWS) * f64::from(COLUMNS))
}

#[test]
fn visible_facets_integrate_to_one() {
    for (alpha, tilt, z_b, s) in [
        ([0.5, 0.2], 0.3, [0.4, -1.1], 0.0),
        ([0.5, 0.2], 0.3, [0.4, -1.1], 0.5),
        ([0.5, 0.2], 1.2, [0.4, -1.1], 0.8),
        ([0.3, 0.3], 1.45, [-1.3, 0.2], 0.6),
        ([0.3, 0.3], 0.8, [1.5, 1.0], 0.9),
        ([1.0, 0.1], 1.0, [0.0, 0.0], 0.7),
    ] {
        let ggx = Ggx::new(alpha[0], alpha[1]).unwrap();
        let seen = VisibleFacets::new(ggx, view(tilt, 0.4), Vec2::from(z_b), s);
        assert_abs_diff_eq!(integral(&seen, alpha), 1.0, epsilon = 2e-3, "{alpha:?} {tilt} {s}");
    }
}

#[test]
fn visible_facets_mean_is_the_far_field() {
    // Means over z_b of the density at one normal, by the trapezoid rule on ±6.
    const SIDE: i16 = 120;
    for (v, s) in views().zip([0.1, 0.3, 0.5, 0.7, 0.8, 0.4, 0.6, 0.2]) {
        let ggx = Ggx::new(0.5, 0.2).unwrap();
        for z in [Vec2::new(0.3, -0.4), Vec2::new(-1.5, 0.7), Vec2::new(0.1, 2.0)] {
            let m = ggx.warp_visible(v, z);
            let mut mean = 0.0;
            for (i, j) in (-SIDE..=SIDE).flat_map(|i| (-SIDE..=SIDE).map(move |j| (i, j))) {
                let z_b = Vec2::new(f32::from(i), f32::from(j)) * (6.0 / f32::from(SIDE));
                let weight = (-0.5 * f64::from(z_b.length_squared())).exp() / core::f64::consts::TAU;
                mean += weight * f64::from(VisibleFacets::new(ggx, v, z_b, s).pdf(m));
            }
            mean *= (6.0 / f64::from(SIDE)).powi(2);
            let far = f64::from(ggx.visible_pdf(v, m));
            assert_abs_diff_eq!(mean / far, 1.0, epsilon = 1e-4, "{v} {s} {z}");
        }
    }
}

#[test]
fn visible_warp_is_continuous_in_the_view() {
    let ggx = Ggx::new(0.4, 0.2).unwrap();
    for z in [Vec2::ZERO, Vec2::new(1.0, -0.5), Vec2::new(-2.0, 0.3)] {
        let mut last = ggx.warp_visible(Vec3::Z, z);
        for k in 1..=1600_u16 {
            let m = ggx.warp_visible(view(f32::from(k) * 9.8e-4, 0.3), z);
            assert!(m.distance(last) < 4e-3, "{z} {k}: {m} {last}");
            last = m;
        }
    }
}

#[test]
fn every_input_returns_a_normal() {
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -1.0, 1e30, 1e-30];
    for [alpha_x, alpha_y] in ALPHAS.into_iter().chain([[1e-6, 1e6], [1e6, 1e6], [1e-6, 1e-6]]) {
        let ggx = Ggx::new(alpha_x, alpha_y).unwrap();
        for (a, b, c) in
            bad.into_iter().flat_map(|a| bad.into_iter().flat_map(move |b| bad.map(|c| (a, b, c))))
        {
            let v = Vec3::new(a, b, c);
            let m = ggx.warp_visible(v, Vec2::new(b, c));
            assert!(m.is_normalized() && m.z >= 0.0, "{alpha_x} {alpha_y} {v}: {m}");
            for z in [ggx.invert_visible(v, m), ggx.invert_visible(m, v), ggx.invert_visible(v, v)] {
                assert!(z.is_finite(), "{alpha_x} {alpha_y} {v}: {z}");
            }
            let seen = VisibleFacets::new(ggx, v, Vec2::new(c, a), b);
            let pdf = seen.pdf(m);
            assert!(pdf >= 0.0 && pdf.is_finite() && seen.pdf(v).is_finite(), "{v}: {pdf}");
            assert!(seen.warp_gaussian(Vec2::new(a, c)).is_normalized(), "{v}");
        }
    }
}
