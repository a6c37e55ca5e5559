//! Every noise, sum and transform, at every point: finite, in range, and with the same bits in
//! lists and grids.

use asperity_noise::glam::{Vec2, Vec3, Vec4};
use asperity_noise::{
    Billow, Cellular, CellularOutput, Fbm, FbmSpectrum, Field, GaussianFbm, GaussianNoise, Grid, HasHessian,
    Metric, Normalization, Perlin, PerlinClassic, Plasma, Point, Ridged, RidgedMultifractal, Rotation,
    Sample, Simplex, SparseConvolution, Turbulence, ValueCatmullRom, ValueGradient, ValueNoise, Warp,
    WhiteNoise, curl, filtered_fraction,
    ops::{Add, Blend, Clamp, Multiply, Power, ScaleBias, Unit},
    pixel_footprint,
};

use crate::numbers::Numbers;

fn point<V: Point>(numbers: &mut Numbers<'_>) -> V {
    V::from_axes(|_| numbers.float())
}

/// Checks that samples are finite, within the field's range, and equal to values.
fn field<V: Point>(field: &impl Field<V>, slack: f32, numbers: &mut Numbers<'_>) {
    checked(&|p| (field.sample(p), field.value(p)), field.range(), slack, numbers);
}

/// [`field`], compiled once per dimension.
fn checked<V: Point>(
    at: &dyn Fn(V) -> (Sample<V>, f32),
    [low, high]: [f32; 2],
    slack: f32,
    numbers: &mut Numbers<'_>,
) {
    assert!(low <= high, "[{low}, {high}]");
    for _ in 0..=numbers.count(3) {
        let p: V = point(numbers);
        let (sample, value) = at(p);
        assert_eq!(sample.value.to_bits(), value.to_bits(), "{p:?}");
        assert!(value.is_finite(), "{value} at {p:?}");
        let slack = slack * (high - low).max(1.0);
        assert!((low - slack..=high + slack).contains(&value), "{value} in [{low}, {high}] at {p:?}");
        let gradient = sample.gradient.coordinates();
        assert!(gradient.as_ref().iter().all(|x| x.is_finite()), "{sample:?} at {p:?}");
        if !p.coordinates().as_ref().iter().all(|x| x.is_finite()) {
            assert!(gradient.as_ref().iter().all(|&x| x == 0.0), "{sample:?} at {p:?}");
        }
    }
}

/// Checks lists and grids of a field, which have the bits of single points.
fn many(numbers: &mut Numbers<'_>) {
    let field =
        Fbm::<_, Vec3>::new(Perlin::new(numbers.word()), FbmSpectrum::CLOUD).with_octaves(numbers.float());
    let points: Vec<Vec3> = (0..1 + numbers.count(17)).map(|_| numbers.vector()).collect();
    let mut values = vec![0.0; points.len()];
    field.values(&points, &mut values).expect("as many");
    for (&p, value) in points.iter().zip(values) {
        assert_eq!(field.value(p).to_bits(), value.to_bits(), "{p}");
    }
    let (origin, step) = (numbers.vector(), numbers.vector());
    let grid =
        Grid { origin, step, size: [1 + numbers.count(9), 1 + numbers.count(2), 1 + numbers.count(2)] };
    let mut values = vec![0.0; grid.len()];
    field.grid_values(&grid, &mut values).expect("as many");
    let [columns, rows, _] = grid.size;
    for (k, value) in values.into_iter().enumerate() {
        let p = grid.point([k % columns, k / columns % rows, k / columns / rows]);
        assert_eq!(field.value(p).to_bits(), value.to_bits(), "{grid:?} at {p}");
    }
}

fn spectrum(numbers: &mut Numbers<'_>) -> FbmSpectrum {
    let given = FbmSpectrum::new(numbers.float(), numbers.float(), numbers.word() % 20);
    given.unwrap_or_else(|error| {
        assert_eq!(error.to_string().lines().count(), 1);
        FbmSpectrum::default()
    })
}

/// Returns the relative rounding error of the range. Far from the origin the corners of simplices
/// contribute up to all of it.
const fn slack(simplicial: bool) -> f32 {
    if simplicial { 1.0 } else { 1e-4 }
}

