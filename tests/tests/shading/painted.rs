//! Painted densities in the microfacet model: masking, energy, samples against their density.

use asperity_ndf_sampling::{Masked, Measure, NdfMap, Reconstruction};
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::ndf_sampling::{Isotropic, Microfacet};
use asperity_shading::{Brdf, CookTorrance};

/// Paintings: smooth, with edges, of one texel, with nonzero mean; and a ring of tilts.
fn painted() -> Vec<(&'static str, Box<dyn Microfacet>)> {
    let map = |kind, f: fn(Vec3) -> f32| {
        Box::new(Masked::new(
            NdfMap::from_fn(32, 32, Measure::ProjectedSolidAngle, kind, f).expect("a painting"),
        ))
    };
    let ring = Isotropic::new(&[0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.5]).expect("a table");
    vec![
        (
            "two lobes",
            map(Reconstruction::Bilinear, |n| {
                let lobe = |x: f32| (-40.0 * ((n.x - x).powi(2) + n.y * n.y)).exp();
                lobe(-0.5) + lobe(0.5) + 0.01
            }),
        ),
        (
            "stripes",
            map(Reconstruction::Constant, |n| if (8.0 * n.x).floor() % 2.0 == 0.0 { 1.0 } else { 0.1 }),
        ),
        ("tilted", map(Reconstruction::Constant, |n| if n.x > 0.2 && n.y.abs() < 0.3 { 1.0 } else { 0.0 })),
        ("ring", Box::new(Masked::new(ring))),
    ]
}

/// Samples along a side of the square.
const SIDE: u32 = 40;

#[test]
fn painted_metals_conserve_energy() {
    for (name, density) in painted() {
        let metal = CookTorrance::new(&*density, Vec3::ONE);
        for up in [0.02_f32, 0.2, 0.6, 0.95, 1.0] {
            for turn in [0.3_f32, 2.0, 4.4] {
                let wo = (Vec2::from_angle(turn) * (1.0 - up * up).max(0.0).sqrt()).extend(up);
                let (mut albedo, mut heaviest) = (0.0, 0.0_f32);
                for k in 0..SIDE * SIDE {
                    let u = Vec2::new((k % SIDE) as f32 + 0.5, (k / SIDE) as f32 + 0.5) / SIDE as f32;
                    let weight = metal.sample(wo, 0.5, u).map_or(0.0, |sample| sample.weight().x);
                    heaviest = heaviest.max(weight);
                    albedo += weight / (SIDE * SIDE) as f32;
                }
                // Rounding of the half vector; measured 1 + 5e-6.
                assert!(heaviest <= 1.0 + 1e-4, "{name} from {wo}: a sample weighs {heaviest}");
                assert!(albedo <= 1.0 + 1e-5, "{name} from {wo}: albedo {albedo}");
            }
        }
    }
}
