//! The public property tests: valid densities pass, and each fault is detected by the corresponding
//! checks.

use asperity_ndf_sampling::check::{Settings, microfacet, ndf};
use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, BlinnPhong, Ggx, Isotropic, Masked, Measure, Microfacet, Mixture, Ndf,
    NdfMap, Reconstruction, Rotated, StudentT, Ward,
};
use asperity_tests::assert_abs_diff_eq;
use glam::{Vec2, Vec3};
use rayon::prelude::*;

fn quick(seed: u32) -> Settings {
    Settings { seed, samples: 1 << 14, ..Settings::default() }
}

#[test]
fn valid_densities_pass() {
    let mixture =
        Mixture::new(Beckmann::isotropic(0.02).unwrap(), BlinnPhong::new(0.0).unwrap(), 0.6).unwrap();
    let hills = |n: Vec3| (9.0 * n.x).sin() * (7.0 * n.y + 1.0).cos() + 1.1;
    let painted =
        NdfMap::from_fn(24, 24, Measure::ProjectedSolidAngle, Reconstruction::Bilinear, hills).unwrap();
    let steps =
        NdfMap::from_fn(16, 16, Measure::ProjectedSolidAngle, Reconstruction::Constant, hills).unwrap();
    let densities: [(&str, &(dyn Ndf + Sync)); 5] = [
        ("Ward", &Ward::new(0.1, 0.3).unwrap()),
        ("Student-t", &StudentT::new(0.2, 0.3, 2.5).unwrap()),
        ("Ashikhmin–Shirley", &AshikhminShirley::new(20.0, 300.0).unwrap()),
        ("painted, bilinear", &painted),
        ("painted, in steps", &steps),
    ];
    densities.into_par_iter().for_each(|(name, density)| {
        let report = ndf(density, quick(0));
        assert!(report.passed(), "{name}\n{report}");
    });
    let microfacets: [(&str, &(dyn Microfacet + Sync)); 5] = [
        ("narrow GGX", &Ggx::isotropic(1e-4).unwrap()),
        ("rough Beckmann", &Beckmann::isotropic(2.0).unwrap()),
        ("ridges", &Beckmann::new(1e-3, 0.5).unwrap()),
        ("Beckmann and diffuse", &mixture),
        ("turned", &Rotated::new(Ggx::new(0.5, 0.05).unwrap(), 0.7).unwrap()),
    ];
    microfacets.into_par_iter().for_each(|(name, density)| {
        let report = microfacet(density, quick(0));
        assert!(report.passed(), "{name}\n{report}");
        assert_eq!(report, microfacet(density, quick(0)), "the same seed");
    });
}

#[test]
fn valid_density_passes_for_every_seed() {
    let (ggx, beckmann) = (Ggx::new(0.2, 0.4).unwrap(), Beckmann::new(0.3, 0.1).unwrap());
    (0..100).into_par_iter().for_each(|seed| {
        let settings = Settings { samples: 4096, ..quick(seed) };
        let report = if seed % 2 == 0 { ndf(&ggx, settings) } else { ndf(&beckmann, settings) };
        assert!(report.passed(), "{seed}\n{report}");
    });
}

/// A density whose parts are modified one by one.
#[derive(Clone, Copy)]
struct Faulty {
    of: Beckmann,
    /// Factor of the density.
    bright: f32,
    /// Power of `m_z` by which the density is wrong.
    cosines: i32,
    sample: fn(Vec2) -> Vec2,
    map: fn(Vec2) -> Vec2,
    back: fn(Vec2) -> Vec2,
    on_nan: f32,
    masking: f32,
    view: fn(Vec3) -> Vec3,
}

impl Ndf for Faulty {
    fn d(&self, m: Vec3) -> f32 {
        let cosines = if self.cosines == 0 { 1.0 } else { m.z.max(0.0).powi(self.cosines) };
        if m.is_nan() { self.on_nan } else { (self.of.d(m) * self.bright * cosines).min(f32::MAX) }
    }
    fn warp_gaussian(&self, z: Vec2) -> Vec3 {
        self.of.warp_gaussian((self.map)(z))
    }
    fn invert(&self, m: Vec3) -> Vec2 {
        (self.back)(self.of.invert(m))
    }
    fn sample(&self, u: Vec2) -> Vec3 {
        self.of.sample((self.sample)(u))
    }
}

