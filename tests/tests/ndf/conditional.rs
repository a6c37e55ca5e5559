//! Exact level of detail: the mean over the surface is the far field, and resolving more preserves
//! the mean.

use asperity_ndf_sampling::check::p_value;
use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, BlinnPhong, ConditionalNdf, GaussianSplit, Ggx, Isotropic, Measure, Mixture,
    Ndf, NdfMap, OffsetBeckmann, Reconstruction, Rotated, StudentT, Ward, residual_ndf,
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::disk_bins::DiskBins;
use asperity_tests::random::Random;
use asperity_tests::reference::{self, rows};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

const SHARES: [f32; 4] = [0.25, 0.5, 0.75, 0.9];

type Named = (&'static str, Box<dyn Ndf + Sync>);

fn ndfs() -> Vec<Named> {
    let mut ndfs = parametric();
    let lobe = |n: Vec3, x: f32, y: f32| (-30.0 * ((n.x - x).powi(2) + (n.y - y).powi(2))).exp();
    let painted = |n: Vec3| lobe(n, -0.45, 0.2) + 0.5 * lobe(n, 0.4, -0.3) + 0.01;
    ndfs.push((
        "painted",
        Box::new(
            NdfMap::from_fn(64, 64, Measure::ProjectedSolidAngle, Reconstruction::Constant, painted)
                .expect("valid"),
        ),
    ));
    ndfs
}

/// Returns every parametric density.
fn parametric() -> Vec<Named> {
    let lobes = [Ggx::isotropic(0.1), Ggx::isotropic(0.7)].map(|ggx| ggx.expect("valid"));
    let mixture = Mixture::new(lobes[0], lobes[1], 0.4).expect("radial densities");
    vec![
        ("GGX 0.2 0.4", Box::new(Ggx::new(0.2, 0.4).expect("valid"))),
        ("GGX 0.001", Box::new(Ggx::isotropic(1e-3).expect("valid"))),
        ("Beckmann 0.3", Box::new(Beckmann::isotropic(0.3).expect("valid"))),
        ("Beckmann 1.0 0.1", Box::new(Beckmann::new(1.0, 0.1).expect("valid"))),
        ("Student-t 0.3 0.5, 1.6", Box::new(StudentT::new(0.3, 0.5, 1.6).expect("valid"))),
        ("Student-t 0.2, 8", Box::new(StudentT::new(0.2, 0.2, 8.0).expect("valid"))),
        ("Blinn-Phong 30", Box::new(BlinnPhong::new(30.0).expect("valid"))),
        ("Ward 0.2 0.5", Box::new(Ward::new(0.2, 0.5).expect("valid"))),
        ("isotropic", Box::new(Isotropic::new(&[0.0, 0.1, 0.3, 0.2, 2.0, 5.0]).expect("valid"))),
        ("mixture", Box::new(mixture)),
        ("turned GGX", Box::new(Rotated::new(Ggx::new(0.1, 0.6).expect("valid"), 0.7).expect("valid"))),
        ("Ashikhmin-Shirley 100 10", Box::new(AshikhminShirley::new(100.0, 10.0).expect("valid"))),
    ]
}

/// Returns images that are hard to invert.
fn images(reconstruction: Reconstruction) -> Vec<Named> {
    let image = move |name, size: usize, texel: fn(f64, f64) -> f64| -> Named {
        let at = |k: usize| 2.0 * (k as f64 + 0.5) / size as f64 - 1.0;
        let texels: Vec<f32> = (0..size * size).map(|k| texel(at(k % size), at(k / size)) as f32).collect();
        (
            name,
            Box::new(
                NdfMap::from_texels(size, size, &texels, Measure::ProjectedSolidAngle, reconstruction)
                    .expect("a density"),
            ),
        )
    };
    vec![
        image("smooth", 64, |x, y| (3.0 * x - y).sin() + 1.5),
        image("binary mask", 32, |x, y| {
            f64::from(u8::from(((7.0 * x).floor() + (5.0 * y).floor()).rem_euclid(2.0) == 0.0))
        }),
        image("one hot texel", 64, |x, y| {
            f64::from(u8::from((x - 0.3).abs() < 1.0 / 64.0 && (y + 0.51).abs() < 1.0 / 64.0))
        }),
        image("two far islands", 64, |x, y| f64::from(u8::from((x.abs() - 0.7).hypot(y) < 0.1))),
        image("ring", 64, |x, y| f64::from(u8::from((x.hypot(y) - 0.7).abs() < 0.1))),
        image("1×1", 1, |_, _| 1.0),
    ]
}

/// Half vectors at these Gaussian coordinates, out to the tail.
const COORDINATES: [Vec2; 5] = [
    Vec2::new(0.0, 0.0),
    Vec2::new(0.6, -0.3),
    Vec2::new(-1.5, 1.0),
    Vec2::new(0.1, 2.5),
    Vec2::new(-3.0, -2.0),
];

/// Returns the mean of `f` over two standard Gaussians, by the trapezoidal rule with steps of
/// `1/fineness`. For Gaussian integrands of width `w` its error is below
/// `2 exp(−2 (π w fineness)²)`, and the part beyond ±8 is below 1e-14.
fn gaussian_mean(fineness: i32, f: impl Fn(Vec2) -> f32 + Sync) -> f64 {
    let step = 1.0 / f64::from(fineness);
    let reach = 8 * fineness;
    (-reach..=reach)
        .into_par_iter()
        .map(|j| {
            let row = (-reach..=reach).map(|k| {
                let (x, y) = (f64::from(j) * step, f64::from(k) * step);
                let weight = (-0.5 * (x * x + y * y)).exp() / std::f64::consts::TAU * step * step;
                weight * f64::from(f(Vec2::new(x as f32, y as f32)))
            });
            row.sum::<f64>()
        })
        .collect::<Vec<_>>()
        .iter()
        .sum()
}

#[test]
fn mean_over_the_surface_is_the_far_field() {
    let mut worst = 0.0_f64;
    let maps = [Reconstruction::Constant, Reconstruction::Bilinear].into_iter().flat_map(images);
    for (name, ndf) in parametric().into_iter().chain(maps) {
        for z in COORDINATES {
            let h = ndf.warp_gaussian(z);
            let far = f64::from(ndf.d(h));
            // The center of the ring is at the inner edge of a bilinear map, where the density is 0
            // or nearly 0.
            assert!(far > 0.0 || name == "ring", "{name} at {h}");
            for (s, fineness) in [(0.0, 4), (0.1, 4), (0.5, 4), (0.9, 8), (0.99, 16)] {
                let mean = gaussian_mean(fineness, |z_b| ConditionalNdf::new(&*ndf, z_b, s).d(h));
                let error = if far > 0.0 { (mean / far - 1.0).abs() } else { mean };
                worst = worst.max(error);
                // Measured 7e-8.
                assert!(error < 1e-3, "{name} at {h}, s = {s}: {mean} != {far}");
            }
        }
    }
    println!("worst relative error of the mean: {worst:e}");
}

#[test]
fn samples_of_the_rest_have_its_density() {
    const SAMPLES: u64 = 100_000;
    let cases = [(0.1_f32, Vec2::new(0.5, 1.0)), (0.5, Vec2::new(-0.7, 0.4)), (0.9, Vec2::new(1.5, -1.0))];
    let ndfs = ndfs();
    let count = ndfs.len() * cases.len();
    for (name, ndf) in ndfs.iter().filter(|(name, _)| *name != "GGX 0.001") {
        for (seed, (s, z_b)) in (0..).zip(cases) {
            let seen = ConditionalNdf::new(&**ndf, z_b, s);
            // The texels of the painted density, whose edges the quadrature must resolve.
            let bins = DiskBins { size: 64, extent: [1.0, 1.0] };
            let expected = bins.integrate(2, |x, y| {
                let z2 = (1.0 - x * x - y * y).max(1e-14);
                f64::from(seen.d(Vec3::new(x as f32, y as f32, z2.sqrt() as f32)))
            });
            let mut random = Random(seed);
            let mut draw = || seen.sample(Vec2::new(random.uniform() as f32, random.uniform() as f32));
            let p = p_value(&bins.count((0..SAMPLES).map(|_| draw())), &expected, SAMPLES);
            println!("{name}, s = {s}: p = {p:.3}");
            assert!(p > 0.001 / count as f64, "{name}, s = {s}: {p}");
        }
    }
}

#[test]
fn resolving_more_keeps_the_mean() {
    // z_b′ = √(s/s′) z_b + √(1 − s/s′) η resolves the fraction s′ > s; its mean over η is the value
    // with s.
    let mut worst = 0.0_f64;
    for (name, ndf) in ndfs() {
        for (s, finer) in [(0.25_f32, 0.5_f32), (0.25, 0.9), (0.5, 0.75), (0.75, 0.9), (0.0, 0.25)] {
            for (z, z_b) in
                COORDINATES.into_iter().zip([(0.0, 0.0), (1.0, -0.5), (-1.0, 2.0), (0.3, 1.9), (-2.0, -1.0)])
            {
                let (h, z_b) = (ndf.warp_gaussian(z), Vec2::from(z_b));
                let (kept, new) = ((s / finer).sqrt(), (1.0 - s / finer).sqrt());
                let mean = gaussian_mean(8, |eta| residual_ndf(&*ndf, h, z_b * kept + eta * new, finer));
                let seen = f64::from(residual_ndf(&*ndf, h, z_b, s));
                worst = worst.max((mean / seen - 1.0).abs());
                assert_abs_diff_eq!(mean / seen, 1.0, epsilon = 2e-5, "{name} at {h}, {s} to {finer}");
            }
        }
    }
    println!("worst relative error of the martingale: {worst:e}");
}

#[test]
fn density_of_the_rest_integrates_to_one() {
    // ∫ p_s(h | z_b) cos θ dω = ∫ p_s/D(T(z)) N(z) dz = 1: the ratio alone, for every z_b.
    for s in SHARES {
        for z_b in COORDINATES {
            let split = GaussianSplit::new(z_b, s);
            let total = gaussian_mean(8, |z| split.weigh(1.0, z));
            assert_abs_diff_eq!(total, 1.0, epsilon = 1e-5, "s = {s}, z_b = {z_b}: {total}");
        }
    }
}

#[test]
fn beckmann_equals_the_split_of_its_slopes() {
    // In slope space a Beckmann of roughness α√w carries residual lobes of roughness α√(1 − w). The
    // file contains their density over slopes, and D is that density over cos⁴ θ. The file splits
    // GGX differently (a joint density of both slopes), not in Gaussian coordinates, so it is not
    // compared.
    let reference = reference::read("ndf/lod_split.json");
    let (mut worst, mut worst_of_slopes, mut compared) = (0.0_f64, 0.0_f64, 0);
    for row in rows(&reference["rows"]) {
        let [alpha, w, b_x, b_y, r_x, r_y, _, _, expected] = row[..] else { panic!("nine columns") };
        let beckmann = Beckmann::isotropic(alpha as f32).unwrap();
        let z_b = [b_x, b_y].map(|slope| (slope * 2f64.sqrt() / (alpha * w.sqrt())) as f32);
        // Beyond the bound of the Gaussian coordinates the crate returns the value at the bound.
        if z_b.iter().any(|z| z.abs() > 13.0) || expected < 1e-30 {
            continue;
        }
        let (x, y) = (b_x + r_x, b_y + r_y);
        let cos2 = 1.0 / (1.0 + x * x + y * y);
        let h = Vec3::new((x * cos2.sqrt()) as f32, (y * cos2.sqrt()) as f32, cos2.sqrt() as f32);
        let got = f64::from(residual_ndf(&beckmann, h, Vec2::from(z_b), w as f32)) * cos2 * cos2;
        // In f32 the exponents of distant z cancel: their sum has an error of 1e-7 of |z|²/2, which
        // is up to 100 here.
        let error = (got / expected - 1.0).abs();
        println!("{row:?}: {error:e}");
        worst = worst.max(error);
        compared += 1;
        assert!(error < 1e-4, "{row:?}: {got:e}");
        let slopes = OffsetBeckmann::conditional(beckmann, Vec2::from(z_b), w as f32);
        let error = f64::from(slopes.d(h)) * cos2 * cos2 / expected - 1.0;
        worst_of_slopes = worst_of_slopes.max(error.abs());
        // Only the slopes themselves cancel, rounded to f32.
        assert_abs_diff_eq!(error, 0.0, epsilon = 3e-5, "{row:?}: {error:e}");
    }
    println!(
        "worst relative error to the split of slopes: {worst:e}, in slopes {worst_of_slopes:e}, over {compared}"
    );
    assert!(compared >= 20, "{compared}");
}

#[test]
fn fraction_near_one_is_a_narrow_lobe_at_the_facet() {
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let z_b = Vec2::new(0.7, -1.1);
    let facet = ggx.warp_gaussian(z_b);
    let at = |s: f32, h: Vec3| residual_ndf(&ggx, h, z_b, s);
    // Its peak grows like 1/(1 − s), while the ratio N(z_b)/N(0) stays constant.
    let expected = ggx.d(facet) * (0.5 * z_b.length_squared()).exp();
    for s in [0.99_f32, 0.999, 0.9999] {
        let peak = at(s, ggx.warp_gaussian(z_b * s.sqrt()));
        let z = z_b * s.sqrt();
        let there = ggx.d(ggx.warp_gaussian(z)) * (0.5 * z.length_squared()).exp() / (1.0 - s);
        assert_abs_diff_eq!(peak / there, 1.0, epsilon = 1e-3, "s = {s}: {peak} != {there}");
        assert_abs_diff_eq!(there * (1.0 - s) / expected, 1.0, epsilon = 0.05);
    }
    assert!(at(1.0, facet).is_finite() && at(1.0, facet) > 1e5 * ggx.d(facet));
    assert_eq!(at(1.0, ggx.warp_gaussian(-z_b)), 0.0);
}
