//! The noises of Ebert (ed.) 1994 with their tables, for reproduction: `vnoise`, `gnoise` and
//! `vgnoise`.

use asperity_core::math;

use crate::{
    contract::field::Field,
    contract::kernel::{self, Kernel, Measured},
    error::NoiseError,
    kinds::catmull_rom::{LONG_STEP, SplineNoise, spline, spline_rows},
    kinds::cell::corner::{CellNoise, Corner},
    kinds::perlin::PerlinClassic,
    lanes::{LaneSample, Lanes},
    lattice::fade::Fade,
    lattice::lattice::{Lattice, OnLattice},
    lattice::permutation_table::PermutationTable,
    point::Point,
    row::points::{Points, Target},
    row::row::Strip,
    sample::Sample,
    statistics::statistics::Statistics,
    statistics::tables,
    transforms::arithmetic::combined,
    transforms::pointwise::{self, Combine},
};

/// The three tables of 256 entries: a permutation, numbers in [−1, 1] and unit gradients.
///
/// ```text
/// value = 1 − 2u;   z = 1 − 2u, r = √(1 − z²), θ = 2πv, gradient = (r cos θ, r sin θ, z)
/// ```
///
/// The originals fill the tables from a system generator, uniform in [0, 1], restarted for each
/// table. Here the caller passes any stream of such numbers, and the permutation. Everything is
/// rounded to `f32` where the originals round. Sine and cosine are within an ulp of the exact
/// values and have the same bits everywhere.
///
/// Ebert (ed.) 1994, "Texturing and Modeling", noise by D. Peachey; Cohen's lecture "Procedural
/// Bump Mapping and Noise".
///
/// ```
/// use asperity_noise::{lattice::PermutationTable, ebert_1994::LectureTables};
///
/// let stream = || {
///     let mut state = 665_u32;
///     move || {
///         state = state.wrapping_mul(1_103_515_245).wrapping_add(12_345);
///         f64::from(state >> 1) / f64::from(u32::MAX >> 1)
///     }
/// };
/// let tables = LectureTables::new(PermutationTable::new(0), stream(), stream());
/// assert!(tables.gradients().iter().all(|[x, y, z]| (x * x + y * y + z * z - 1.0).abs() < 1e-6));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LectureTables {
    permutation: Bytes,
    values: [f32; 256],
    gradients: [[f32; 3]; 256],
}

impl LectureTables {
    /// Creates tables from a permutation, 256 uniform numbers for the values and 512 for the
    /// gradients, z before θ.
    ///
    /// Numbers are clamped to [0, 1]. NaN is taken as 0.
    #[must_use]
    pub fn new(
        permutation: PermutationTable,
        mut value_numbers: impl FnMut() -> f64,
        mut gradient_numbers: impl FnMut() -> f64,
    ) -> Self {
        let mut tables =
            Self { permutation: Bytes(permutation), values: [0.0; 256], gradients: [[0.0; 3]; 256] };
        for value in &mut tables.values {
            *value = (1.0 - 2.0 * clamped(value_numbers())) as f32;
        }
        for gradient in &mut tables.gradients {
            let z = (1.0 - 2.0 * clamped(gradient_numbers())) as f32;
            let r = math::sqrt(1.0 - z * z);
            let theta = (2.0 * core::f64::consts::PI * clamped(gradient_numbers())) as f32;
            let [cosine, sine] = cos_sin(theta);
            *gradient = [r * cosine, r * sine, z];
        }
        tables
    }

    /// Returns the permutation.
    #[must_use]
    pub const fn permutation(&self) -> &PermutationTable {
        &self.permutation.0
    }

    /// Returns the numbers of `vnoise`.
    #[must_use]
    pub const fn values(&self) -> &[f32; 256] {
        &self.values
    }

    /// Returns the gradients of `gnoise`.
    #[must_use]
    pub const fn gradients(&self) -> &[[f32; 3]; 256] {
        &self.gradients
    }
}

fn clamped(u: f64) -> f64 {
    if u > 0.0 { if u < 1.0 { u } else { 1.0 } } else { 0.0 }
}

/// cos θ and sin θ, 0 ≤ θ ≤ 2π, by series around the nearest quarter turn.
fn cos_sin(theta: f32) -> [f32; 2] {
    let theta = f64::from(theta);
    let quarter = (theta * core::f64::consts::FRAC_2_PI + 0.5) as u32;
    let x = theta - f64::from(quarter) * core::f64::consts::FRAC_PI_2;
    // 1 − x²/(m (m + 1)) (1 − x²/((m + 2) (m + 3)) (…)), with six quotients.
    let series = |m: u32| {
        let quotient = |k: u32| x * x / f64::from((m + 2 * k) * (m + 2 * k + 1));
        (0..6).rev().fold(1.0, |sum, k| 1.0 - sum * quotient(k))
    };
    let (c, s) = (series(1) as f32, (x * series(2)) as f32);
    match quarter & 3 {
        0 => [c, s],
        1 => [-s, c],
        2 => [-c, -s],
        _ => [s, -c],
    }
}

