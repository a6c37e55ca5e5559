//! The public property tests: valid noises pass, and each fault is detected by the corresponding
//! checks.

use asperity_noise::{
    Cellular, Fbm, FbmSpectrum, Field, GaussianNoise, HasHessian, Noise, Perlin, Sample, SampleHessian,
    Simplex, Statistics, WhiteNoise,
    check::{self, Report, Settings},
    glam::Vec2,
};

fn quick() -> Settings {
    Settings { samples: 1 << 14, ..Settings::default() }
}

/// A noise with one fault, one type for all faults.
#[derive(Clone)]
struct Faulty {
    of: Perlin,
    /// Factor of the second component of the gradient.
    steep: f32,
    /// Factor of everything, not reflected in the range.
    large: f32,
    /// Added to every value.
    higher: f32,
    /// Value at non-finite points.
    lost: f32,
    /// Factor in batches.
    listed: f32,
    /// Factor of the last entry of the Hessian.
    curved: f32,
}

impl Field<Vec2> for Faulty {
    fn sample(&self, p: Vec2) -> Sample<Vec2> {
        let Sample { value, gradient } = self.of.sample(p);
        let value = if p.is_finite() { self.large * value + self.higher } else { self.lost };
        Sample { value, gradient: self.large * gradient * Vec2::new(1.0, self.steep) }
    }
    fn range(&self) -> [f32; 2] {
        Field::<Vec2>::range(&self.of)
    }
    fn values(&self, points: &[Vec2], values: &mut [f32]) -> Result<(), asperity_noise::BatchError> {
        points.iter().zip(values).for_each(|(&p, value)| *value = self.listed * self.sample(p).value);
        Ok(())
    }
}

impl Noise for Faulty {
    fn statistics(&self, dimension: usize) -> &'static Statistics {
        self.of.statistics(dimension)
    }
    fn with_seed(self, seed: u32) -> Self {
        Self { of: self.of.with_seed(seed), ..self }
    }
}

impl HasHessian<Vec2> for Faulty {
    fn sample_with_hessian(&self, p: Vec2) -> SampleHessian<Vec2> {
        let [[xx, xy], [yx, yy]] = self.of.sample_with_hessian(p).hessian;
        let Sample { value, gradient } = self.sample(p);
        SampleHessian { value, gradient, hessian: [[xx, xy], [yx, self.curved * yy]] }
    }
}

const RIGHT: Faulty =
    Faulty { of: Perlin::new(1), steep: 1.0, large: 1.0, higher: 0.0, lost: 0.0, listed: 1.0, curved: 1.0 };

#[test]
fn faulty_noises_are_detected() {
    let cases: [(&str, Faulty, &[&str]); 7] = [
        ("right", RIGHT, &[]),
        ("a component of the gradient 1 % off", Faulty { steep: 1.01, ..RIGHT }, &["gradient"]),
        // The range is 1, at positions that are hardly ever sampled; 0.8 is sampled.
        (
            "a range that is overstepped",
            Faulty { large: 1.5, ..RIGHT },
            &["range", "deviation", "distribution"],
        ),
        ("values too high", Faulty { higher: 0.05, ..RIGHT }, &["mean", "distribution"]),
        ("NaN in, NaN out", Faulty { lost: f32::NAN, ..RIGHT }, &["totality"]),
        ("other lists", Faulty { listed: 1.000_001, ..RIGHT }, &["lists and grids"]),
        ("a Hessian 2 % off", Faulty { curved: 1.02, ..RIGHT }, &["Hessian"]),
    ];
    for (name, faulty, caught) in cases {
        let mut report = check::noise::<Vec2, _>(&faulty, quick());
        let hessian = check::hessian::<Vec2, _>(&faulty, quick())
            .checks
            .into_iter()
            .find(|check| check.name == "Hessian");
        report.checks.extend(hessian.filter(|_| faulty.steep == 1.0 && faulty.large == 1.0));
        assert!(report.failures().eq(caught.iter().copied()), "{name}\n{report}");
    }
}

#[test]
fn valid_noises_pass() {
    let passes = |name: &str, report: Report| assert!(report.passed(), "{name}\n{report}");
    passes("white", check::noise::<Vec2, _>(&WhiteNoise::new(3), quick()));
    passes("wide simplex", check::noise::<Vec2, _>(&Simplex::new(3).with_classic_radius(), quick()));
    passes("cellular", check::noise::<Vec2, _>(&Cellular::new(3), quick()));
    let sum: &dyn HasHessian<Vec2> = &Fbm::<_, Vec2>::new(Perlin::new(3), FbmSpectrum::default());
    passes("sum", check::hessian(sum, quick()));
}

#[test]
fn valid_noise_passes_for_every_seed() {
    for seed in 0..40 {
        let report =
            check::noise::<Vec2, _>(&GaussianNoise::new(seed), Settings { seed, samples: 4096, ..quick() });
        assert!(report.passed(), "{seed}\n{report}");
    }
}

#[test]
fn mismatched_tiles_are_detected() {
    let tile = Fbm::new(Perlin::new(1), FbmSpectrum::CLOUD).tiled([8, 5]).expect("whole periods");
    let period = Vec2::new(8.0, 5.0);
    assert!(check::tiled(&tile, period, quick()).passed());
    assert!(check::tiled(&Perlin::new(1), Vec2::ZERO, quick()).passed());
    for wrong in [Vec2::new(4.0, 5.0), Vec2::new(8.0, 1.0), Vec2::splat(8.0)] {
        assert!(check::tiled(&tile, wrong, quick()).failures().eq(["tile"]), "{wrong}");
    }
}
