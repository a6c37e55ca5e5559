//! Lists and grids of shaped sums and of composed fields compared with single points, bit by bit.

use super::compare::{far_cases, grids, lengths, near_cases, points};
use asperity_noise::{
    Fbm, FbmSpectrum, Field, RidgedMultifractal, Rotation, Sample, Simplex, Turbulence, Warp,
    glam::Vec2,
    ops::{Add, Blend, Clamp, Frequency, Map, Multiply, Power, ScaleBias, Unit},
};

/// Grids, rows of many lengths and lists, at every level.
fn same_bits(name: &str, field: &dyn Field<Vec2>) {
    grids(name, field, &near_cases()[..4]);
    grids(name, field, &far_cases());
    lengths(name, field);
    points(name, field, 700);
}

#[test]
fn batches_of_shaped_sums_match_points() {
    let octaves = Fbm::<_, Vec2>::new(Simplex::new(4), FbmSpectrum::default()).with_octaves(3.5);
    for rotation in [Rotation::Random, Rotation::Aligned] {
        let turbulence = octaves.with_rotation(rotation).with_shape(Turbulence);
        for footprint in [0.0, 0.1, 9.0] {
            let name = format!("{rotation:?}, footprint {footprint}");
            grids(&name, &turbulence.band_limited(footprint) as &dyn Field<Vec2>, &near_cases()[..4]);
        }
    }
    same_bits("turned turbulence", &octaves.with_shape(Turbulence));
    same_bits("aligned turbulence", &octaves.with_rotation(Rotation::Aligned).with_shape(Turbulence));
}

#[test]
fn batches_of_ridged_multifractal_match_points() {
    let ridges = RidgedMultifractal::<_, Vec2>::new(Simplex::new(1), FbmSpectrum::CLOUD, 2.0).unwrap();
    same_bits("ridged multifractal, squared", &Power(ridges.with_octaves(3.5), 2));
}

/// A custom field, a plane wave, evaluated point by point.
struct Wave;

impl Field<Vec2> for Wave {
    fn sample(&self, p: Vec2) -> Sample<Vec2> {
        Sample { value: (2.0 * p.x + p.y).sin(), gradient: Vec2::new(2.0, 1.0) * (2.0 * p.x + p.y).cos() }
    }
}

/// Fields that own their parts, selected at run time.
fn composed(which: usize) -> Box<dyn Field<Vec2>> {
    let by = [1, 2].map(|seed| Fbm::new(Simplex::new(seed), FbmSpectrum::CLOUD).with_octaves(2.0));
    let noise = || Simplex::new(7);
    match which {
        0 => Box::new(Add(noise(), Wave)),
        1 => Box::new(Multiply(Wave, noise())),
        2 => Box::new(Blend(noise(), Wave, Unit(Simplex::new(5)))),
        3 => Box::new(Clamp(noise(), -0.2, 0.1)),
        4 => Box::new(Map(noise(), |n: f32| n * n * n, |n: f32| 3.0 * (n * n))),
        5 => Box::new(ScaleBias(Frequency(noise(), -1.5), -2.0, 3.0)),
        6 => Box::new(Warp::new(noise(), by, 0.3).expect("a finite amplitude")),
        7 => Box::new(Warp::new(composed(6), [composed(0), composed(3)], 0.2).expect("a finite amplitude")),
        _ => Box::new(Add(composed(6), Multiply(composed(2), composed(4)))),
    }
}

#[test]
fn batches_of_composed_fields_match_points() {
    for which in 0..9 {
        let field = composed(which);
        grids(&format!("composed {which}"), field.as_ref(), &near_cases()[..3]);
        lengths(&format!("composed {which}"), field.as_ref());
        points(&format!("composed {which}"), field.as_ref(), 700);
    }
}

#[test]
fn gradients_of_composed_fields_match_differences() {
    const H: f32 = 1.0 / 1024.0;
    for which in (0..9).filter(|&which| which != 3) {
        let field = composed(which);
        let mut worst = 0.0_f32;
        for i in 0..200_u16 {
            let p = Vec2::new(0.037 * f32::from(i) - 3.0, 2.0 - 0.0213 * f32::from(i));
            // There is a crease within H times a slope of where the clamp of a warp begins.
            let clamped = Simplex::new(7).value(p);
            if which == 7 && [-0.2, 0.1].iter().any(|limit| (clamped - limit).abs() < 0.02) {
                continue;
            }
            let gradient = field.sample(p).gradient;
            let slope = |d: Vec2| (field.value(p + d) - field.value(p - d)) / (2.0 * H);
            let difference = Vec2::new(slope(Vec2::new(H, 0.0)), slope(Vec2::new(0.0, H)));
            worst = worst.max((gradient - difference).length() / (1.0 + gradient.length()));
        }
        // H²/6 times third derivatives, which reach some ten thousand in warps, and the rounding of
        // values, 4e-7, over H.
        assert!(worst < if which > 6 { 0.05 } else { 4e-3 }, "composed {which}: {worst:e}");
    }
    let (clamped, whole) = (Clamp(Simplex::new(7), -0.2, 0.1), Simplex::new(7));
    for i in 0..200_u16 {
        let p = Vec2::new(0.037 * f32::from(i), 0.41);
        let (cut, full) = (clamped.sample(p), whole.sample(p));
        let inside = full.value > -0.2 && full.value < 0.1;
        assert_eq!(cut.gradient, if inside { full.gradient } else { Vec2::ZERO });
    }
}

#[test]
fn ranges_of_composed_fields_contain_values() {
    for which in 0..9 {
        let field = composed(which);
        let [low, high] = field.range();
        let unit = Unit(&field);
        for i in 0..400_u16 {
            let p = Vec2::new(0.137 * f32::from(i) - 3.0, 2.0 - 0.213 * f32::from(i));
            let value = field.value(p);
            assert!((low..=high).contains(&value), "composed {which}: {value}");
            assert!((0.0..=1.0).contains(&unit.value(p)), "composed {which}");
        }
    }
}
