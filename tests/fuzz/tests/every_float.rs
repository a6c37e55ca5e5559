//! Functions of one number at every float: all 2³², including infinities and every NaN.
//!
//! `ASPERITY_EVERY_FLOAT=1 cargo test --manifest-path tests/fuzz/Cargo.toml --test every_float --
//! --nocapture` tests all, which takes seconds to minutes per function. Without the variable every
//! 65537th float is tested.

use std::ops::RangeInclusive;
use std::time::Instant;

use asperity_fif::cochran_2000;
use asperity_ndf_sampling::{GaussianDistribution, KurtoticDistribution, NoiseCdfRef, NoiseDistribution};
use asperity_noise::{FbmSpectrum, Field, GaussianNoise, Perlin, Simplex, ValueCatmullRom, ValueNoise};
use asperity_shading::Footprint;
use asperity_shading::glam::Vec3;
use asperity_shading::pixel::FrequencyClamp;
use asperity_shading::reflectance::{Absorption, Conductor, Dielectric, Schlick, SchlickF82};
use asperity_shading::texture::{Bevel, BevelParameters, Marble};

const UNIT: RangeInclusive<f32> = 0.0..=1.0;

/// Asserts an invariant at every number, on all cores.
fn everywhere(name: &str, holds: impl Fn(f32) -> bool + Sync) {
    let step = if std::env::var_os("ASPERITY_EVERY_FLOAT").is_some() { 1 } else { 65_537 };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let begun = Instant::now();
    let broken = std::thread::scope(|scope| {
        let parts = (0..threads).map(|part| {
            let holds = &holds;
            let of = (part * step..=u32::MAX as usize).step_by(threads * step);
            scope.spawn(move || of.map(|bits| f32::from_bits(bits as u32)).find(|&x| !holds(x)))
        });
        let parts: Vec<_> = parts.collect();
        parts.into_iter().find_map(|part| part.join().expect("a function that does not panic"))
    });
    let visited = (1_usize << 32).div_ceil(step);
    println!("| {name} | {visited} | {:.1} s |", begun.elapsed().as_secs_f64());
    assert!(broken.is_none(), "{name} at {broken:?}, bits {:08x}", broken.unwrap_or_default().to_bits());
}

fn finite(v: Vec3) -> bool {
    v.is_finite()
}

#[test]
fn reflectances_are_within_0_and_1() {
    let (glass, dense) =
        (Dielectric::new(1.5).expect("glass"), Dielectric::new(1.0 / 2.4).expect("from within"));
    everywhere("`Dielectric::reflectance`, 1.5", |x| UNIT.contains(&glass.reflectance(x)));
    everywhere("`Dielectric::reflectance`, 1/2.4", |x| UNIT.contains(&dense.reflectance(x)));
    let gold = Conductor::new(0.2, 3.0).expect("gold");
    everywhere("`Conductor::reflectance`", |x| UNIT.contains(&gold.reflectance(x)));
    let schlick = Schlick::new(0.04).expect("a share");
    everywhere("`Schlick::reflectance`", |x| UNIT.contains(&schlick.reflectance(x)));
    let tinted = SchlickF82::new(0.9, 0.7).expect("shares");
    everywhere("`SchlickF82::reflectance`", |x| UNIT.contains(&tinted.reflectance(x)));
    let gas = Absorption::new(Vec3::new(0.0, 0.3, 80.0)).expect("coefficients");
    everywhere("`Absorption::transmittance`", |x| {
        let left = gas.transmittance(x);
        left.cmpge(Vec3::ZERO).all() && left.cmple(Vec3::ONE).all()
    });
}

