//! Gradient noise on the integer lattice, in Perlin's two forms.

use glam::{Vec2, Vec3};

use crate::{
    blend::{Corners, blend2, blend3},
    fade::Fade,
    integer_hash::IntegerHash,
    lattice::{Lattice, cell},
    noise::Noise,
    sample::Sample,
    statistics::Statistics,
    statistics_tables as tables,
    variates::{edge_direction_2, edge_direction_3, unit_direction_2, unit_direction_3},
};

/// Perlin's noise of 1985: unit gradients uniform on the circle or sphere, cubic weights; C¹.
///
/// ```text
/// n(p) = A Σ_c W_c(p) g_c·(p − c),   W = Π w or 1 − w,   w(t) = 3t² − 2t³
/// ```
///
/// - **Range:** [−1, 1], attained in cell centres within 2e-6: A = √2 in 2-D, 2/√3 in 3-D, 1/max Σ W_c |p − c|.
/// - **Zero** at every lattice point; the variance depends on the place in the cell.
///
/// Perlin 1985, "An Image Synthesizer"; Ebert (ed.) 1994, "Texturing and Modeling".
///
/// ```
/// use asperity_noise::{Noise, Perlin1985, glam::Vec2};
///
/// let noise = Perlin1985::default();
/// assert_eq!(noise.sample(Vec2::new(3.0, -2.0), 9).value, 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Perlin1985<L = IntegerHash>(
    /// The lattice that the gradients are drawn from.
    pub L,
);

/// Perlin's noise of 2002: gradients to the edges of a cube (eight directions in 2-D), quintic weights; C².
///
/// ```text
/// n(p) = A Σ_c W_c(p) g_c·(p − c),   W = Π w or 1 − w,   w(t) = 6t⁵ − 15t⁴ + 10t³
/// ```
///
/// - **Range:** [−1, 1], attained within 2e-6: A = 1 in 2-D, 1/1.0363538 in 3-D by search of max Σ W_c max_g g·(p − c).
/// - **Zero** at every lattice point; the variance depends on the place in the cell.
///
/// Perlin 2002, "Improving Noise"; all twelve edges are equally likely here, where he doubles four of them.
///
/// ```
/// use asperity_noise::{Noise, Perlin2002, glam::Vec3};
///
/// let noise = Perlin2002::default();
/// let p = Vec3::new(0.25, 1.5, -0.75);
/// assert!(noise.sample(p, 1) != noise.sample(p, 2));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Perlin2002<L = IntegerHash>(
    /// The lattice that the gradients are drawn from.
    pub L,
);

impl Default for Perlin1985 {
    fn default() -> Self {
        Self(IntegerHash)
    }
}

impl Default for Perlin2002 {
    fn default() -> Self {
        Self(IntegerHash)
    }
}

/// Keeps rounding from crossing 1.
const MARGIN: f32 = 1.0 - 1e-6;
/// max Σ W_c |p − c| = √½, in the centre of the square.
const SCALE_1985_2: f32 = MARGIN / core::f32::consts::FRAC_1_SQRT_2;
/// max Σ W_c |p − c| = √¾, in the centre of the cube.
const SCALE_1985_3: f32 = MARGIN / 0.866_025_4;
/// max Σ W_c max_g g·(p − c) = 1, in the centre of the square.
const SCALE_2002_2: f32 = MARGIN;
/// max Σ W_c max_g g·(p − c), searched; at (0.5, 0.518508, 0.355257).
const SCALE_2002_3: f32 = MARGIN / 1.036_353_8;

impl<L: Lattice> Noise<Vec2> for Perlin1985<L> {
    #[inline]
    fn sample(&self, p: Vec2, seed: u32) -> Sample<Vec2> {
        gradient2(&self.0, p, seed, SCALE_1985_2, unit_direction_2, Fade::cubic)
    }

    fn statistics(&self) -> &'static Statistics {
        &tables::PERLIN_1985_2
    }
}

