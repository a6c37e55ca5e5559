//! Invalid input: each gives a one-line error with the parameter and its value.

use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, Blend, BlinnPhong, ConditionalTable, GaussianDistribution, Ggx, Isotropic,
    KurtoticDistribution, Measure, Mixture, NdfError, NdfEstimator, NdfMap, NoiseCdfRef, NormalLut,
    OffsetBeckmann, Reconstruction, Rotated, StudentT, Ward, estimate_ndf, normal_table::TableLayout,
};
use glam::{Vec2, Vec3};

/// Asserts that the error is `line`, which is lower case and has no period.
#[track_caller]
fn refused<T, E: core::error::Error>(result: Result<T, E>, line: &str) {
    let error = result.err().map(|error| error.to_string());
    assert_eq!(error.as_deref(), Some(line));
    let word = line.strip_prefix('`').unwrap_or(line);
    assert!(!line.contains('\n') && !line.ends_with('.') && word.starts_with(char::is_lowercase), "{line:?}");
}

#[test]
fn roughness() {
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, -0.0, -0.3] {
        let lines =
            ["x", "y"].map(|axis| format!("`alpha_{axis}` must be between 1e-6 and 1e6, got {value}"));
        refused(Ggx::new(value, 0.5), &lines[0]);
        refused(Ggx::new(0.5, value), &lines[1]);
        refused(Ggx::isotropic(value), &lines[0]);
        refused(Beckmann::new(value, 0.5), &lines[0]);
        refused(Beckmann::new(0.5, value), &lines[1]);
        refused(Beckmann::isotropic(value), &lines[0]);
        refused(Ward::new(value, 0.5), &lines[0]);
        refused(StudentT::new(0.5, value, 2.0), &lines[1]);
        // `new_clamped` accepts what the constructor rejects.
        for repaired in
            [Ggx::new_clamped(value, value).alpha_x(), Beckmann::new_clamped(value, value).alpha_y()]
        {
            assert!(Ggx::new(repaired, repaired).is_ok(), "{value} became {repaired}");
        }
    }
    refused(Ggx::new(1e-7, 0.5), "`alpha_x` must be between 1e-6 and 1e6, got 1e-7");
    refused(Ggx::new(0.5, f32::MAX), "`alpha_y` must be between 1e-6 and 1e6, got 3.4028235e38");
    let Err(NdfError::OutOfRange { parameter, value, .. }) = Ggx::new(-1.0, 0.5) else { panic!("refused") };
    assert_eq!((parameter, value), ("alpha_x", -1.0));
}

#[test]
fn facets() {
    for (value, name) in [(f32::NAN, "NaN"), (f32::INFINITY, "inf"), (-1.0, "-1"), (3e12, "3e12")] {
        let line =
            |parameter: &str, range: &str| format!("`{parameter}` must be between {range}, got {name}");
        refused(StudentT::new(0.5, 0.5, value), &line("gamma", "1.51 and 1e12"));
        refused(BlinnPhong::new(value), &line("exponent", "0 and 2e12"));
        refused(BlinnPhong::from_roughness(value), &line("roughness", "1e-6 and 1"));
        refused(AshikhminShirley::new(value, 1.0), &line("n_u", "0 and 2e12"));
        refused(AshikhminShirley::new(1.0, value), &line("n_v", "0 and 2e12"));
        // `new_clamped` accepts what the constructor rejects.
        assert!(BlinnPhong::new(BlinnPhong::new_clamped(value).exponent()).is_ok(), "{value}");
        let repaired = AshikhminShirley::new_clamped(value, value);
        assert!(AshikhminShirley::new(repaired.n_u(), repaired.n_v()).is_ok(), "{value}");
        let repaired = StudentT::new_clamped(value, value, value);
        assert!(StudentT::new(repaired.alpha_x(), repaired.alpha_y(), repaired.gamma()).is_ok(), "{value}");
    }
    refused(StudentT::new(0.5, 0.5, 1.5), "`gamma` must be between 1.51 and 1e12, got 1.5");
    refused(BlinnPhong::from_roughness(1.1), "`roughness` must be between 1e-6 and 1, got 1.1");
    let (ggx, oval) = (Ggx::isotropic(0.3).unwrap(), Ggx::new(0.2, 0.4).unwrap());
    refused(Mixture::new(ggx, ggx, f32::NAN), "`weight` must be between 0 and 1, got NaN");
    let line = "must depend on the tilt alone, got an NDF that depends on the azimuth";
    refused(Mixture::new(oval, ggx, 0.5), &format!("`a` {line}"));
    refused(Mixture::new(ggx, oval, 0.5), &format!("`b` {line}"));
    refused(Blend::new(oval, ggx, 1.5), "`weight` must be between 0 and 1, got 1.5");
    let line = "`angle` must be between -3.4028235e38 and 3.4028235e38, got inf";
    refused(Rotated::new(oval, f32::INFINITY), line);
    let covariance = |x, covariance| OffsetBeckmann::new(Vec2::new(x, 0.0), covariance);
    let line = "`mean.x` must be between -1e9 and 1e9, got NaN";
    refused(covariance(f32::NAN, [1.0, 0.0, 1.0]), line);
    for bad in
        [[1.0, 2.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, -1.0], [1.0, f32::NAN, 1.0], [f32::INFINITY, 0.0, 1.0]]
    {
        let line = format!("`covariance` must be positive definite and at most 1e18, got {bad:?}");
        refused(covariance(0.0, bad), &line);
    }
}

