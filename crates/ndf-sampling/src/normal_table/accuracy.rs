//! Accuracy of a normal table: the angles between its lookups and the exact normals.

use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use crate::frame::Frame;
use crate::ndf::Ndf;
use crate::normal_table::table::{NormalLut, entry_coordinate};
use crate::numeric::normal_distribution::gaussian_cdf;
use asperity_core::math;

/// Angle between looked-up and exact normals, in rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// The maximum.
    pub largest: f32,
    /// The root mean square under the Gaussian.
    pub rms: f32,
}

#[cfg(feature = "approx")]
asperity_core::impl_approx! { f32; Deviation: deviation => deviation.largest, deviation.rms; }

/// Accuracy of a [`NormalLut`], measured at the midpoints of four entries, where it is worst.
///
/// ```text
/// largest = max ∠(looked up, T(z)),   rms² = Σ w ∠²/Σ w,   w = Gaussian weight of the cell between the entries
/// ```
///
/// Over all positions of a cell the mean square is smaller: a third for a nearest entry, about half
/// for a bilinear one.
///
/// ```
/// use asperity_ndf_sampling::{Beckmann, NormalLut};
///
/// let beckmann = Beckmann::isotropic(0.3)?;
/// let accuracy = NormalLut::standard(&beckmann).accuracy(&beckmann);
/// assert!(accuracy.bilinear.rms < 2e-5 && accuracy.nearest.rms > 100.0 * accuracy.bilinear.rms);
/// assert!(accuracy.beyond < 2e-5);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TableAccuracy {
    /// Of the nearest entry.
    pub nearest: Deviation,
    /// Of bilinear interpolation.
    pub bilinear: Deviation,
    /// Of bilinear interpolation between half floats.
    pub bilinear_half: Deviation,
    /// The fraction of the normals whose coordinates are beyond the outermost entries, which
    /// replace them.
    pub beyond: f64,
    /// The largest angle between the frames of two neighboring entries, in rad.
    pub largest_step: f32,
}

impl NormalLut {
    /// Accuracy of the lookups compared with `ndf`.
    #[must_use]
    pub fn accuracy<N: Ndf + ?Sized>(&self, ndf: &N) -> TableAccuracy {
        let (size, spacing, halves) = (self.size(), self.layout().spacing, self.halves());
        let halves = NormalLut { size, layout: self.layout(), entries: halves.as_slice() };
        let entries: Vec<f32> = (0..size).map(|k| entry_coordinate(spacing, k, size)).collect();
        // Between two neighboring entries along one coordinate: the midpoint and the weight.
        let cells: Vec<(f32, f64)> = (1..size)
            .zip(entries.iter().zip(entries.iter().skip(1)))
            .map(|(k, (&from, &to))| {
                (
                    spacing.coordinate(k as f32 / size as f32),
                    gaussian_cdf(f64::from(to)) - gaussian_cdf(f64::from(from)),
                )
            })
            .collect();
        let mut sums = [(); 3].map(|()| AngleSum::default());
        for &(y, across) in &cells {
            for &(x, along) in &cells {
                let (z, weight) = (Vec2::new(x, y), along * across);
                let n = ndf.warp_gaussian(z);
                let found = [self.nearest_normal(z), self.bilinear_normal(z), halves.bilinear_normal(z)];
                sums.iter_mut().zip(found).for_each(|(sum, found)| sum.add(angle(found, n), weight));
            }
        }
        let outermost = entries.last().map_or(0.0, |&z| 2.0 * gaussian_cdf(-f64::from(z)));
        let [nearest, bilinear, bilinear_half] = sums.map(|sum| sum.deviation());
        TableAccuracy {
            nearest,
            bilinear,
            bilinear_half,
            beyond: outermost * (2.0 - outermost),
            largest_step: largest_step(self) as f32,
        }
    }
}

/// The maximum and the sum of squares of weighted angles.
#[derive(Default)]
struct AngleSum {
    largest: f64,
    squares: f64,
    weight: f64,
}

