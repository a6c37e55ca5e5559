//! Every kind of noise once more, in plain `f64` and in any dimension: slow, literal, and sharing only the lattice's words.

use asperity_noise::{IntegerHash, Lattice, edge_gradient, gaussian_corner, unit_gradient};

/// A kind of noise, before the scaling to its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Unit gradients, cubic weights.
    Perlin1985,
    /// Edge directions, quintic weights.
    Perlin2002,
    /// Simplex noise with this r².
    Simplex(f64),
    /// A channel of value-gradient noise over its standard deviation.
    Gaussian(usize),
}

impl Kind {
    /// The unscaled value at `p`.
    #[must_use]
    pub fn value<const D: usize>(self, p: [f64; D], seed: u32) -> f64 {
        match self {
            Self::Perlin1985 => {
                corners(p, cubic).map(|(cell, w, d)| w * dot(self.direction(cell, seed), d)).sum()
            }
            Self::Perlin2002 => {
                corners(p, quintic).map(|(cell, w, d)| w * dot(self.direction(cell, seed), d)).sum()
            }
            Self::Simplex(radius_squared) => simplex(p)
                .map(|(cell, d)| {
                    (radius_squared - dot(d, d)).max(0.0).powi(4) * dot(self.direction(cell, seed), d)
                })
                .sum(),
            Self::Gaussian(channel) => {
                let (mut n, mut v) = (0.0, 0.0);
                for (cell, w, d) in corners(p, quintic) {
                    let (value, gradient) = gaussian_corner::<D>(IntegerHash.word(cell, seed))[channel];
                    n += w * (f64::from(value) + 2.0 * dot(gradient.map(f64::from), d));
                    v += w * w * (1.0 + 4.0 * dot(d, d));
                }
                n / v.sqrt()
            }
        }
    }

    /// The gradient at `p` by central differences of fourth order, exact to about 1e-9 of the noise's range.
    ///
    /// None where a difference would reach into another cell or simplex, where some kinds have a kink.
    #[must_use]
    pub fn gradient<const D: usize>(self, p: [f64; D], seed: u32) -> Option<[f64; D]> {
        const H: f64 = 1e-4;
        let here = self.lattice_points(p);
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
            *slope = difference(H, |step| self.value(at(step), seed));
        }
        Some(gradient)
    }

    /// The lattice points that the value at `p` comes from, in an order that only another cell or simplex changes.
    #[must_use]
    pub fn lattice_points<const D: usize>(self, p: [f64; D]) -> Vec<[i32; D]> {
        match self {
            Self::Simplex(_) => simplex(p).map(|(cell, _)| cell).collect(),
            _ => corners(p, quintic).map(|(cell, ..)| cell).collect(),
        }
    }

    /// The greatest value that directions can give at `p`, if each corner draws the best one.
    #[must_use]
    pub fn greatest<const D: usize>(self, p: [f64; D]) -> f64 {
        match self {
            Self::Perlin1985 => corners(p, cubic).map(|(_, w, d)| w * dot(d, d).sqrt()).sum(),
            Self::Perlin2002 => corners(p, quintic).map(|(_, w, d)| w * best_edge(d)).sum(),
            Self::Simplex(radius_squared) => {
                simplex(p).map(|(_, d)| (radius_squared - dot(d, d)).max(0.0).powi(4) * best_edge(d)).sum()
            }
            Self::Gaussian(_) => f64::INFINITY,
        }
    }

    fn direction<const D: usize>(self, cell: [i32; D], seed: u32) -> [f64; D] {
        let word = IntegerHash.word(cell, seed);
        let direction = match self {
            Self::Perlin1985 => unit_gradient::<D>(word),
            _ => edge_gradient::<D>(word),
        };
        direction.map(f64::from)
    }
}

/// f′(0) by differences of fourth order.
#[must_use]
pub fn difference(h: f64, f: impl Fn(f64) -> f64) -> f64 {
    (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h)
}

fn cubic(t: f64) -> f64 {
    3.0 * t.powi(2) - 2.0 * t.powi(3)
}

fn quintic(t: f64) -> f64 {
    6.0 * t.powi(5) - 15.0 * t.powi(4) + 10.0 * t.powi(3)
}

fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    a.iter().zip(&b).map(|(a, b)| a * b).sum()
}

/// max g·d over the edge directions: ±1 and less on the line, eight of length √2 in the plane, then all but one axis.
fn best_edge<const D: usize>(d: [f64; D]) -> f64 {
    let mut sizes = d.map(f64::abs);
    sizes.sort_by(f64::total_cmp);
    match sizes.as_slice() {
        [size] => *size,
        [small, large] => (small + large).max(large * std::f64::consts::SQRT_2),
        [_, rest @ ..] => rest.iter().sum(),
        [] => 0.0,
    }
}

/// The corners of the cube around `p`: lattice point, weight, offset from it.
fn corners<const D: usize>(
    p: [f64; D],
    fade: impl Fn(f64) -> f64,
) -> impl Iterator<Item = ([i32; D], f64, [f64; D])> {
    (0..1_usize << D).map(move |corner| {
        let up: [f64; D] = std::array::from_fn(|k| (corner >> k & 1) as f64);
        let cell: [f64; D] = std::array::from_fn(|k| p[k].floor() + up[k]);
        let weight = (0..D).map(|k| fade(1.0 - (p[k] - cell[k]).abs())).product();
        (cell.map(|c| c as i32), weight, std::array::from_fn(|k| p[k] - cell[k]))
    })
}

/// The corners of the simplex around `p`: lattice point and offset from it.
fn simplex<const D: usize>(p: [f64; D]) -> impl Iterator<Item = ([i32; D], [f64; D])> {
    let n = D as f64;
    // On the line there is nothing to shear.
    let skew = if D == 1 { 0.0 } else { ((n + 1.0).sqrt() - 1.0) / n };
    let unskew = if D == 1 { 0.0 } else { (1.0 - 1.0 / (n + 1.0).sqrt()) / n };
    let sum: f64 = p.iter().sum();
    let skewed = p.map(|x| x + sum * skew);
    let mut order: [usize; D] = std::array::from_fn(|k| k);
    order.sort_by(|&a, &b| {
        (skewed[b] - skewed[b].floor()).total_cmp(&(skewed[a] - skewed[a].floor())).then(a.cmp(&b))
    });
    (0..=D).map(move |step| {
        let mut cell = skewed.map(f64::floor);
        for &axis in &order[..step] {
            cell[axis] += 1.0;
        }
        let back = cell.iter().sum::<f64>() * unskew;
        (cell.map(|c| c as i32), std::array::from_fn(|k| p[k] - (cell[k] - back)))
    })
}
