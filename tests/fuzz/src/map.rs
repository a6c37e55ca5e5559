//! Densities from images, normals and lists: any texels are accepted or rejected, and accepted
//! texels give a density.

use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::{
    ConditionalTable, GaussianSplit, Ggx, Isotropic, Measure, NdfEstimator, NdfMap, NormalLut, PackedMapRef,
    Reconstruction, estimate_ndf,
};

use crate::density::ndf;
use crate::numbers::Numbers;

fn texel(numbers: &mut Numbers<'_>) -> f32 {
    match numbers.byte() {
        0..=99 => f32::from(numbers.byte()) / 255.0,
        100..=159 => 0.0,
        160..=229 => numbers.float().abs(),
        _ => numbers.float(),
    }
}

/// Checks an invariant of every map: as a density or as an array.
fn check(map: &NdfMap, numbers: &mut Numbers<'_>) {
    match numbers.byte() % 4 {
        0 | 1 => ndf(map, numbers),
        _ => packed(map, numbers),
    }
}

fn packed(map: &NdfMap, numbers: &mut Numbers<'_>) {
    let array = map.array().to_vec();
    let packed = PackedMapRef::new(&array).expect("what was packed is a packed map");
    ndf(&packed, numbers);
    let (u, n) = (numbers.pair(), numbers.pair());
    assert!(packed.inverse(u).length() < 1.0 + 1e-5, "{u}");
    let back = packed.forward(n);
    assert!(back.cmpge(Vec2::ZERO).all() && back.cmple(Vec2::ONE).all(), "{n}");
    // The array may come from a corrupted file: results are then arbitrary numbers.
    let mut spoilt = array;
    for _ in 0..numbers.count(3) {
        let at = numbers.count(spoilt.len() - 1);
        spoilt[at] = numbers.float();
    }
    crate::table::packed(&spoilt, numbers);
}

pub(crate) fn attack(numbers: &mut Numbers<'_>) {
    let kind = numbers.pick(&[Reconstruction::Constant, Reconstruction::Bilinear]);
    match numbers.byte() % 5 {
        0 | 1 => {
            let size = [numbers.count(5), numbers.count(5)];
            let measure = numbers.pick(&[Measure::ProjectedSolidAngle, Measure::SolidAngle]);
            let texels: Vec<f32> = (0..size[0] * size[1]).map(|_| texel(numbers)).collect();
            match NdfMap::from_texels(size[0], size[1], &texels, measure, kind) {
                Ok(map) => check(&map, numbers),
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
        // A million texels.
        2 if numbers.is_one_in(16384) => {
            let normals = normals(numbers);
            match estimate_ndf(&normals) {
                Ok(map) => ndf(&map, numbers),
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
        2 | 3 => {
            let Ok(mut estimator) = NdfEstimator::new(numbers.count(12), numbers.float()) else { return };
            estimator.extend(normals(numbers));
            match estimator.finish() {
                Ok(map) => check(&map, numbers),
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
        _ => {
            let values = numbers.list(40, texel);
            match Isotropic::new(&values) {
                Ok(table) => {
                    ndf(&table, numbers);
                    crate::table::isotropic(table.packed(), numbers);
                }
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
            let Ok(ggx) = Ggx::new(numbers.between(1e-6, 1e6), numbers.between(1e-6, 1e6)) else { return };
            if let Ok(table) = NormalLut::new(&ggx, 1 + numbers.count(7)) {
                let (z, m) = (numbers.pair(), table.nearest(numbers.pair()).normal);
                assert!((m.length() - 1.0).abs() < 1e-5 && table.bilinear(z).normal.is_finite(), "{z}");
            }
            if let Ok(table) = ConditionalTable::new(&ggx, 1 + numbers.count(7)) {
                let split = GaussianSplit::new(numbers.pair(), numbers.float());
                let density = table.view().residual_ndf(numbers.direction(), split);
                assert!(density >= 0.0 && density.is_finite(), "{density}");
            }
        }
    }
}

fn normals(numbers: &mut Numbers<'_>) -> Vec<Vec3> {
    numbers.list(64, Numbers::direction)
}