#[test]
fn tables_over_the_cosine() {
    refused(Isotropic::new(&[1.0]), "`nodes` must be between 2 and 1048576, got 1");
    refused(
        Isotropic::from_fn(usize::MAX, |_| 1.0),
        "`nodes` must be between 2 and 1048576, got 18446744073709551615",
    );
    refused(Isotropic::new(&[1.0, -2.0]), "`values[1]` must be finite and not negative, got -2");
    refused(Isotropic::new(&[f32::NAN, 1.0]), "`values[0]` must be finite and not negative, got NaN");
    refused(
        Isotropic::new(&[1.0, 2.0, f32::INFINITY]),
        "`values[2]` must be finite and not negative, got inf",
    );
    refused(Isotropic::new(&[0.0; 4]), "`values` must have weight above the horizon, got none");
    refused(Isotropic::pack(&[1.0; 2], &mut [0.0; 5]), "`storage` must have 6 elements, got 5");
    refused(Isotropic::from_packed(&[]), "`nodes` must be between 2 and 1048576, got 0");
    refused(Isotropic::from_packed(&[1.0; 8]), "`packed` must have 6 elements, got 8");
    refused(Isotropic::from_packed(&[f32::NAN; 6]), "`packed[0]` must be finite and not negative, got NaN");
    let table = Isotropic::new(&[0.5, 1.0, 4.0]).unwrap();
    let mut broken = table.packed().to_vec();
    broken[4] = 2.0;
    refused(
        Isotropic::from_packed(&broken),
        "`packed` must have a CDF that increases from 0 to 1, got another at node 1",
    );
}

#[test]
fn images() {
    let both = |width, height, texels: &[f32], line: &str| {
        for measure in [Measure::ProjectedSolidAngle, Measure::SolidAngle] {
            for kind in [Reconstruction::Constant, Reconstruction::Bilinear] {
                refused(NdfMap::from_texels(width, height, texels, measure, kind), line);
            }
        }
    };
    both(0, 4, &[], "`width · height` must be between 1 and 16777216, got 0");
    both(3, 0, &[], "`width · height` must be between 1 and 16777216, got 0");
    both(1 << 13, 1 << 12, &[], "`width · height` must be between 1 and 16777216, got 33554432");
    let line = "`width · height` must be between 1 and 16777216, got 18446744073709551615";
    both(usize::MAX, 2, &[1.0], line);
    both(2, 2, &[1.0; 3], "`texels` must have 4 elements, got 3");
    both(4, 4, &[0.0; 16], "`texels` must have weight above the horizon, got none");
    for (bad, name) in [(f32::NAN, "NaN"), (f32::INFINITY, "inf"), (-0.5, "-0.5")] {
        let mut texels = [1.0; 16];
        texels[9] = bad;
        both(4, 4, &texels, &format!("`texels[9]` must be finite and not negative, got {name}"));
        let painted = |n: Vec3| if n.x > 0.5 { bad } else { 1.0 };
        let map = NdfMap::from_fn(4, 4, Measure::ProjectedSolidAngle, Reconstruction::Constant, painted);
        refused(map, &format!("`texels[3]` must be finite and not negative, got {name}"));
    }
    // One pixel, and the largest and smallest values, are valid densities.
    for value in [1.0, f32::MAX, f32::MIN_POSITIVE, 1e-45] {
        for (size, measure) in [(1, Measure::ProjectedSolidAngle), (2, Measure::SolidAngle)] {
            let texels = [value; 4];
            let map =
                NdfMap::from_texels(size, size, &texels[..size * size], measure, Reconstruction::Constant);
            assert!(map.is_ok(), "{value}");
        }
    }
}

