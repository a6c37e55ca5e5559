//! Tileable simplex noise.

use asperity_noise::{Field, NoiseError, Simplex, glam::Vec3};

#[test]
fn tiled_simplex_rejects_invalid_periods() {
    assert_eq!(Simplex::new(0).with_classic_radius().tiled([3, 6, 300]).unwrap().periods(), &[3, 6, 300]);
    let error = NoiseError::PeriodMultiple { axis: 1, period: 4, factor: 3 };
    assert_eq!(Simplex::new(0).with_classic_radius().tiled([3, 4, 6]), Err(error));
    assert!(Simplex::new(0).with_classic_radius().tiled([0, 3, 6]).is_err());
}

#[test]
fn tiled_simplex_repeats_along_every_axis() {
    let periods = Vec3::new(3.0, 6.0, 9.0);
    for kernel in [Simplex::new(0), Simplex::new(0).with_classic_radius()] {
        let noise = kernel.tiled([3, 6, 9]).unwrap();
        let mut others = 0;
        for i in 0..400_i16 {
            let p = Vec3::new(0.375 * f32::from(i), 11.25 - 0.625 * f32::from(i), -0.875 * f32::from(i % 37));
            let here = noise.with_seed(4).sample(p);
            for axis in 0..3 {
                for turns in [1.0, -3.0, 1000.0] {
                    let there = noise.with_seed(4).sample(p + turns * periods * Vec3::AXES[axis]);
                    assert_eq!(here.value.to_bits(), there.value.to_bits(), "{p}, axis {axis}");
                    assert_eq!(here.gradient, there.gradient, "{p}, axis {axis}");
                }
            }
            let half = [Vec3::new(0.0, 3.0, 0.0), Vec3::new(0.0, 0.0, 3.0)];
            others += half.iter().filter(|&&step| noise.with_seed(4).value(p + step) == here.value).count();
        }
        // Of 800 points. Where only one corner is near, one of twelve gradients is the same by
        // chance.
        assert!(others < 80, "{others}");
    }
}
