//! Every kind of noise once more, in plain `f64` and in any dimension: slow, literal, and sharing only the lattice's words.

use asperity_noise::{
    IntegerHash, Lattice, edge_direction_2, edge_direction_3, gaussian_variates_2, gaussian_variates_3,
    unit_direction_2, unit_direction_3,
};

/// A kind of noise, before the scaling to its range.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// Unit gradients, cubic weights.
    Perlin1985,
    /// Edge directions, quintic weights.
    Perlin2002,
    /// Simplex noise with this r².
    Simplex(f64),
    /// Value-gradient noise over its standard deviation; the variates belong to this function of the word.
    Gaussian(fn(u64) -> u64),
}

impl Kind {
    /// The unscaled value at `p`.
    #[must_use]
    pub fn value<const D: usize>(self, p: [f64; D], seed: u32) -> f64 {
        match self {
            Self::Perlin1985 => {
                let fade = |t: f64| 3.0 * t.powi(2) - 2.0 * t.powi(3);
                corners(p, fade).map(|(cell, w, d)| w * dot(self.direction(cell, seed), d)).sum()
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
                    let variates = variates::<D>(channel(word(cell, seed)));
                    n += w * (variates.0 + 2.0 * dot(variates.1, d));
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
        let lattice_point = |p: [f64; D]| match self {
            Self::Simplex(_) => simplex(p).map(|(cell, _)| cell).collect::<Vec<_>>(),
            _ => corners(p, quintic).map(|(cell, ..)| cell).collect(),
        };
        let here = lattice_point(p);
        let mut gradient = [0.0; D];
        for (k, slope) in gradient.iter_mut().enumerate() {
            let moved = |step: f64| {
                let mut q = p;
                q[k] += step;
                q
            };
            if lattice_point(moved(2.0 * H)) != here || lattice_point(moved(-2.0 * H)) != here {
                return None;
            }
            let at = |step: f64| self.value(moved(step), seed);
            *slope = (8.0 * (at(H) - at(-H)) - (at(2.0 * H) - at(-2.0 * H))) / (12.0 * H);
        }
        Some(gradient)
    }

    /// The greatest value that directions can give at `p`, if each corner draws the best one.
    #[must_use]
    pub fn greatest<const D: usize>(self, p: [f64; D]) -> f64 {
        match self {
            Self::Perlin1985 => {
                let fade = |t: f64| 3.0 * t.powi(2) - 2.0 * t.powi(3);
                corners(p, fade).map(|(_, w, d)| w * dot(d, d).sqrt()).sum()
            }
            Self::Perlin2002 => corners(p, quintic).map(|(_, w, d)| w * best_edge(d)).sum(),
            Self::Simplex(radius_squared) => {
                simplex(p).map(|(_, d)| (radius_squared - dot(d, d)).max(0.0).powi(4) * best_edge(d)).sum()
            }
            Self::Gaussian(_) => f64::INFINITY,
        }
    }

    fn direction<const D: usize>(self, cell: [i32; D], seed: u32) -> [f64; D] {
        let word = word(cell, seed);
        let unit = matches!(self, Self::Perlin1985);
        let direction: Vec<f32> = match (D, unit) {
            (2, true) => unit_direction_2(word).to_array().to_vec(),
            (2, false) => edge_direction_2(word).to_array().to_vec(),
            (_, true) => unit_direction_3(word).to_array().to_vec(),
            (_, false) => edge_direction_3(word).to_array().to_vec(),
        };
        std::array::from_fn(|k| f64::from(direction[k]))
    }
}

fn word<const D: usize>(cell: [i32; D], seed: u32) -> u64 {
    match *cell.as_slice() {
        [x, y] => IntegerHash.hash2(x, y, seed),
        [x, y, z] => IntegerHash.hash3(x, y, z, seed),
        _ => 0,
    }
}

fn variates<const D: usize>(word: u64) -> (f64, [f64; D]) {
    let variates =
        if D == 2 { gaussian_variates_2(word).to_vec() } else { gaussian_variates_3(word).to_vec() };
    (f64::from(variates[0]), std::array::from_fn(|k| f64::from(variates[k + 1])))
}

fn quintic(t: f64) -> f64 {
    6.0 * t.powi(5) - 15.0 * t.powi(4) + 10.0 * t.powi(3)
}

fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    a.iter().zip(&b).map(|(a, b)| a * b).sum()
}

/// max g·d over the edge directions: eight of length √2 in the plane, twelve in space.
fn best_edge<const D: usize>(d: [f64; D]) -> f64 {
    let mut sizes = d.map(f64::abs);
    sizes.sort_by(f64::total_cmp);
    let two_greatest = sizes[D - 1] + sizes[D - 2];
    if D == 2 { two_greatest.max(sizes[1] * std::f64::consts::SQRT_2) } else { two_greatest }
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
    let skew = ((n + 1.0).sqrt() - 1.0) / n;
    let unskew = (1.0 - 1.0 / (n + 1.0).sqrt()) / n;
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