#[test]
fn estimates() {
    refused(NdfEstimator::new(0, 0.1), "`size` must be between 1 and 4096, got 0");
    refused(NdfEstimator::new(4097, 0.1), "`size` must be between 1 and 4096, got 4097");
    refused(NdfEstimator::new(8, f32::NAN), "`width` must be between 0 and 1, got NaN");
    refused(NdfEstimator::new(8, -0.5), "`width` must be between 0 and 1, got -0.5");
    for normals in [&[][..], &[Vec3::NAN, Vec3::splat(2.0), Vec3::INFINITY]] {
        refused(estimate_ndf(normals), "`normals` must have weight above the horizon, got none");
    }
}

#[test]
fn tables() {
    let ggx = Ggx::isotropic(0.5).unwrap();
    for size in [0, 4097, usize::MAX] {
        let line = format!("`size` must be between 1 and 4096, got {size}");
        refused(NormalLut::new(&ggx, size), &line);
        refused(NormalLut::from_entries(size, TableLayout::default(), &[[0.0_f32; 2]; 3]), &line);
        refused(ConditionalTable::new(&ggx, size), &line);
        refused(ConditionalTable::from_entries(size, Vec2::ONE, &[[0.0; 3]; 3]), &line);
    }
    let line = "`entries` must have 4 elements, got 3";
    refused(NormalLut::from_entries(2, TableLayout::default(), &[[0.0_f32; 2]; 3]), line);
    refused(ConditionalTable::from_entries(2, Vec2::ONE, &[[0.0; 3]; 3]), line);
}

#[test]
fn distributions_of_noise() {
    let line = "must be in [0, 1] and not below the previous entry";
    for (range, table, line) in [
        (f32::NAN, &[0.0, 1.0][..], "`range` must be positive and finite, got NaN"),
        (0.0, &[0.0, 1.0], "`range` must be positive and finite, got 0"),
        (-1.0, &[0.0, 1.0], "`range` must be positive and finite, got -1"),
        (1.0, &[], "`table.len()` must be at least 2, got 0"),
        (1.0, &[0.5], "`table.len()` must be at least 2, got 1"),
        (1.0, &[0.0, f32::NAN, 1.0], &*format!("`table[1]` {line}, got NaN")),
        (1.0, &[0.0, 1.5], &*format!("`table[1]` {line}, got 1.5")),
        (1.0, &[0.0, 0.5, 0.25], &*format!("`table[2]` {line}, got 0.25")),
        (1.0, &[0.5, 0.5], "`table` must be increasing somewhere, got 0.5"),
    ] {
        refused(NoiseCdfRef::new(range, table), line);
    }
    let between = |low, high| NoiseCdfRef::between(low, high, &[0.0, 1.0]);
    refused(between(1.0, 1.0), "`low` and `high` must be finite and increasing, got 1 and 1");
    refused(between(f32::NAN, 1.0), "`low` and `high` must be finite and increasing, got NaN and 1");
    assert!(between(-3e38, 3e38).is_err());
    let deviation = "`deviation` must be between 1.1754944e-38 and 3.4028235e38, got";
    for (value, name) in [(-1.0, "-1"), (f32::NAN, "NaN"), (f32::INFINITY, "inf")] {
        refused(GaussianDistribution::new(value), &format!("{deviation} {name}"));
        refused(KurtoticDistribution::new(value, 0.0), &format!("{deviation} {name}"));
    }
    refused(KurtoticDistribution::new(1.0, 2.5), "`kurtosis` must be between -1.5 and 2, got 2.5");
    refused(KurtoticDistribution::new(1.0, f32::NAN), "`kurtosis` must be between -1.5 and 2, got NaN");
}
