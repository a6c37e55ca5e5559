//! Visible normals for reflections: their density, and what they save.

use asperity_ndf_sampling::check::{Cells, p_value};
use asperity_ndf_sampling::{
    Beckmann, Ggx, Microfacet, Rotated,
    glam::{Vec2, Vec3},
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;
use rayon::prelude::*;

const ALPHAS: [[f32; 2]; 6] = [[0.1, 0.1], [0.3, 0.3], [0.6, 0.6], [1.0, 1.0], [0.5, 0.2], [3.0, 1.5]];
const TILTS: [f32; 5] = [0.0, 30.0, 60.0, 80.0, 89.0];

fn cases() -> Vec<(Ggx, Vec3)> {
    let view = |degrees: f32| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Vec3::new(0.8 * sin, -0.6 * sin, cos)
    };
    let of = |[x, y]: [f32; 2]| Ggx::new(x, y).expect("a roughness");
    ALPHAS.into_iter().flat_map(|alpha| TILTS.map(|tilt| (of(alpha), view(tilt)))).collect()
}

fn uniform(random: &mut Random) -> Vec2 {
    Vec2::new(random.uniform() as f32, random.uniform() as f32)
}

#[test]
fn ggx_sample_reflecting_has_its_density() {
    const SAMPLES: usize = 1 << 15;
    let least = 1e-4 / cases().len() as f64;
    cases().into_par_iter().for_each(|(ggx, v)| {
        let mut random = Random(17);
        // Directions instead of normals, because the cap often ends at the horizon, where the
        // density jumps and cells end.
        let mut sample = || {
            let m = ggx.sample_reflecting(v, uniform(&mut random));
            2.0 * v.dot(m) * m - v
        };
        let cells = Cells::of_sphere((0..SAMPLES / 4).map(|_| sample()));
        let masses = cells.integrate(|w| {
            let m = (v + w).normalize_or(v);
            f64::from(ggx.reflecting_pdf(v, m) / (4.0 * v.dot(m)).max(1e-9))
        });
        // Measured: 1.4e-3, at the edges of caps that end below the horizon.
        assert_abs_diff_eq!(masses.iter().sum::<f64>(), 1.0, epsilon = 5e-3, "{ggx:?} {v}");
        let p = p_value(&cells.count((0..SAMPLES).map(|_| sample())), &masses, SAMPLES as u64);
        assert!(p > least, "{ggx:?} {v}: p = {p:e}");
    });
}

/// The fraction of samples that reflect below the horizon, and the mean and variance of the albedo
/// of a surface that reflects all light once.
fn furnace(ggx: Ggx, v: Vec3, sample: impl Fn(Vec2) -> Vec3, pdf: impl Fn(Vec3) -> f32) -> [f64; 3] {
    const SAMPLES: u32 = 100_000;
    let mut random = Random(23);
    let (mut lost, mut sums) = (0.0, [0.0; 2]);
    for _ in 0..SAMPLES {
        let m = sample(uniform(&mut random));
        let w = 2.0 * v.dot(m) * m - v;
        let weight = if w.z > 0.0 {
            f64::from(ggx.visible_pdf(v, m) / pdf(m) * ggx.g2(v, w) / ggx.g1(v))
        } else {
            lost += 1.0;
            0.0
        };
        sums = [sums[0] + weight, sums[1] + weight * weight];
    }
    let [mean, square] = sums.map(|sum| sum / f64::from(SAMPLES));
    [lost / f64::from(SAMPLES), mean, square - mean * mean]
}

#[test]
fn ggx_sample_reflecting_wastes_fewer_samples() {
    for (ggx, v) in cases() {
        let all = furnace(ggx, v, |u| ggx.sample_visible(v, u), |m| ggx.visible_pdf(v, m));
        let few = furnace(ggx, v, |u| ggx.sample_reflecting(v, u), |m| ggx.reflecting_pdf(v, m));
        let [x, y] = [ggx.alpha_x(), ggx.alpha_y()];
        println!(
            "α = ({x}, {y}), {:2.0}°: lost {:.3} → {:.3}, variance {:.5} → {:.5}, albedo {:.4} {:.4}",
            v.z.acos().to_degrees(),
            all[0],
            few[0],
            all[2],
            few[2],
            all[1],
            few[1],
        );
        assert!(few[0] <= all[0] && few[2] <= 1.02 * all[2], "{ggx:?} {v}");
        // Five standard errors of their difference.
        assert_abs_diff_eq!(all[1], few[1], epsilon = 5.0 * ((all[2] + few[2]) / 1e5).sqrt() + 1e-5, "{v}");
    }
}

#[test]
fn reflecting_pdf_is_at_least_the_visible_density() {
    let mut random = Random(29);
    for (ggx, v) in cases() {
        for _ in 0..1000 {
            let m = ggx.sample_visible(v, uniform(&mut random));
            if (2.0 * v.dot(m) * m - v).z > 0.0 {
                assert!(ggx.reflecting_pdf(v, m) >= 0.999_99 * ggx.visible_pdf(v, m), "{ggx:?} {v} {m}");
            }
        }
    }
}

#[test]
fn sample_reflecting_of_other_densities() {
    let (v, u) = (Vec3::new(0.6, 0.48, 0.64), Vec2::new(0.3, 0.7));
    let beckmann = Beckmann::new(0.5, 0.2).unwrap();
    let m = beckmann.sample_reflecting(v, u);
    assert_eq!(m, beckmann.sample_visible(v, u));
    assert_eq!(beckmann.reflecting_pdf(v, m), beckmann.visible_pdf(v, m));
    let turned = Rotated::new(Ggx::new(0.5, 0.2).unwrap(), core::f32::consts::FRAC_PI_2).unwrap();
    let (m, ggx) = (turned.sample_reflecting(v, u), Ggx::new(0.2, 0.5).unwrap());
    assert_abs_diff_eq!(turned.reflecting_pdf(v, m) / ggx.reflecting_pdf(v, m), 1.0, epsilon = 1e-5);
}
