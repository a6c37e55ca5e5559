//! Externally stored tables: arrays of any numbers are rejected, or answer every query.

use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::normal_table::{Chart, Spacing, TableLayout};
use asperity_ndf_sampling::{ConditionalTable, NormalLut};
use asperity_ndf_sampling::{GaussianSplit, Isotropic, Ndf, NoiseCdfRef, PackedMapRef};

use crate::density::{distribution, ndf};
use crate::numbers::Numbers;

fn floats(bytes: &[u8]) -> Vec<f32> {
    bytes.as_chunks().0.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect()
}

/// Checks a packed map of any numbers. Its header and its length are validated, but its numbers are
/// not: results may be arbitrary, but there is a result.
pub(crate) fn packed(array: &[f32], numbers: &mut Numbers<'_>) {
    match PackedMapRef::new(array) {
        Ok(map) => {
            let (u, m) = (numbers.pair(), numbers.direction());
            let _ = (map.inverse(u), map.forward(u), map.sample(u), map.warp_gaussian(u));
            let _ = (map.d(m), map.invert(m), map.gpu());
            let points = [0.1, -0.3, 0.9, u.x, u.y, m.x, m.y, 0.0, 2.0];
            let (mut x, mut y) = ([0.0; 9], [0.0; 9]);
            map.inverse_batch([&points, &points], [&mut x, &mut y]).expect("as many");
            map.forward_batch([&points, &points], [&mut x, &mut y]).expect("as many");
            map.d_batch([&points, &points], &mut x).expect("as many");
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
    }
}

/// Checks an isotropic table of any numbers.
pub(crate) fn isotropic(array: &[f32], numbers: &mut Numbers<'_>) {
    match Isotropic::from_packed(array) {
        Ok(table) => ndf(&table, numbers),
        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
    }
}

pub(crate) fn attack(numbers: &mut Numbers<'_>) {
    let layout = TableLayout {
        spacing: numbers.pick(&[Spacing::Coordinates, Spacing::Quantiles, Spacing::Warped]),
        chart: numbers.pick(&[Chart::Projected, Chart::Slopes, Chart::Stereographic]),
    };
    let (z, split) = (numbers.pair(), GaussianSplit::new(numbers.pair(), numbers.float()));
    let (range, low, high) = (numbers.float(), numbers.float(), numbers.float());
    let (which, size, h) = (numbers.byte() % 6, numbers.count(9), numbers.direction());
    match which {
        0 => {
            let array = floats(numbers.rest());
            packed(&array, &mut Numbers::new(&[7; 40]));
        }
        1 => {
            let table = numbers.list(32, Numbers::float);
            isotropic(&table, numbers);
        }
        2 => {
            let array = floats(numbers.rest());
            unit(NormalLut::from_entries(size, layout, array.as_chunks::<2>().0), z);
        }
        3 => {
            let halves: Vec<u16> =
                numbers.rest().as_chunks().0.iter().map(|&bytes| u16::from_le_bytes(bytes)).collect();
            unit(NormalLut::from_entries(size, layout, halves.as_chunks::<2>().0), z);
        }
        4 => {
            let array = floats(numbers.rest());
            match ConditionalTable::from_entries(size, Vec2::new(low, high), array.as_chunks().0) {
                Ok(table) => {
                    let density = table.residual_ndf(h, split);
                    assert!(density >= 0.0 && density.is_finite(), "{density}");
                    // Between entries of arbitrary numbers.
                    let _ = table.invert(h);
                }
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
        _ => {
            let mut table = numbers.list(24, Numbers::share);
            if numbers.byte() < 200 {
                table.sort_by(f32::total_cmp);
            }
            for made in [NoiseCdfRef::new(range, &table), NoiseCdfRef::between(low, high, &table)] {
                match made {
                    Ok(noise) => distribution(&noise, numbers),
                    Err(error) => assert_eq!(error.to_string().lines().count(), 1),
                }
            }
        }
    }
}

fn unit<E: asperity_ndf_sampling::normal_table::TableEntry>(
    table: Result<NormalLut<&[E]>, asperity_ndf_sampling::NdfError>,
    z: Vec2,
) {
    match table {
        Ok(table) => {
            let of = |n: Vec3| assert!((n.length() - 1.0).abs() < 1e-5, "{n} at {z}");
            of(table.nearest(z).normal);
            of(table.bilinear(z).normal);
            of(table.nearest_normal(z));
            of(table.bilinear_normal(z));
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
    }
}
