//! Bad input: each gets one clear line, which names the culprit and its value.

use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, Blend, BlinnPhong, Ggx, Isotropic, IsotropicRef, Measure, Mixture, NdfMap,
    NoiseCdfRef, NormalTable, RangeError, Reconstruction, Rotated, StudentT, Ward,
};

/// One line, lower case, without a full stop, with every one of `parts`.
fn check(error: &dyn core::error::Error, parts: &[&str]) {
    let line = error.to_string();
    assert!(!line.contains('\n') && !line.ends_with('.') && line.starts_with(char::is_lowercase), "{line:?}");
    for part in parts {
        assert!(line.contains(part), "{line:?} lacks {part:?}");
    }
}

#[test]
fn roughness() {
    for (value, name) in [
        (f32::NAN, "NaN"),
        (f32::INFINITY, "inf"),
        (f32::NEG_INFINITY, "-inf"),
        (0.0, "0"),
        (-0.0, "-0"),
        (-0.3, "-0.3"),
        (1e-30, "1e-30"),
        (f32::MAX, "3.4028235e38"),
    ] {
        check(&Ggx::new(value, 0.5).unwrap_err(), &["alpha_x", name]);
        check(&Ggx::new(0.5, value).unwrap_err(), &["alpha_y", name]);
        check(&Beckmann::new(value, 0.5).unwrap_err(), &["alpha_x", name]);
        check(&Beckmann::new(0.5, value).unwrap_err(), &["alpha_y", name]);
        check(&Ggx::isotropic(value).unwrap_err(), &["alpha_x", name]);
        check(&Beckmann::isotropic(value).unwrap_err(), &["alpha_x", name]);
        // What a constructor refuses, the repair accepts.
        for repaired in [Ggx::clamped(value, value).alpha_x(), Beckmann::clamped(value, value).alpha_y()] {
            assert!(Ggx::new(repaired, repaired).is_ok(), "{value} became {repaired}");
        }
    }
    let RangeError { parameter, value, .. } = Ggx::new(-1.0, 0.5).unwrap_err();
    assert_eq!((parameter, value), ("alpha_x", -1.0));
}

#[test]
fn facets() {
    check(&StudentT::new(0.5, f32::NAN, 2.0).unwrap_err(), &["alpha_y", "NaN"]);
    check(&Ward::new(-0.5, 0.5).unwrap_err(), &["alpha_x", "-0.5"]);
    for (value, name) in [(f32::NAN, "NaN"), (f32::INFINITY, "inf"), (-1.0, "-1"), (3e12, "3e12")] {
        check(&StudentT::new(0.5, 0.5, value).unwrap_err(), &["gamma", name]);
        check(&BlinnPhong::new(value).unwrap_err(), &["exponent", name]);
        check(&BlinnPhong::from_roughness(value).unwrap_err(), &["roughness", name]);
        check(&AshikhminShirley::new(value, 1.0).unwrap_err(), &["n_u", name]);
        check(&AshikhminShirley::new(1.0, value).unwrap_err(), &["n_v", name]);
        // What a constructor refuses, the repair accepts.
        assert!(BlinnPhong::new(BlinnPhong::clamped(value).exponent()).is_ok(), "{value}");
        let repaired = AshikhminShirley::clamped(value, value);
        assert!(AshikhminShirley::new(repaired.n_u(), repaired.n_v()).is_ok(), "{value}");
        let repaired = StudentT::clamped(value, value, value);
        assert!(StudentT::new(repaired.alpha_x(), repaired.alpha_y(), repaired.gamma()).is_ok(), "{value}");
    }
    let (ggx, turned) = (Ggx::isotropic(0.3).unwrap(), Ggx::new(0.2, 0.4).unwrap());
    check(&Mixture::new(ggx, ggx, 1.5).unwrap_err(), &["weight", "1.5"]);
    check(&Mixture::new(turned, ggx, 0.5).unwrap_err(), &["density a"]);
    check(&Blend::new(turned, ggx, f32::NAN).unwrap_err(), &["weight", "NaN"]);
    check(&Rotated::new(turned, f32::INFINITY).unwrap_err(), &["angle", "inf"]);
    check(&Isotropic::new(&[1.0]).unwrap_err(), &["nodes", "1"]);
    check(&Isotropic::new(&[1.0, 2.0, f32::INFINITY]).unwrap_err(), &["density 2", "inf"]);
    check(&Isotropic::new(&[-0.5, 2.0]).unwrap_err(), &["density 0", "-0.5"]);
    check(&Isotropic::new(&[0.0; 7]).unwrap_err(), &["7"]);
    check(&Isotropic::from_fn(0, |_| 1.0).unwrap_err(), &["nodes", "0"]);
    check(&IsotropicRef::pack(&[1.0, 2.0], &mut []).unwrap_err(), &["6", "0"]);
    check(&IsotropicRef::new(&[f32::NAN; 6]).unwrap_err(), &["density 0", "NaN"]);
    check(&IsotropicRef::new(&[1.0; 6]).unwrap_err(), &["node 0"]);
}

