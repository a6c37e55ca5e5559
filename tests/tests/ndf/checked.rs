//! The public checks pass right densities; masking by tables of GGX is that of GGX.

use asperity_ndf_sampling::check::{Settings, ndf};
use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, BlinnPhong, Ggx, Isotropic, Masked, Measure, Microfacet, Mixture, Ndf,
    NdfMap, Reconstruction, Rotated, StudentT, Ward,
};
use asperity_tests::assert_abs_diff_eq;
use glam::{Vec2, Vec3};
use rayon::prelude::*;

#[test]
fn right_densities_pass() {
    let quick = Settings { samples: 1 << 14, ..Settings::default() };
    let ggx = Ggx::new(0.5, 0.05).unwrap();
    let beckmann = Beckmann::isotropic(0.3).unwrap();
    let mixture =
        Mixture::new(Beckmann::isotropic(0.02).unwrap(), BlinnPhong::new(0.0).unwrap(), 0.6).unwrap();
    let hills = |n: Vec3| (9.0 * n.x).sin() * (7.0 * n.y + 1.0).cos() + 1.1;
    let painted = NdfMap::from_fn(24, 24, Measure::Normals, Reconstruction::Bilinear, hills).unwrap();
    let steps = NdfMap::from_fn(16, 16, Measure::Normals, Reconstruction::Constant, hills).unwrap();
    let (painted, steps) = (Masked::new(painted), Masked::new(steps));
    let all: [(&str, &(dyn Ndf + Sync)); 10] = [
        ("GGX", &ggx),
        ("narrow GGX", &Ggx::isotropic(1e-4).unwrap()),
        ("rough Beckmann", &Beckmann::isotropic(2.0).unwrap()),
        ("Ward", &Ward::new(0.1, 0.3).unwrap()),
        ("Student-t", &StudentT::new(0.2, 0.3, 2.5).unwrap()),
        ("Ashikhmin–Shirley", &AshikhminShirley::new(20.0, 300.0).unwrap()),
        ("Beckmann and diffuse", &mixture),
        ("turned", &Rotated::new(ggx, 0.7).unwrap()),
        ("painted, bilinear", &painted),
        ("painted, in steps", &steps),
    ];
    all.into_par_iter().for_each(|(name, density)| {
        let report = ndf(density, quick);
        println!("{name}\n{report}");
        assert!(report.passed(), "{name}\n{report}");
        assert_eq!(report, ndf(density, quick), "the same seed");
    });
    assert!(ndf(&beckmann, Settings::default()).passed());
}

#[test]
fn a_right_density_passes_a_thousand_seeds() {
    let ggx = Ggx::new(0.2, 0.4).unwrap();
    let beckmann = Beckmann::new(0.3, 0.1).unwrap();
    (0..1000).into_par_iter().for_each(|seed| {
        let settings = Settings { seed, samples: 4096, ..Settings::default() };
        let report = if seed % 2 == 0 { ndf(&ggx, settings) } else { ndf(&beckmann, settings) };
        assert!(report.passed(), "{seed}\n{report}");
    });
}

#[test]
fn tables_of_ggx_have_its_masking() {
    let ggx = Ggx::new(0.3, 0.6).unwrap();
    let masked = Masked::new(NdfMap::from_ndf(256, 256, Reconstruction::Bilinear, &ggx).unwrap());
    let mut worst = [0.0_f32; 2];
    for k in 0..2000 {
        let (up, azimuth) = ((k as f32 * 0.618_034).fract(), k as f32 * 2.4);
        let v = (Vec2::from_angle(azimuth) * (1.0 - up * up).sqrt()).extend(up);
        let area = masked.projected_area(v) / ggx.projected_area(v);
        assert_abs_diff_eq!(masked.g1(v), ggx.g1(v), epsilon = 5e-4, "{v}");
        assert_abs_diff_eq!(area, 1.0, epsilon = 1e-3, "{v}");
        worst = [worst[0].max((masked.g1(v) - ggx.g1(v)).abs()), worst[1].max((area - 1.0).abs())];
    }
    println!("G1 {:.1e}, projected area {:.1e}", worst[0], worst[1]);
    let ggx = Ggx::isotropic(0.4).unwrap();
    let at = |cos: f32| ggx.density(Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos.max(1e-9)));
    let masked = Masked::new(Isotropic::from_fn(4001, at).unwrap());
    for up in [1e-3_f32, 0.05, 0.3, 0.7, 0.99] {
        let v = Vec3::new((1.0 - up * up).sqrt(), 0.0, up);
        assert_abs_diff_eq!(masked.g1(v), ggx.g1(v), epsilon = 2e-4, "{v}");
    }
}
