//! The two spaces that noises live in: the plane and space.

use core::fmt::Debug;

use glam::{Vec2, Vec3};

use crate::{gaussian::Linear, lattice::Lattice, variates::gaussian_variates_3};

/// A point type that a noise can be evaluated at: [`Vec2`] or [`Vec3`].
///
/// Sealed: the lattice walks are written for these two.
pub trait Point: Space {}

impl Point for Vec2 {}
impl Point for Vec3 {}

/// What generic sums of noises need to know of a space; not nameable outside this crate.
pub trait Space: Copy + Debug + Default + PartialEq {
    /// Rotation times frequency, by rows.
    type Matrix: Copy + Debug + PartialEq;

    /// A random rotation times `frequency`, from the bits of two words.
    fn rotation(words: [u64; 2], frequency: f32) -> Self::Matrix;

    /// A random point of [0, 1)ⁿ.
    fn offset(word: u64) -> Self;

    /// M p + offset.
    fn transform(matrix: &Self::Matrix, p: Self, offset: Self) -> Self;

    /// Mᵀ g: the gradient with respect to p of a function of M p + offset.
    fn pull_back(matrix: &Self::Matrix, gradient: Self) -> Self;

    /// self + scale · other.
    fn add_scaled(self, scale: f32, other: Self) -> Self;

    /// scale · self.
    fn scaled(self, scale: f32) -> Self;

    /// The value-gradient noises of `C` channels and their variance.
    fn linear<L: Lattice, const C: usize>(lattice: &L, p: Self, seed: u32) -> Linear<Self, C>;
}

impl Space for Vec2 {
    type Matrix = [Self; 2];

    fn rotation([word, _]: [u64; 2], frequency: f32) -> Self::Matrix {
        let unit = crate::variates::unit_direction_2(word);
        let (c, s) = (unit.x * frequency, unit.y * frequency);
        [Self::new(c, -s), Self::new(s, c)]
    }

    fn offset(word: u64) -> Self {
        Self::new(fraction(word, 0), fraction(word, 20))
    }

    #[inline(always)]
    fn transform([x, y]: &Self::Matrix, p: Self, offset: Self) -> Self {
        Self::new(x.x * p.x + x.y * p.y + offset.x, y.x * p.x + y.y * p.y + offset.y)
    }

    #[inline(always)]
    fn pull_back([x, y]: &Self::Matrix, g: Self) -> Self {
        Self::new(x.x * g.x + y.x * g.y, x.y * g.x + y.y * g.y)
    }

    #[inline(always)]
    fn add_scaled(self, scale: f32, other: Self) -> Self {
        self + other * scale
    }

    #[inline(always)]
    fn scaled(self, scale: f32) -> Self {
        self * scale
    }

    #[inline(always)]
    fn linear<L: Lattice, const C: usize>(lattice: &L, p: Self, seed: u32) -> Linear<Self, C> {
        crate::gaussian::linear2(lattice, p, seed)
    }
}

impl Space for Vec3 {
    type Matrix = [Self; 3];

    fn rotation([first, second]: [u64; 2], frequency: f32) -> Self::Matrix {
        // A normalised Gaussian quaternion is uniform on the rotations (Muller 1959; Shoemake 1992).
        let [_, x, y, z] = gaussian_variates_3(first);
        let [w, ..] = gaussian_variates_3(second);
        let s = 2.0 / (x * x + y * y + z * z + w * w);
        [
            Self::new(1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)) * frequency,
            Self::new(s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)) * frequency,
            Self::new(s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)) * frequency,
        ]
    }

    fn offset(word: u64) -> Self {
        Self::new(fraction(word, 0), fraction(word, 20), fraction(word, 40))
    }

    #[inline(always)]
    fn transform([x, y, z]: &Self::Matrix, p: Self, offset: Self) -> Self {
        Self::new(
            x.x * p.x + x.y * p.y + x.z * p.z + offset.x,
            y.x * p.x + y.y * p.y + y.z * p.z + offset.y,
            z.x * p.x + z.y * p.y + z.z * p.z + offset.z,
        )
    }

    #[inline(always)]
    fn pull_back([x, y, z]: &Self::Matrix, g: Self) -> Self {
        Self::new(
            x.x * g.x + y.x * g.y + z.x * g.z,
            x.y * g.x + y.y * g.y + z.y * g.z,
            x.z * g.x + y.z * g.y + z.z * g.z,
        )
    }

    #[inline(always)]
    fn add_scaled(self, scale: f32, other: Self) -> Self {
        self + other * scale
    }

    #[inline(always)]
    fn scaled(self, scale: f32) -> Self {
        self * scale
    }

    #[inline(always)]
    fn linear<L: Lattice, const C: usize>(lattice: &L, p: Self, seed: u32) -> Linear<Self, C> {
        crate::gaussian::linear3(lattice, p, seed)
    }
}

/// Twenty bits of a word as a multiple of 2⁻²⁰ in [0, 1).
fn fraction(word: u64, shift: u32) -> f32 {
    ((word >> shift) & 0xf_ffff) as f32 / 1_048_576.0
}