/// Checks a sum and transforms of a noise.
fn transformed<V: Point<Coordinates = [f32; N]>, const N: usize>(numbers: &mut Numbers<'_>) {
    let noise = Perlin::new(numbers.word());
    let (low, high, power) = (numbers.share(), numbers.share(), numbers.byte() % 9);
    let (unit, slack) = (Unit(noise), slack(false));
    match numbers.byte() % 4 {
        0 => field::<V>(&Clamp(ScaleBias(unit, low, high), -1.0, high), slack, numbers),
        1 => {
            field::<V>(&Blend(Add(noise, noise), Multiply(noise, noise), Power(unit, power)), slack, numbers)
        }
        2 => {
            if let Some(sum) = sum::<_, V>(noise, numbers) {
                field::<V>(&sum, slack, numbers);
            }
        }
        _ => {
            if let Some(sum) = sum::<_, V>(GaussianNoise::new(numbers.word()), numbers) {
                field::<V>(&sum, slack, numbers);
            }
        }
    }
}

/// Returns the sum of a noise's octaves, unless its gradients may overflow.
fn sum<F: Field<V>, V: Point>(noise: F, numbers: &mut Numbers<'_>) -> Option<Fbm<F, V>> {
    let (spectrum, octaves) = (spectrum(numbers), numbers.float());
    for share in [spectrum.resolved_variance(octaves), spectrum.weight(octaves, numbers.word() % 20)] {
        assert!((0.0..=1.0).contains(&share), "{share}");
    }
    let sum = Fbm::new(noise, spectrum)
        .with_rotation(numbers.pick(&[Rotation::Aligned, Rotation::Random]))
        .with_seed(numbers.word())
        .with_normalization(numbers.pick(&[Normalization::UnitRange, Normalization::UnitVariance]));
    (spectrum.frequency(spectrum.max_octaves() - 1) < 1e30).then(|| sum.with_octaves(octaves))
}

/// Checks octaves with shapes.
fn shaped<V: Point<Coordinates = [f32; N]>, const N: usize>(numbers: &mut Numbers<'_>) {
    let Some(sum) = sum::<_, V>(Perlin::new(numbers.word()), numbers) else { return };
    match numbers.byte() % 5 {
        0 => field::<V>(&sum.with_shape(Turbulence), 1e-4, numbers),
        1 => field::<V>(&sum.with_shape(Plasma), 1e-4, numbers),
        2 => field::<V>(&sum.with_shape(Billow), 1e-4, numbers),
        3 => field::<V>(&sum.with_shape(Ridged), 1e-4, numbers),
        _ => {
            if let Ok(ridged) = RidgedMultifractal::from_fbm(sum, numbers.float()) {
                field::<V>(&ridged.with_octaves(numbers.float()), 1e-4, numbers);
            }
        }
    }
}