#[test]
fn images() {
    let refused = |width, height, texels: &[f32]| {
        [Measure::Normals, Measure::SolidAngle].map(|measure| {
            NdfMap::from_texels(width, height, texels, measure, Reconstruction::Constant).unwrap_err()
        })
    };
    for error in refused(0, 0, &[]).iter().chain(&refused(3, 0, &[])) {
        check(error, &["size must be 1 to", "0"]);
    }
    for error in refused(4, 4, &[0.0; 16]) {
        check(&error, &["black", "4 × 4"]);
    }
    for error in refused(4, 4, &[1.0; 15]) {
        check(&error, &["16", "15"]);
    }
    for error in refused(1 << 20, 1 << 20, &[1.0]).iter().chain(&refused(usize::MAX, usize::MAX, &[1.0])) {
        check(error, &["size must be 1 to"]);
    }
    for (bad, name) in [(f32::NAN, "NaN"), (f32::INFINITY, "inf"), (-2.0, "-2")] {
        let mut texels = [1.0; 16];
        texels[9] = bad;
        for error in refused(4, 4, &texels) {
            check(&error, &["texel 9", name]);
        }
        let error =
            NdfMap::from_texels(4, 4, &texels, Measure::Normals, Reconstruction::Bilinear).unwrap_err();
        check(&error, &["texel 9", name]);
        let error = NdfMap::from_fn(4, 4, Measure::Normals, Reconstruction::Constant, |n| {
            if n.x > 0.5 { bad } else { 1.0 }
        })
        .unwrap_err();
        check(&error, &["texel", name]);
    }
    // One pixel, the largest and the smallest values are densities.
    for value in [1.0, f32::MAX, f32::MIN_POSITIVE, 1e-45] {
        assert!(
            NdfMap::from_texels(1, 1, &[value], Measure::Normals, Reconstruction::Constant).is_ok(),
            "{value}"
        );
        assert!(
            NdfMap::from_texels(2, 2, &[value; 4], Measure::SolidAngle, Reconstruction::Constant).is_ok(),
            "{value}"
        );
    }
}

#[test]
fn tables() {
    let ggx = Ggx::isotropic(0.5).unwrap();
    check(&NormalTable::new(&ggx, 0).unwrap_err(), &["size", "0"]);
    check(&NormalTable::new(&ggx, usize::MAX).unwrap_err(), &["size", "18446744073709551615"]);
    check(&NoiseCdfRef::new(-1.0, &[0.0, 1.0]).unwrap_err(), &["range", "-1"]);
    check(&NoiseCdfRef::new(1.0, &[0.0]).unwrap_err(), &["two entries", "1"]);
    check(&NoiseCdfRef::new(1.0, &[0.0, 0.7, 0.6, 1.0]).unwrap_err(), &["entry 2", "0.6"]);
    check(&NoiseCdfRef::new(1.0, &[0.0, f32::NAN]).unwrap_err(), &["entry 1", "NaN"]);
}