impl AngleSum {
    fn add(&mut self, angle: f64, weight: f64) {
        self.largest = self.largest.max(angle);
        self.squares += angle * angle * weight;
        self.weight += weight;
    }

    fn deviation(&self) -> Deviation {
        let mean = if self.weight > 0.0 { self.squares / self.weight } else { 0.0 };
        Deviation { largest: self.largest as f32, rms: math::sqrt_f64(mean) as f32 }
    }
}

/// The angle between two unit vectors; their cosine would lose angles below 10⁻⁴.
fn angle(a: Vec3, b: Vec3) -> f64 {
    2.0 * math::asin_f64(math::sqrt_f64(0.25 * squared_distance(a, b)).min(1.0))
}

fn squared_distance(a: Vec3, b: Vec3) -> f64 {
    let [x, y, z] = [a.x - b.x, a.y - b.y, a.z - b.z].map(f64::from);
    x * x + y * y + z * z
}

/// The largest angle of the rotation between neighboring frames in a row or a column.
///
/// ```text
/// |A − B|² = 8 sin²(angle/2),   the sum of the squares of all nine differences
/// ```
fn largest_step(table: &NormalLut) -> f64 {
    let frames: Vec<Frame> = table.frames().collect();
    let step = |a: &Frame, b: &Frame| {
        squared_distance(a.tangent, b.tangent)
            + squared_distance(a.bitangent, b.bitangent)
            + squared_distance(a.normal, b.normal)
    };
    let rows = frames.chunks(table.size()).flat_map(|row| row.iter().zip(row.iter().skip(1)));
    let columns = frames.iter().zip(frames.iter().skip(table.size()));
    let largest = rows.chain(columns).fold(0.0_f64, |largest, (a, b)| largest.max(step(a, b)));
    2.0 * math::asin_f64(math::sqrt_f64(0.125 * largest).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Beckmann, Ggx, Ndf,
        normal_table::{Chart, Spacing, TableLayout},
    };
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn slopes_of_beckmann_are_interpolated_exactly() {
        let beckmann = Beckmann::new(0.1, 0.4).unwrap();
        let layout = TableLayout { chart: Chart::Slopes, spacing: Spacing::Coordinates };
        let accuracy = NormalLut::with_layout(&beckmann, 32, layout).unwrap().accuracy(&beckmann);
        assert!(accuracy.bilinear.largest < 5e-7, "{accuracy:?}");
        // The nearest entry is half a texel off along both axes: 0.14 α/√2 each.
        assert_abs_diff_eq!(accuracy.nearest.rms / 0.041, 1.0, epsilon = 0.1);
    }

    #[test]
    fn frame_steps_are_at_most_sqrt_two_normal_steps() {
        let table = NormalLut::new(&Ggx::isotropic(1.0).unwrap(), 64).unwrap();
        let normals: Vec<Vec3> = table.frames().map(|frame| frame.normal).collect();
        let rows = normals.chunks(64).flat_map(|row| row.windows(2).map(|pair| angle(pair[0], pair[1])));
        let columns = normals.iter().zip(normals.iter().skip(64)).map(|(a, b)| angle(*a, *b));
        let largest = rows.chain(columns).fold(0.0_f64, f64::max);
        let step = largest_step(&table);
        assert!(step >= largest && step <= largest * 2.0_f64.sqrt(), "{step} {largest}");
    }

    #[test]
    fn accuracy_of_a_single_entry() {
        let ggx = Ggx::isotropic(0.3).unwrap();
        let table = NormalLut::new(&ggx, 1).unwrap();
        let accuracy = table.accuracy(&ggx);
        assert_eq!(accuracy, TableAccuracy { beyond: 1.0, ..TableAccuracy::default() });
        assert_eq!(table.bilinear(Vec2::ONE).normal, ggx.warp_gaussian(Vec2::ZERO));
    }
}