/// Checks a noise with second derivatives.
fn curved<V: Point>(noise: &impl HasHessian<V>, numbers: &mut Numbers<'_>)
where
    V::Matrix: AsRef<[V::Coordinates]>,
{
    let p = point(numbers);
    let (second, first) = (noise.sample_with_hessian(p), noise.sample(p));
    assert_eq!((second.value, second.gradient), (first.value, first.gradient), "{p:?}");
    let finite = |row: &V::Coordinates| row.as_ref().iter().all(|x| x.is_finite());
    assert!(second.hessian.as_ref().iter().all(finite), "{second:?} at {p:?}");
}

macro_rules! dimension {
    ($name:ident, $vector:ty, $n:literal) => {
        fn $name(numbers: &mut Numbers<'_>) {
            let seed = numbers.word();
            match numbers.byte() % 15 {
                0 => field::<$vector>(&WhiteNoise::new(seed), slack(false), numbers),
                1 => field::<$vector>(&ValueNoise::new(seed), slack(false), numbers),
                2 => field::<$vector>(&ValueCatmullRom::new(seed), slack(false), numbers),
                3 => field::<$vector>(&PerlinClassic::new(seed), slack(false), numbers),
                4 => field::<$vector>(&Perlin::new(seed), slack(false), numbers),
                5 => field::<$vector>(&GaussianNoise::new(seed), slack(false), numbers),
                6 => match ValueGradient::new(seed).with_weight(numbers.float()) {
                    Ok(noise) => field::<$vector>(&noise, slack(false), numbers),
                    Err(error) => assert_eq!(error.to_string().lines().count(), 1),
                },
                7 => field::<$vector>(&Simplex::new(seed), slack(true), numbers),
                8 => field::<$vector>(&Simplex::new(seed).with_classic_radius(), slack(true), numbers),
                9 => match SparseConvolution::new(seed).with_impulses(numbers.word() % 7) {
                    Ok(noise) => field::<$vector>(&noise, slack(false), numbers),
                    Err(error) => assert_eq!(error.to_string().lines().count(), 1),
                },
                10 => {
                    let noise = Cellular::new(seed)
                        .with_output(numbers.pick(&[
                            CellularOutput::F1,
                            CellularOutput::F2,
                            CellularOutput::F2MinusF1,
                            CellularOutput::Cell,
                        ]))
                        .with_metric(numbers.pick(&[Metric::Euclidean, Metric::Manhattan, Metric::Chebyshev]))
                        .with_jitter(numbers.float());
                    match noise {
                        Ok(noise) => field::<$vector>(&noise, slack(false), numbers),
                        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
                    }
                }
                11 => {
                    curved::<$vector>(&Perlin::new(seed), numbers);
                    curved::<$vector>(&Simplex::new(seed), numbers);
                    curved::<$vector>(&GaussianNoise::new(seed), numbers);
                    curved::<$vector>(
                        &Fbm::<_, $vector>::new(ValueNoise::new(seed), FbmSpectrum::CLOUD),
                        numbers,
                    );
                    let sum = GaussianFbm::<$vector>::new(GaussianNoise::new(seed), FbmSpectrum::default());
                    let p: $vector = point(numbers);
                    for sample in sum
                        .pair_with_octaves(p, numbers.float())
                        .into_iter()
                        .chain(GaussianNoise::new(seed).pair(p))
                    {
                        let finite = sample.gradient.coordinates().iter().all(|x| x.is_finite());
                        assert!(sample.value.is_finite() && finite, "{sample:?} at {p:?}");
                    }
                }
                12 => shaped::<$vector, $n>(numbers),
                13 => transformed::<$vector, $n>(numbers),
                _ => {
                    let periods =
                        core::array::from_fn(|_| numbers.pick(&[0, 1, 3, 5, 8, 2_097_152, u32::MAX]));
                    let Ok(noise) = Perlin::new(seed).tiled::<$n>(periods) else { return };
                    field::<$vector>(&noise, 1e-5, numbers);
                    let sum = Fbm::<_, $vector>::new(Perlin::new(seed), spectrum(numbers));
                    if let Ok(sum) = sum.tiled(periods) {
                        field::<$vector>(&sum, 1e-4, numbers);
                    }
                }
            }
        }
    };
}

dimension!(line, f32, 1);
dimension!(plane, Vec2, 2);
dimension!(space, Vec3, 3);
dimension!(hyperspace, Vec4, 4);

fn rest(numbers: &mut Numbers<'_>) {
    let seed = numbers.word();
    let periods: [u32; 3] = core::array::from_fn(|_| numbers.pick(&[0, 1, 3, 9, 2_097_150, u32::MAX]));
    if let Ok(noise) = Simplex::new(seed).tiled(periods) {
        field::<Vec3>(&noise, slack(true), numbers);
    }
    let share = filtered_fraction(numbers.float(), numbers.float());
    assert!((0.0..=1.0).contains(&share), "{share}");
    assert!(pixel_footprint(numbers.vector(), numbers.vector()) >= 0.0);
    let noise = Fbm::new(Perlin::new(seed), FbmSpectrum::CLOUD);
    if let Ok(warp) = Warp::new(noise, [Simplex::new(1), Simplex::new(2), Simplex::new(3)], numbers.share()) {
        field::<Vec3>(&warp, 1e-4, numbers);
    }
    let p = numbers.vector();
    assert!(curl::Curl2(noise_2(seed)).velocity(p.truncate()).is_finite());
    let flow = curl::CurlPotential([Simplex::new(seed), Simplex::new(1), Simplex::new(2)]);
    assert!(flow.velocity(p).is_finite(), "{p}");
    let flow = curl::Curl3(noise, Simplex::new(seed)).velocity_and_jacobian(p);
    assert!(flow.velocity.is_finite() && flow.jacobian.as_flattened().iter().all(|x| x.is_finite()), "{p}");
}

fn noise_2(seed: u32) -> Fbm<Perlin, Vec2> {
    Fbm::new(Perlin::new(seed), FbmSpectrum::CLOUD)
}

pub(crate) fn attack(numbers: &mut Numbers<'_>) {
    match numbers.byte() % 6 {
        0 => line(numbers),
        1 => plane(numbers),
        2 => space(numbers),
        3 => hyperspace(numbers),
        4 => many(numbers),
        _ => rest(numbers),
    }
}
