//! Reference implementation of every noise in plain `f64` and in any dimension: slow, literal, with
//! only the lattice words in common.

use asperity_noise::{GaussianNoise, IntegerHash, Lattice, Perlin, PerlinClassic};
use statrs::function::gamma::gamma;

/// A noise before scaling to its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number per cell.
    White,
    /// Numbers at the corners, quintic weights.
    Value,
    /// Numbers at 4ⁿ points, Catmull–Rom weights.
    CatmullRom,
    /// Unit gradients, cubic weights.
    PerlinClassic,
    /// Edge directions, quintic weights.
    Perlin,
    /// Numbers plus unit gradients with this weight, scaled to the same range; quintic weights.
    ValueGradient(f64),
    /// Simplex noise with this r².
    Simplex(f64),
    /// Radial kernels around this many impulses per cell, scaled to unit variance.
    Sparse(u32),
    /// A channel of value-gradient noise divided by its standard deviation.
    Gaussian(usize),
}

/// The words of a lattice, by cell and seed.
pub type Words<'a, const D: usize> = &'a dyn Fn([i32; D], u32) -> u32;

/// A contributing lattice point: its cell, its weight, the offset from it.
type Part<const D: usize> = ([i32; D], f64, [f64; D]);

/// The random contribution of a lattice point.
enum Drawn<const D: usize> {
    /// A number and a slope.
    Line(f64, [f64; D]),
    /// Impulses at positions in the cell, with weights.
    Impulses(Vec<([f64; D], f64)>),
}

impl<const D: usize> Drawn<D> {
    /// Returns the value at offset `d` from the lattice point.
    fn at(&self, d: &[f64; D]) -> f64 {
        match self {
            Self::Line(value, slope) => value + dot(slope, d),
            Self::Impulses(impulses) => {
                let mut sum = 0.0;
                for (place, weight) in impulses {
                    let mut from_it = *d;
                    for k in 0..D {
                        from_it[k] -= place[k];
                    }
                    sum += kernel(from_it) * weight;
                }
                sum
            }
        }
    }
}

impl Kind {
    /// Returns the unscaled value at `p`.
    #[must_use]
    pub fn value<const D: usize>(self, p: [f64; D], seed: u32) -> f64 {
        self.value_on(&|cell, seed| self.word(&IntegerHash, cell, seed), p, seed)
    }

    /// Returns the word that the noise uses at a lattice point. If only the upper bits are used, it
    /// is the upper word.
    #[must_use]
    pub fn word<const D: usize>(self, lattice: &impl Lattice, cell: [i32; D], seed: u32) -> u32 {
        match self {
            Self::Value | Self::Perlin | Self::Simplex(_) => lattice.upper_word(cell, seed),
            _ => lattice.word(cell, seed),
        }
    }

    /// Returns the unscaled value at `p` on a lattice.
    #[must_use]
    pub fn value_on<const D: usize>(self, words: Words<'_, D>, p: [f64; D], seed: u32) -> f64 {
        let parts = self.parts(p);
        self.sum(&self.drawn(words, &parts, seed), &parts)
    }

    /// Returns the contributions of the lattice points of parts.
    fn drawn<const D: usize>(self, words: Words<'_, D>, parts: &[Part<D>], seed: u32) -> Vec<Drawn<D>> {
        parts.iter().map(|part| self.draw(words(part.0, seed))).collect()
    }

    /// Returns the unscaled value from parts and the contributions of their lattice points.
    fn sum<const D: usize>(self, drawn: &[Drawn<D>], parts: &[Part<D>]) -> f64 {
        let (mut n, mut v) = (0.0, 0.0);
        for k in 0..drawn.len() {
            let (_, w, d) = &parts[k];
            n += w * drawn[k].at(d);
            v += w * w * (1.0 + 4.0 * dot(d, d));
        }
        if matches!(self, Self::Gaussian(_)) { n / v.sqrt() } else { n }
    }

