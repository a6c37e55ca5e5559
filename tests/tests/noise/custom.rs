//! Sums of fields that are not kinds of the crate: bits, gradients, Hessians, tiles and statistics.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, HasHessian, Moments, Normalization, Perlin, RidgedMultifractal, Rotation,
    Sample, SampleHessian, Turbulence,
    check::{self, Settings},
    glam::{Vec2, Vec3},
};

/// Perlin noise as a field of a user, with a seed.
struct Seeded(Perlin);

impl Field<Vec3> for Seeded {
    fn sample(&self, p: Vec3) -> Sample<Vec3> {
        self.0.sample(p)
    }
    fn range(&self) -> [f32; 2] {
        Field::<Vec3>::range(&self.0)
    }
    fn moments(&self) -> Option<Moments> {
        Field::<Vec3>::moments(&self.0)
    }
    fn seed(&self) -> u32 {
        Field::<Vec3>::seed(&self.0)
    }
    fn with_octave_seed(&self, seed: u32) -> Option<Self> {
        Some(Self(self.0.with_seed(seed)))
    }
}

/// sin(πx) sin(πy), of period 2.
struct Waves;

impl Waves {
    fn parts(p: Vec2) -> [(f32, f32); 2] {
        // Of the place in the period, so that tiles have the same bits.
        [p.x, p.y].map(|x| (std::f32::consts::PI * x.rem_euclid(2.0)).sin_cos())
    }
}

impl Field<Vec2> for Waves {
    fn sample(&self, p: Vec2) -> Sample<Vec2> {
        let [(sx, cx), (sy, cy)] = Self::parts(p);
        let value = if p.is_finite() { sx * sy } else { 0.0 };
        let gradient =
            if p.is_finite() { std::f32::consts::PI * Vec2::new(cx * sy, sx * cy) } else { Vec2::ZERO };
        Sample { value, gradient }
    }
    fn range(&self) -> [f32; 2] {
        [-1.0, 1.0]
    }
}

impl HasHessian<Vec2> for Waves {
    fn sample_with_hessian(&self, p: Vec2) -> SampleHessian<Vec2> {
        const SQUARE: f32 = std::f32::consts::PI * std::f32::consts::PI;
        let (Sample { value, gradient }, [(sx, cx), (sy, cy)]) = (self.sample(p), Self::parts(p));
        let [same, mixed] = [-SQUARE * sx * sy, SQUARE * cx * cy];
        SampleHessian { value, gradient, hessian: [[same, mixed], [mixed, same]] }
    }
}

#[test]
fn fbm_of_a_seeded_field_has_the_bits_of_the_kind() {
    let spectrum = FbmSpectrum::default();
    let (own, kind) = (Fbm::new(Seeded(Perlin::new(7)), spectrum), Fbm::new(Perlin::new(7), spectrum));
    assert_eq!(own.normalization(), Normalization::UnitVariance);
    let single =
        [Fbm::single(Seeded(Perlin::new(7))).value(Vec3::ONE * 0.3), Perlin::new(7).value(Vec3::ONE * 0.3)];
    assert_eq!(single[0], single[1]);
    let ridged = [
        RidgedMultifractal::new(Seeded(Perlin::new(7)), spectrum, 2.0).unwrap().range(),
        RidgedMultifractal::<_, Vec3>::new(Perlin::new(7), spectrum, 2.0).unwrap().range(),
    ];
    assert_eq!(ridged[0], ridged[1]);
    let points: Vec<Vec3> =
        (0..300_u16).map(|i| Vec3::new(0.37, -0.21, 0.53) * f32::from(i) - 40.0).collect();
    let [mut own_values, mut values] = [(); 2].map(|()| vec![0.0; points.len()]);
    own.values(&points, &mut own_values).unwrap();
    kind.values(&points, &mut values).unwrap();
    for (i, &p) in points.iter().enumerate() {
        let octaves = f32::from(i as u16) / 30.0;
        assert_eq!(own.sample(p), kind.sample(p), "{p}");
        assert_eq!(own.sample_with_octaves(p, octaves), kind.sample_with_octaves(p, octaves), "{p}");
        assert_eq!(own.value_band_limited(p, 0.02), kind.band_limited(0.02).value(p), "{p}");
        assert_eq!([own_values[i], own.value(p)], [values[i]; 2], "{p}");
    }
}

#[test]
fn fbm_of_a_custom_field_passes_the_checks() {
    let sum = Fbm::new(Waves, FbmSpectrum::CLOUD).with_octaves(3.5);
    assert_eq!((sum.normalization(), sum.range()), (Normalization::UnitRange, [-1.0, 1.0]));
    let passes = |name: &str, report: check::Report| assert!(report.passed(), "{name}\n{report}");
    passes("fBm", check::hessian(&sum, Settings::default()));
    passes(
        "turbulence",
        check::field(&Fbm::new(Waves, FbmSpectrum::CLOUD).with_shape(Turbulence), Settings::default()),
    );
    let ridges = RidgedMultifractal::new(Waves, FbmSpectrum::CLOUD, 2.0).unwrap().with_octaves(3.0);
    passes("ridged multifractal", check::field(&ridges, Settings::default()));
    let boxed: Box<dyn Field<Vec2>> = Box::new(Waves);
    let p = Vec2::new(0.3, -1.2);
    assert_eq!(Fbm::new(boxed, FbmSpectrum::CLOUD).with_octaves(3.5).sample(p), sum.sample(p));
}

#[test]
fn fbm_of_a_periodic_field_tiles_and_its_octaves_differ() {
    let sum = Fbm::new(Waves, FbmSpectrum::CLOUD).with_rotation(Rotation::Aligned);
    let [sample, moved] = [Vec2::new(0.25, 1.5), Vec2::new(2.25, -0.5)].map(|p| sum.sample(p));
    asperity_tests::assert_abs_diff_eq!(sample.value, moved.value, epsilon = 1e-4);
    // Offsets are spread over many cells: octaves of the unrotated sum do not start at one point.
    let offsets: Vec<[f32; 2]> = sum.gpu().layers[..4].iter().map(|layer| layer.offset).collect();
    for (i, a) in offsets.iter().enumerate() {
        for b in &offsets[i + 1..] {
            assert!(a.iter().zip(b).any(|(x, y)| (x - y).abs() > 1.0), "{offsets:?}");
        }
    }
}