/// The lattice whose words are the bytes of the permutation.
#[derive(Clone, Debug, PartialEq)]
struct Bytes(PermutationTable);

impl Lattice for Bytes {
    #[inline]
    fn word<const N: usize>(&self, cell: [i32; N], _: u32) -> u32 {
        let at = |axis: usize| cell.get(axis).copied().unwrap_or(0);
        u32::from(self.0.index(at(0), at(1), at(2)))
    }
}

/// `vnoise`: values of the table at lattice points, interpolated by Catmull–Rom splines in 3-D; C¹.
///
/// It is [`ValueCatmullRom`](crate::ValueCatmullRom) before the division by (5/4)³, on the table.
///
/// - **Range:** ±125/64, though the splines rarely leave [−1, 1].
/// - **Period:** 256 along each axis.
///
/// ```
/// use asperity_noise::{Field, glam::Vec3, lattice::PermutationTable, ebert_1994::{LectureTables, Vnoise}};
///
/// let tables = LectureTables::new(PermutationTable::new(1), || 0.25, || 0.25);
/// assert_eq!(Vnoise(&tables).value(Vec3::new(3.0, -1.0, 2.0)), 0.5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vnoise<'a>(
    /// The tables.
    pub &'a LectureTables,
);

/// `gnoise`: gradient noise in 3-D with the gradients of the table and the weights 3t² − 2t³; C¹.
///
/// It is 0 at lattice points. It is [`PerlinClassic`] before the division by √3/2, on the table.
///
/// - **Range:** ±√3/2.
/// - **Period:** 256 along each axis.
///
/// ```
/// use asperity_noise::{Field, glam::Vec3, lattice::PermutationTable, ebert_1994::{Gnoise, LectureTables}};
///
/// let tables = LectureTables::new(PermutationTable::new(1), || 0.25, || 0.5);
/// let gradient = Gnoise(&tables).sample(Vec3::new(3.0, -1.0, 2.0)).gradient;
/// assert_eq!(gradient, Vec3::from(tables.gradients()[0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gnoise<'a>(
    /// The tables.
    pub &'a LectureTables,
);

/// `vgnoise`: (1 − μ) `vnoise` + μ `gnoise`, on the same lattice; C¹.
///
/// ```
/// use asperity_noise::{Field, glam::Vec3, lattice::PermutationTable, ebert_1994::{LectureTables, Vgnoise}};
///
/// let tables = LectureTables::new(PermutationTable::new(1), || 0.25, || 0.25);
/// assert_eq!(Vgnoise::new(&tables, 0.5)?.value(Vec3::new(3.0, -1.0, 2.0)), 0.25);
/// # Ok::<(), asperity_noise::NoiseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vgnoise<'a> {
    tables: &'a LectureTables,
    weight: f32,
}

impl<'a> Vgnoise<'a> {
    /// Creates the sum with the weight μ of gradient noise.
    ///
    /// # Errors
    ///
    /// If the weight is not in [0, 1].
    pub const fn new(tables: &'a LectureTables, weight: f32) -> Result<Self, NoiseError> {
        if weight >= 0.0 && weight <= 1.0 {
            Ok(Self { tables, weight })
        } else {
            Err(NoiseError::OutOfRange { parameter: "weight", value: weight, min: 0.0, max: 1.0 })
        }
    }

    /// Returns μ, the weight of gradient noise.
    #[must_use]
    pub const fn weight(&self) -> f32 {
        self.weight
    }
}

macro_rules! field_of_kernel {
    ($noise:ty, $kernel:ident, $range:expr) => {
        /// Value and gradient are both 0 if a point is not finite.
        impl<V: Point<Coordinates = [f32; 3]>> Field<V> for $noise {
            fn sample(&self, p: V) -> Sample<V> {
                let (value, gradient) = kernel::Kernel::<3>::sample_at(&$kernel(self.0), p.coordinates(), 0);
                Sample { value, gradient: V::from_coordinates(gradient) }
            }

            fn value(&self, p: V) -> f32 {
                kernel::Kernel::<3>::value_at(&$kernel(self.0), p.coordinates(), 0)
            }

            fn range(&self) -> [f32; 2] {
                [-$range, $range]
            }

            fn fill(&self, points: &Points<'_, V>, target: Target<'_, V>) {
                kernel::fill(&$kernel(self.0), points, target);
            }
        }
    };
}