    /// Returns the contribution of a lattice point with a word at offset `d`, with weight `w`.
    #[must_use]
    pub fn part<const D: usize>(self, word: u32, w: f64, d: [f64; D]) -> f64 {
        w * self.draw(word).at(&d)
    }

    /// Returns the contribution of a lattice point from its word.
    fn draw<const D: usize>(self, word: u32) -> Drawn<D> {
        let (value, slope) = match self {
            Self::Value => (f64::from(word as i32) / 2_147_483_648.0, [0.0; D]),
            Self::White | Self::CatmullRom => (uniform(word), [0.0; D]),
            Self::PerlinClassic => (0.0, PerlinClassic::gradient(word).map(f64::from)),
            Self::Perlin | Self::Simplex(_) => (0.0, Perlin::gradient(word).map(f64::from)),
            Self::ValueGradient(weight) => {
                let rise = weight * 2.0 / (D as f64).sqrt();
                let slope = PerlinClassic::gradient(word).map(|slope| rise * f64::from(slope));
                ((1.0 - weight) * uniform(further(word, 6)), slope)
            }
            Self::Sparse(impulses) => {
                let first = std::iter::successors(Some(word), |&word| Some(further(word, 3)));
                return Drawn::Impulses(first.take(impulses as usize).map(impulse).collect());
            }
            Self::Gaussian(channel) => {
                let (value, gradient) = GaussianNoise::variates::<D>(word)[channel];
                (f64::from(value), gradient.map(|slope| 2.0 * f64::from(slope)))
            }
        };
        Drawn::Line(value, slope)
    }

    /// Returns the lattice points that contribute to the value at `p`.
    #[must_use]
    pub fn parts<const D: usize>(self, p: [f64; D]) -> Vec<Part<D>> {
        match self {
            Self::White => around(p, 0..=0, |_| 1.0),
            Self::CatmullRom => around(p, -1..=2, catmull_rom),
            Self::PerlinClassic => around(p, 0..=1, |d| cubic(1.0 - d.abs())),
            Self::Value | Self::Perlin | Self::ValueGradient(_) | Self::Gaussian(_) => {
                around(p, 0..=1, |d| quintic(1.0 - d.abs()))
            }
            Self::Simplex(radius_squared) => simplex(p, radius_squared),
            Self::Sparse(impulses) => {
                // √(3/(K ∫h²)) with h = (1 − r²)³: ∫h² = πⁿᐟ² Γ(7)/Γ(n/2 + 7).
                let half = D as f64 / 2.0;
                let integral = std::f64::consts::PI.powf(half) * gamma(7.0) / gamma(half + 7.0);
                let amplitude = (3.0 / (f64::from(impulses) * integral)).sqrt();
                let mut parts = around(p, -1..=1, |_| 1.0);
                parts.iter_mut().for_each(|part| part.1 = amplitude);
                parts
            }
        }
    }

    /// Returns the gradient at `p` on a lattice by fourth-order central differences, exact to about
    /// 1e-9 of the noise's range.
    ///
    /// Returns `None` if a difference would reach into another cell or simplex, where some noises
    /// have a kink.
    #[must_use]
    pub fn gradient_on<const D: usize>(
        self,
        words: Words<'_, D>,
        p: [f64; D],
        seed: u32,
    ) -> Option<[f64; D]> {
        const H: f64 = 1e-4;
        let here = self.lattice_points(p);
        // The same lattice points for all differences.
        let drawn = self.drawn(words, &self.parts(p), seed);
        let mut gradient = [0.0; D];
        for (k, slope) in gradient.iter_mut().enumerate() {
            let at = |step: f64| {
                let mut q = p;
                q[k] += step;
                q
            };
            if [2.0 * H, -2.0 * H].into_iter().any(|step| self.lattice_points(at(step)) != here) {
                return None;
            }
            *slope = difference(H, |step| self.sum(&drawn, &self.parts(at(step))));
        }
        Some(gradient)
    }