impl Microfacet for Faulty {
    fn lambda(&self, v: Vec3) -> f32 {
        self.of.lambda(v) * self.masking
    }
    fn projected_area(&self, v: Vec3) -> f32 {
        self.of.projected_area(v)
    }
    fn sample_visible(&self, v: Vec3, u: Vec2) -> Vec3 {
        self.of.sample_visible((self.view)(v), u)
    }
}

#[test]
fn faulty_densities_are_detected() {
    let right = Faulty {
        of: Beckmann::new_clamped(0.4, 0.3),
        bright: 1.0,
        cosines: 0,
        sample: |u| u,
        map: |z| z,
        back: |z| z,
        on_nan: 0.0,
        masking: 1.0,
        view: |v| v,
    };
    // E[m_z], with which the density integrates to one without its Jacobian.
    let cells = (0..40_000_u16).map(|k| Vec2::new(f32::from(k % 200), f32::from(k / 200)));
    let up = cells.map(|cell| right.of.sample((cell + 0.5) / 200.0).z).sum::<f32>() / 40_000.0;
    let cases: [(&str, Faulty, &[&str]); 11] = [
        ("right", right, &[]),
        (
            "1 % too bright",
            Faulty { bright: 1.01, ..right },
            &[
                "normalization",
                "Jacobian of the map",
                "projected area",
                "masking",
                "density of visible normals",
            ],
        ),
        (
            "cos θ lost",
            Faulty { cosines: 1, bright: 1.0 / up, ..right },
            &[
                "samples",
                "map from Gaussian coordinates",
                "Jacobian of the map",
                "projected area",
                "masking",
                "density of visible normals",
                "visible normals",
            ],
        ),
        (
            "a hole in the sampler",
            Faulty { sample: |u| if (0.4..0.45).contains(&u.x) { u + Vec2::X * 0.3 } else { u }, ..right },
            &["samples"],
        ),
        (
            "a map that is 3 % too wide",
            Faulty { map: |z| 1.03 * z, back: |z| z / 1.03, ..right },
            &["map from Gaussian coordinates", "Jacobian of the map"],
        ),
        (
            "a mirrored inverse",
            Faulty { back: |z| Vec2::new(-z.x, z.y), ..right },
            &["inverse of the map", "map of the inverse"],
        ),
        ("NaN in, NaN out", Faulty { on_nan: f32::NAN, ..right }, &["totality"]),
        ("Λ too small by 5 %", Faulty { masking: 0.95, ..right }, &["masking"]),
        (
            "Λ below 0",
            Faulty { masking: -0.5, ..right },
            &["masking", "monotonicity of masking", "totality of views"],
        ),
        ("visible normals of all", Faulty { view: |_| Vec3::Z, ..right }, &["visible normals"]),
        (
            "visible normals of six degrees off",
            Faulty { view: |v| (v + 0.1 * Vec3::X).normalize_or(v), ..right },
            &["visible normals"],
        ),
    ];
    for (name, faulty, caught) in cases {
        let report = microfacet(&faulty, Settings::default());
        assert!(report.failures().eq(caught.iter().copied()), "{name}\n{report}");
    }
}

#[test]
fn ggx_tables_have_ggx_masking() {
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
    let at = |cos: f32| ggx.d(Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos.max(1e-9)));
    let masked = Masked::new(Isotropic::from_fn(4001, at).unwrap());
    for up in [1e-3_f32, 0.05, 0.3, 0.7, 0.99] {
        let v = Vec3::new((1.0 - up * up).sqrt(), 0.0, up);
        assert_abs_diff_eq!(masked.g1(v), ggx.g1(v), epsilon = 2e-4, "{v}");
    }
}