field_of_kernel!(Vnoise<'_>, Splines, 125.0 / 64.0);
field_of_kernel!(Gnoise<'_>, Gradients, 0.866_025_4);

impl Combine<1> for Vgnoise<'_> {
    #[inline(always)]
    fn combined(&self, value: f32, [gradient]: [f32; 1]) -> f32 {
        (1.0 - self.weight) * value + self.weight * gradient
    }
    #[inline(always)]
    fn slope(&self, _: f32, _: [f32; 1], slope: f32, [steep]: [f32; 1]) -> f32 {
        (1.0 - self.weight) * slope + self.weight * steep
    }
}

combined!([] Vgnoise<'_>, Point<Coordinates = [f32; 3]>, |self| Vnoise(self.tables), [Gnoise(self.tables)], {
    let range = Combine::combined(self, 125.0 / 64.0, [0.866_025_4]);
    [-range, range]
});

/// `vnoise` as a kind of noise without seed.
struct Splines<'a>(&'a LectureTables);

impl SplineNoise<3> for Splines<'_> {
    #[inline(always)]
    fn number<S: Lanes>(&self, s: S, word: S::U) -> S::F {
        s.floats(|lane| self.0.values[(s.lane_word(word, lane) & 255) as usize])
    }
}

impl Kernel<3> for Splines<'_> {
    const LONG_STEP: f32 = LONG_STEP;

    type RowScratch = ();

    #[inline(always)]
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; 3], seed: u32) -> LaneSample<S, 3> {
        spline::<Self, S, 3, GRADIENTS>(s, self, p, seed)
    }

    #[inline(always)]
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        _: &mut (),
        strip: Strip<'_, 3, GRADIENTS>,
    ) -> usize {
        spline_rows(s, self, strip)
    }
}

/// `gnoise` as a kind of noise without seed.
struct Gradients<'a>(&'a LectureTables);

impl CellNoise<3> for Gradients<'_> {
    type Standard = PerlinClassic;

    fn standard(&self) -> PerlinClassic {
        PerlinClassic::default()
    }

    const HAS_VALUE: bool = false;
    const FADE: Fade = Fade::Cubic;

    #[inline(always)]
    fn corner<S: Lanes>(&self, s: S, word: S::U) -> Corner<S, 3> {
        let mut gradient = [s.float(0.0); 3];
        for axis in 0..3 {
            gradient[axis] =
                s.floats(|lane| self.0.gradients[(s.lane_word(word, lane) & 255) as usize][axis]);
        }
        Corner { value: s.float(0.0), gradient }
    }
}

macro_rules! of_tables {
    ($kind:ident, $statistics:ident) => {
        impl OnLattice for $kind<'_> {
            type Lattice = Bytes;

            #[inline(always)]
            fn lattice(&self) -> &Bytes {
                &self.0.permutation
            }
        }

        impl Measured<3> for $kind<'_> {
            fn seed(&self) -> u32 {
                0
            }

            fn statistics(&self) -> &'static Statistics {
                &tables::$statistics[2]
            }
        }
    };
}

of_tables!(Splines, VALUE_CATMULL_ROM);
of_tables!(Gradients, PERLIN_1985);

#[cfg(test)]
mod tests {
    use super::*;
    use approx::abs_diff_eq;

    #[test]
    fn cos_sin_matches_std() {
        for i in 0..=4096_u16 {
            let theta = f32::from(i) / 4096.0 * core::f32::consts::TAU;
            let [c, s] = cos_sin(theta).map(f64::from);
            assert!(abs_diff_eq!(c * c + s * s, 1.0, epsilon = 2e-7), "{theta}");
            // The turn by θ and the turn back.
            let [d, t] = cos_sin(core::f32::consts::TAU - theta).map(f64::from);
            assert!(abs_diff_eq!(c, d, epsilon = 7e-7) && abs_diff_eq!(s, -t, epsilon = 7e-7), "{theta}");
        }
        assert_eq!(cos_sin(0.0), [1.0, 0.0]);
        for (theta, [c, s]) in [(0.5, [0.877_582_56, 0.479_425_54]), (2.0, [-0.416_146_84, 0.909_297_4])] {
            assert_eq!(cos_sin(theta), [c, s]);
        }
        assert_eq!(cos_sin(5.0), [0.283_662_2, -0.958_924_3]);
    }

    #[test]
    fn numbers_outside_the_interval_are_clamped() {
        let tables = LectureTables::new(PermutationTable::new(4), || f64::NAN, || 7.0);
        assert_eq!(tables.values()[9], 1.0);
        assert_eq!(tables.gradients()[9][2], -1.0);
    }
}