    /// Returns the factors in 1 to 4 dimensions that scale the noise to its range.
    #[must_use]
    pub fn scales(self) -> [f64; 4] {
        let largest = match self {
            Self::White | Self::Sparse(_) | Self::Gaussian(_) => return [1.0; 4],
            Self::Value | Self::ValueGradient(_) => [1.0; 4],
            Self::CatmullRom => [1, 2, 3, 4].map(|n| 1.25_f64.powi(n)),
            Self::PerlinClassic => [1.0, 2.0, 3.0, 4.0].map(|n| f64::sqrt(n) / 2.0),
            Self::Perlin => [0.5, 0.934_535_6, 1.036_353_8, 1.536_582_3],
            Self::Simplex(0.5) => [0.009_196_735, 0.014_136_467, 0.013_007_157, 0.015_929_222],
            Self::Simplex(_) => [0.020_895_276, 0.040_496_275, 0.030_584_887, 0.036_730_024],
        };
        largest.map(|largest| (1.0 - 2e-6) / largest)
    }

    /// Returns points that identify the cell or simplex of `p`, in an order that changes only
    /// between cells or simplices.
    #[must_use]
    pub fn lattice_points<const D: usize>(self, p: [f64; D]) -> Vec<[i32; D]> {
        match self {
            Self::Simplex(_) => self.parts(p).into_iter().map(|part| part.0).collect(),
            _ => vec![p.map(|x| x.floor() as i32)],
        }
    }

    /// Returns the maximum value at `p` over all words.
    #[must_use]
    pub fn largest<const D: usize>(self, p: [f64; D]) -> f64 {
        let best = |(_, w, d): Part<D>| match self {
            Self::White | Self::Value | Self::CatmullRom => w.abs(),
            Self::PerlinClassic => w * dot(&d, &d).sqrt(),
            Self::Perlin | Self::Simplex(_) => w * best_edge(d),
            Self::ValueGradient(weight) => {
                w * (1.0 - weight + weight * 2.0 / (D as f64).sqrt() * dot(&d, &d).sqrt())
            }
            // The nearest position in the lattice point's cell.
            Self::Sparse(impulses) => w * f64::from(impulses) * kernel(d.map(|d| d - d.clamp(0.0, 1.0))),
            Self::Gaussian(_) => f64::INFINITY,
        };
        self.parts(p).into_iter().map(best).sum()
    }
}

/// Returns f′(0) by fourth-order differences.
#[must_use]
pub fn difference(h: f64, f: impl Fn(f64) -> f64) -> f64 {
    (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h)
}

/// Returns the upper 24 bits of a word as a number in (−1, 1).
fn uniform(word: u32) -> f64 {
    (f64::from(word >> 8) + 0.5) / 8_388_608.0 - 1.0
}

/// Returns another word of a lattice point.
fn further(word: u32, k: u32) -> u32 {
    let h = word.wrapping_add(k.wrapping_mul(0x9e37_79b9));
    let h = (h ^ h >> 15).wrapping_mul(0x846c_a68b);
    h ^ h >> 16
}

/// Returns the impulse of a word: its position in the cell and its weight.
fn impulse<const D: usize>(word: u32) -> ([f64; D], f64) {
    let second = further(word, 1);
    let fields = [word >> 16, word & 0xffff, second >> 16, second & 0xffff];
    let place = std::array::from_fn(|k| (f64::from(fields[k]) + 0.5) / 65_536.0);
    (place, uniform(if D < 3 { second } else { further(word, 2) }))
}

/// Returns (1 − r²)³ inside the unit ball.
fn kernel<const D: usize>(d: [f64; D]) -> f64 {
    (1.0 - dot(&d, &d)).max(0.0).powi(3)
}

fn cubic(t: f64) -> f64 {
    3.0 * t.powi(2) - 2.0 * t.powi(3)
}

