//! Simplex noise, with the kernel radius that is continuous and with the customary wider one.

use glam::{Vec2, Vec3};

use crate::{
    integer_hash::IntegerHash,
    lattice::Lattice,
    noise::Noise,
    sample::Sample,
    statistics::Statistics,
    statistics_tables as tables,
    variates::{edge_direction_2, edge_direction_3},
};

/// Gradient noise on the simplicial lattice: three corners in 2-D, four in 3-D.
///
/// ```text
/// n(p) = A Σ_c max(0, r² − |d|²)⁴ g_c·d,   d = p − c
/// ```
///
/// - **Range:** [−1, 1]; A is the inverse of the searched maximum, attained within 2e-6.
/// - **Domain:** |x| < 2³¹ in each coordinate; 0 beyond.
///
/// Nilsson 2008, section 4.1.3, prints the dot product with minus signs and its derivative without a factor. With
/// t = r² − |d|² and s = g·d it is ∂(t⁴ s)/∂x = −8 x t³ s + t⁴ gₓ.
///
/// ```
/// use asperity_noise::{Noise, Simplex, glam::Vec3};
///
/// let sample = Simplex::CONTINUOUS.sample(Vec3::new(0.4, -1.3, 2.2), 3);
/// assert!(sample.value.abs() <= 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Simplex<L = IntegerHash> {
    kernel: Kernel,
    lattice: L,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kernel {
    Continuous,
    Wide,
}

impl Simplex {
    /// r² = 1/2, the distance from a corner to the opposite face: C³ everywhere.
    pub const CONTINUOUS: Self = Self { kernel: Kernel::Continuous, lattice: IntegerHash };

    /// r² = 0.6, as in Nilsson 2008: smoother to the eye, but kernels are cut off at the faces of the simplices, where the noise
    /// leaps. **Discontinuous** in 2-D and 3-D; measured leaps up to 0.0045 and 0.0023.
    pub const WIDE: Self = Self { kernel: Kernel::Wide, lattice: IntegerHash };
}

impl<L> Simplex<L> {
    /// The same noise on another lattice.
    #[must_use]
    pub fn with_lattice<M>(self, lattice: M) -> Simplex<M> {
        Simplex { kernel: self.kernel, lattice }
    }

    /// r², the square of the kernel's radius.
    #[must_use]
    pub const fn radius_squared(&self) -> f32 {
        match self.kernel {
            Kernel::Continuous => 0.5,
            Kernel::Wide => 0.6,
        }
    }
}

/// Keeps rounding from crossing 1; what it is divided by below is the searched max Σ t⁴ max_g g·d.
const MARGIN: f32 = 1.0 - 1e-6;
/// Coordinates from here on have no simplex with 32-bit indices.
const LIMIT: f32 = 2_147_483_648.0;
/// (√3 − 1)/2, which shears the triangles into halves of squares.
const SKEW_2: f64 = 0.366_025_403_784_438_65;
/// (3 − √3)/6, which shears back.
const UNSKEW_2: f64 = 0.211_324_865_405_187_1;
const SKEW_3: f64 = 1.0 / 3.0;
const UNSKEW_3: f64 = 1.0 / 6.0;

impl<L: Lattice> Noise<Vec2> for Simplex<L> {
    #[inline]
    fn sample(&self, p: Vec2, seed: u32) -> Sample<Vec2> {
        if !(p.x.abs() < LIMIT && p.y.abs() < LIMIT) {
            return Sample::default();
        }
        let radius_squared = self.radius_squared();
        let (x, y) = (f64::from(p.x), f64::from(p.y));
        // Indices need more bits than `f32` has left: at x = 10⁵ its fraction has seven.
        let skew = (x + y) * SKEW_2;
        let (i, j) = (floor(x + skew), floor(y + skew));
        let unskew = (i + j) as f64 * UNSKEW_2;
        let d0 = Vec2::new((x - (i as f64 - unskew)) as f32, (y - (j as f64 - unskew)) as f32);
        let middle = if d0.x > d0.y { [1, 0] } else { [0, 1] };
        let mut sum = Sample::<Vec2>::default();
        for [di, dj] in [[0, 0], middle, [1, 1]] {
            let unskew = (di + dj) as f32 * UNSKEW_2 as f32;
            let d = Vec2::new(d0.x - di as f32 + unskew, d0.y - dj as f32 + unskew);
            let t = radius_squared - (d.x * d.x + d.y * d.y);
            if t > 0.0 {
                let g = edge_direction_2(self.lattice.hash2((i + di) as i32, (j + dj) as i32, seed));
                let s = g.x * d.x + g.y * d.y;
                let (t3, t4) = (t * t * t, t * t * t * t);
                sum.value += t4 * s;
                sum.gradient += g * t4 - d * (8.0 * t3 * s);
            }
        }
        let scale = match self.kernel {
            Kernel::Continuous => MARGIN / 0.014_255_562,
            Kernel::Wide => MARGIN / 0.040_844_663,
        };
        Sample { value: sum.value * scale, gradient: sum.gradient * scale }
    }