#[test]
fn footprints_and_textures_accept_every_float() {
    everywhere("`Footprint::from_width`", |x| Footprint::from_width(x).width() >= 0.0);
    let pixel = Footprint::from_width(0.01);
    everywhere("`Footprint::kept`", |x| UNIT.contains(&pixel.kept(x)));
    let clamp = FrequencyClamp::new(16.0, 2.17, 6.0).expect("a clamp");
    everywhere("`FrequencyClamp::octaves`", |x| {
        (0.0..=6.0).contains(&clamp.octaves(Footprint::from_width(x)))
    });
    // A library's power of two may round either way between neighbors.
    let [finest, widest] = [(6.0, 1.0 - 1e-6), (0.0, 1.0 + 1e-6)]
        .map(|(octaves, slack)| slack * clamp.footprint(octaves).width());
    everywhere("`FrequencyClamp::footprint`", |x| (finest..=widest).contains(&clamp.footprint(x).width()));
    everywhere("`Marble::spline`", |x| finite(<Marble>::spline(x)));
    let bevel =
        Bevel::new(BevelParameters { plateau: 0.02, ridge: 0.1, top: 0.0, bottom: 1.0 }).expect("a bevel");
    everywhere("`Bevel::profile`", |x| {
        let [height, slope] = bevel.profile(x);
        (0.0..=0.1).contains(&height) && (-1.0..=0.0).contains(&slope)
    });
}

#[test]
fn distributions_are_bounded_and_finite() {
    fn distribution(name: &str, noise: &(impl NoiseDistribution + Sync)) {
        everywhere(&format!("`{name}::gaussian`"), |x| noise.invert(x).abs() <= 13.0);
        everywhere(&format!("`{name}::uniform`"), |x| UNIT.contains(&noise.cdf(x)));
        everywhere(&format!("`{name}::from_gaussian`"), |x| noise.warp_gaussian(x).is_finite());
        everywhere(&format!("`{name}::inverse`"), |x| noise.quantile(x).is_finite());
    }
    distribution("GaussianNoise", &GaussianDistribution::new(0.4).expect("a deviation"));
    distribution("KurtoticNoise", &KurtoticDistribution::new(0.4, -0.46).expect("moments"));
    distribution("NoiseCdfRef", &NoiseCdfRef::new(1.0, &[0.0, 0.2, 0.8, 1.0]).expect("a distribution"));
}

#[test]
fn spectra_accept_any_octave_count() {
    let cloud = FbmSpectrum::CLOUD;
    everywhere("`Spectrum::share`", |x| (0.0..1.0).contains(&cloud.resolved_variance(x)));
    everywhere("`Spectrum::kurtosis_ratio`", |x| UNIT.contains(&cloud.kurtosis_ratio(x)));
    everywhere("`Spectrum::sum_of_amplitudes`", |x| (0.0..=2.0).contains(&cloud.sum_of_amplitudes(x)));
    everywhere("`Spectrum::root_sum_of_squares`", |x| (0.0..=1.2).contains(&cloud.root_sum_of_squares(x)));
}

#[test]
fn noise_stays_in_range() {
    fn noise(name: &str, noise: &(impl Field<f32> + Sync)) {
        let [low, high] = noise.range();
        // Far from the origin, corners of cells round to other corners.
        let slack = 1e-4 * (high - low);
        everywhere(&format!("`{name}::sample`"), |x| {
            let sample = noise.sample(x);
            (low - slack..=high + slack).contains(&sample.value) && sample.gradient.is_finite()
        });
    }
    noise("Value", &ValueNoise::new(1));
    noise("ValueCatmullRom", &ValueCatmullRom::new(1));
    noise("Perlin2002", &Perlin::new(1));
    noise("Simplex", &Simplex::new(1));
    noise("Gaussian", &GaussianNoise::new(1));
}

#[test]
fn fif_tables_stay_in_range() {
    for (name, f) in [("f", cochran_2000::f()), ("g", cochran_2000::g())] {
        let table = f.expect("a system").table(1e-4).expect("a table");
        let range = table.system().range();
        let table = table.to_f32();
        let (low, high) = (range.lo - f64::from(table.bound()), range.hi + f64::from(table.bound()));
        everywhere(&format!("`Table32::value`, {name}"), |x| {
            let y = table.value(x);
            if x.is_nan() { y.is_nan() } else { (low..=high).contains(&f64::from(y)) }
        });
    }
}