fn quintic(t: f64) -> f64 {
    6.0 * t.powi(5) - 15.0 * t.powi(4) + 10.0 * t.powi(3)
}

/// Returns the spline weight of a point at a distance: Keys' kernel with a = −½.
fn catmull_rom(d: f64) -> f64 {
    let r = d.abs();
    if r < 1.0 {
        1.5 * r.powi(3) - 2.5 * r.powi(2) + 1.0
    } else {
        -0.5 * r.powi(3) + 2.5 * r.powi(2) - 4.0 * r + 2.0
    }
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let mut sum = 0.0;
    for k in 0..D {
        sum += a[k] * b[k];
    }
    sum
}

/// Returns max g·d over the edge directions: ±1 and smaller on the line, eight of length √2 in the
/// plane, all but one axis in higher dimensions.
fn best_edge<const D: usize>(d: [f64; D]) -> f64 {
    let mut sizes = d.map(f64::abs);
    sizes.sort_by(f64::total_cmp);
    match sizes.as_slice() {
        [size] => *size,
        // Eight directions of length √2 at odd multiples of 22.5°.
        [small, large] => {
            let (sin, cos) = std::f64::consts::FRAC_PI_8.sin_cos();
            std::f64::consts::SQRT_2 * (large * cos + small * sin)
        }
        [_, rest @ ..] => rest.iter().sum(),
        [] => 0.0,
    }
}

/// Returns the lattice points in a range of at most four around the cell of `p` along every axis,
/// with the product of the axes' weights.
fn around<const D: usize>(
    p: [f64; D],
    range: std::ops::RangeInclusive<i32>,
    weight: impl Fn(f64) -> f64,
) -> Vec<Part<D>> {
    let (first, count) = (*range.start(), (range.end() - range.start() + 1) as usize);
    // Coordinate, weight and offset along every axis.
    let mut axes = [[(0, 0.0, 0.0); 4]; D];
    for (k, axis) in axes.iter_mut().enumerate() {
        for (step, along) in (first..).zip(axis.iter_mut()).take(count) {
            let point = p[k].floor() + f64::from(step);
            *along = (point as i32, weight(p[k] - point), p[k] - point);
        }
    }
    let mut parts = vec![([0; D], 1.0, [0.0; D]); count.pow(D as u32)];
    for (index, (cell, w, d)) in parts.iter_mut().enumerate() {
        let mut digits = index;
        for k in 0..D {
            let (coordinate, weight, way) = axes[k][digits % count];
            (cell[k], d[k]) = (coordinate, way);
            *w *= weight;
            digits /= count;
        }
    }
    parts
}

/// Returns the corners of the simplex around `p`, with the kernel of a radius as weight.
fn simplex<const D: usize>(p: [f64; D], radius_squared: f64) -> Vec<Part<D>> {
    let n = D as f64;
    // In 1-D there is nothing to shear.
    let skew = if D == 1 { 0.0 } else { ((n + 1.0).sqrt() - 1.0) / n };
    let unskew = if D == 1 { 0.0 } else { (1.0 - 1.0 / (n + 1.0).sqrt()) / n };
    let sum: f64 = p.iter().sum();
    let skewed = p.map(|x| x + sum * skew);
    let mut order: [usize; D] = std::array::from_fn(|k| k);
    order.sort_by(|&a, &b| {
        (skewed[b] - skewed[b].floor()).total_cmp(&(skewed[a] - skewed[a].floor())).then(a.cmp(&b))
    });
    (0..=D)
        .map(|step| {
            let mut cell = skewed.map(f64::floor);
            for &axis in &order[..step] {
                cell[axis] += 1.0;
            }
            let back = cell.iter().sum::<f64>() * unskew;
            let d: [f64; D] = std::array::from_fn(|k| p[k] - (cell[k] - back));
            (cell.map(|c| c as i32), (radius_squared - dot(&d, &d)).max(0.0).powi(4), d)
        })
        .collect()
}