impl<L: Lattice> Noise<Vec3> for Perlin1985<L> {
    #[inline]
    fn sample(&self, p: Vec3, seed: u32) -> Sample<Vec3> {
        gradient3(&self.0, p, seed, SCALE_1985_3, unit_direction_3, Fade::cubic)
    }

    fn statistics(&self) -> &'static Statistics {
        &tables::PERLIN_1985_3
    }
}

impl<L: Lattice> Noise<Vec2> for Perlin2002<L> {
    #[inline]
    fn sample(&self, p: Vec2, seed: u32) -> Sample<Vec2> {
        gradient2(&self.0, p, seed, SCALE_2002_2, edge_direction_2, Fade::quintic)
    }

    fn statistics(&self) -> &'static Statistics {
        &tables::PERLIN_2002_2
    }
}

impl<L: Lattice> Noise<Vec3> for Perlin2002<L> {
    #[inline]
    fn sample(&self, p: Vec3, seed: u32) -> Sample<Vec3> {
        gradient3(&self.0, p, seed, SCALE_2002_3, edge_direction_3, Fade::quintic)
    }

    fn statistics(&self) -> &'static Statistics {
        &tables::PERLIN_2002_3
    }
}

#[inline(always)]
fn gradient2(
    lattice: &impl Lattice,
    p: Vec2,
    seed: u32,
    scale: f32,
    direction: impl Fn(u64) -> Vec2,
    fade: impl Fn(f32) -> Fade,
) -> Sample<Vec2> {
    if !p.is_finite() {
        return Sample::default();
    }
    let [(x, tx), (y, ty)] = [cell(p.x), cell(p.y)];
    let mut ends = [Corners::<2, 2>::ZERO; 2];
    for (end, corners) in ends.iter_mut().enumerate() {
        for lane in 0..2 {
            let word = lattice.hash2(x.wrapping_add(end as i32), y.wrapping_add(lane as i32), seed);
            let g = direction(word);
            let d = Vec2::new(tx - end as f32, ty - lane as f32);
            corners.value[lane] = g.x * d.x + g.y * d.y;
            corners.gradient[0][lane] = g.x;
            corners.gradient[1][lane] = g.y;
        }
    }
    let [low, high] = ends;
    let Sample { value, gradient } = blend2(&low, &high, [fade(tx), fade(ty)]);
    Sample { value: value * scale, gradient: gradient * scale }
}

#[inline(always)]
fn gradient3(
    lattice: &impl Lattice,
    p: Vec3,
    seed: u32,
    scale: f32,
    direction: impl Fn(u64) -> Vec3,
    fade: impl Fn(f32) -> Fade,
) -> Sample<Vec3> {
    if !p.is_finite() {
        return Sample::default();
    }
    let [(x, tx), (y, ty), (z, tz)] = [cell(p.x), cell(p.y), cell(p.z)];
    let mut ends = [Corners::<4, 3>::ZERO; 2];
    for (end, corners) in ends.iter_mut().enumerate() {
        for lane in 0..4 {
            let (up_y, up_z) = (lane & 1, lane >> 1);
            let word = lattice.hash3(
                x.wrapping_add(end as i32),
                y.wrapping_add(up_y as i32),
                z.wrapping_add(up_z as i32),
                seed,
            );
            let g = direction(word);
            let d = Vec3::new(tx - end as f32, ty - up_y as f32, tz - up_z as f32);
            corners.value[lane] = g.x * d.x + g.y * d.y + g.z * d.z;
            corners.gradient[0][lane] = g.x;
            corners.gradient[1][lane] = g.y;
            corners.gradient[2][lane] = g.z;
        }
    }
    let [low, high] = ends;
    let Sample { value, gradient } = blend3(&low, &high, [fade(tx), fade(ty), fade(tz)]);
    Sample { value: value * scale, gradient: gradient * scale }
}