    fn statistics(&self) -> &'static Statistics {
        match self.kernel {
            Kernel::Continuous => &tables::SIMPLEX_CONTINUOUS_2,
            Kernel::Wide => &tables::SIMPLEX_WIDE_2,
        }
    }
}

impl<L: Lattice> Noise<Vec3> for Simplex<L> {
    #[inline]
    fn sample(&self, p: Vec3, seed: u32) -> Sample<Vec3> {
        if !(p.x.abs() < LIMIT && p.y.abs() < LIMIT && p.z.abs() < LIMIT) {
            return Sample::default();
        }
        let radius_squared = self.radius_squared();
        let (x, y, z) = (f64::from(p.x), f64::from(p.y), f64::from(p.z));
        let skew = (x + y + z) * SKEW_3;
        let (i, j, k) = (floor(x + skew), floor(y + skew), floor(z + skew));
        let unskew = (i + j + k) as f64 * UNSKEW_3;
        let d0 = Vec3::new(
            (x - (i as f64 - unskew)) as f32,
            (y - (j as f64 - unskew)) as f32,
            (z - (k as f64 - unskew)) as f32,
        );
        // The path from corner (0, 0, 0) to (1, 1, 1) steps along the axes in descending order of d₀.
        let (xy, yz, xz) = (d0.x >= d0.y, d0.y >= d0.z, d0.x >= d0.z);
        let smaller =
            [u8::from(xy) + u8::from(xz), u8::from(!xy) + u8::from(yz), u8::from(!xz) + u8::from(!yz)];
        let first = smaller.map(|count| i64::from(count == 2));
        let second = smaller.map(|count| i64::from(count >= 1));
        let mut sum = Sample::<Vec3>::default();
        for [di, dj, dk] in [[0, 0, 0], first, second, [1, 1, 1]] {
            let unskew = (di + dj + dk) as f32 * UNSKEW_3 as f32;
            let d =
                Vec3::new(d0.x - di as f32 + unskew, d0.y - dj as f32 + unskew, d0.z - dk as f32 + unskew);
            let t = radius_squared - (d.x * d.x + d.y * d.y + d.z * d.z);
            if t > 0.0 {
                let word = self.lattice.hash3((i + di) as i32, (j + dj) as i32, (k + dk) as i32, seed);
                let g = edge_direction_3(word);
                let s = g.x * d.x + g.y * d.y + g.z * d.z;
                let (t3, t4) = (t * t * t, t * t * t * t);
                sum.value += t4 * s;
                sum.gradient += g * t4 - d * (8.0 * t3 * s);
            }
        }
        let scale = match self.kernel {
            Kernel::Continuous => MARGIN / 0.013_007_157,
            Kernel::Wide => MARGIN / 0.030_584_887,
        };
        Sample { value: sum.value * scale, gradient: sum.gradient * scale }
    }

    fn statistics(&self) -> &'static Statistics {
        match self.kernel {
            Kernel::Continuous => &tables::SIMPLEX_CONTINUOUS_3,
            Kernel::Wide => &tables::SIMPLEX_WIDE_3,
        }
    }
}

/// ⌊x⌋ for |x| < 2⁵².
#[inline(always)]
fn floor(x: f64) -> i64 {
    let truncated = x as i64;
    truncated - i64::from(x < truncated as f64)
}
