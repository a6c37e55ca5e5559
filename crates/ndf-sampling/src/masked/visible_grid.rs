//! Visible normals of any NDF as a map of uniform numbers, from slopes on a grid.

use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use crate::ndf::Ndf;
use crate::numeric::normal_distribution::{gaussian_cdf, inverse_gaussian_cdf};

/// Nodes along a side.
const NODES: usize = 64;

/// Their distance in standard deviations. The outermost are at 4.1.
const SPACING: f64 = 0.13;

/// Coordinates beyond it, of probability 10⁻¹², are read as it. There `1 − Φ(z)` still has digits.
const FARTHEST: f64 = 7.0;

/// The steepest slope of a node.
const STEEPEST: f32 = 1e6;

/// The weight of invisible normals over the mean of a view, so that no visible normal between
/// invisible nodes is lost.
const FLOOR: f32 = 1.0 / 16384.0;

/// Numbers that the compiler adds in one register.
const LANES: usize = 8;

/// The slopes `S(u)` of the normals `T(Φ⁻¹(u))` at nodes of the unit square.
///
/// ```text
/// w_v(u) = max(0, v_z + v_x S_x(u) + v_y S_y(u)),   ∫ w_v du = σ(v),   density of visible normals: uniform u times w_v/σ
/// R_v: (u₁, u₂) from the marginal and the conditional distribution of w_v, bilinear between nodes
/// ```
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VisibleGrid {
    /// `Φ` of the nodes, 0 and 1 at the outermost.
    edges: [f64; NODES],
    /// The integral of the linear interpolation with the value 1 at a node and 0 at the others.
    shares: [f32; NODES],
    /// For each first coordinate the slopes along x and y at all second coordinates.
    columns: Vec<[[f32; NODES]; 2]>,
    /// The mean of `|S_x|` and `|S_y|`.
    spread: Vec2,
}

/// A point between two nodes: the first of them, and the fraction of the way.
type Place = (usize, f64);

impl VisibleGrid {
    pub(crate) fn new<N: Ndf + ?Sized>(ndf: &N) -> Self {
        let at = |k: usize| SPACING * (k as f64 - 0.5 * (NODES - 1) as f64);
        let mut edges = core::array::from_fn(|k| gaussian_cdf(at(k)));
        (edges[0], edges[NODES - 1]) = (0.0, 1.0);
        let shares = core::array::from_fn(|k| {
            let (left, right) = (edges[k.saturating_sub(1)], edges[(k + 1).min(NODES - 1)]);
            (0.5 * (right - left)) as f32
        });
        let mut spread = Vec2::ZERO;
        let columns = (0..NODES)
            .map(|i| {
                let mut column = [[0.0; NODES]; 2];
                for j in 0..NODES {
                    let m = ndf.warp_gaussian(Vec2::new(at(i) as f32, at(j) as f32));
                    let slope = m.truncate() / m.z.max(f32::MIN_POSITIVE);
                    let slope = slope.clamp(Vec2::splat(-STEEPEST), Vec2::splat(STEEPEST));
                    spread += slope.abs() * (shares[i] * shares[j]);
                    (column[0][j], column[1][j]) = (slope.x, slope.y);
                }
                column
            })
            .collect();
        Self { edges, shares, columns, spread }
    }

    /// `R_v`: Gaussian coordinates of a normal from those of a visible normal.
    pub(crate) fn warp(&self, v: Vec3, z: Vec2) -> Vec2 {
        let [p, q] = z.to_array().map(uniform);
        let sums = self.sums(v);
        let first = self.quantile(&sums, p);
        let second = self.quantile(&self.between(v, first), q);
        Vec2::new(self.gaussian(first), self.gaussian(second))
    }

    /// `R_v⁻¹`: the coordinates of a visible normal from those of a normal.
    pub(crate) fn invert(&self, v: Vec3, z: Vec2) -> Vec2 {
        let [first, second] = z.to_array().map(|z| self.place(uniform(z)));
        let (p, q) = (self.cdf(&self.sums(v), first), self.cdf(&self.between(v, first), second));
        Vec2::from([p, q].map(|u| bounded(inverse_gaussian_cdf(u)) as f32))
    }

    /// The density of visible coordinates over that of all, at the coordinates of a normal.
    pub(crate) fn ratio(&self, v: Vec3, z: Vec2) -> f32 {
        let [first, (j, t)] = z.to_array().map(|z| self.place(uniform(z)));
        let weights = self.between(v, first);
        let [low, high] = [weights[j], weights[j + 1]].map(f64::from);
        ((low + (high - low) * t) / self.total(&self.sums(v))) as f32
    }

    /// The weights of a column of nodes.
    #[inline]
    fn weights(&self, v: Vec3, column: usize) -> [f32; NODES] {
        let floor = FLOOR * (v.z + v.truncate().abs().dot(self.spread)).max(1e-20);
        let Some([x, y]) = self.columns.get(column) else { return [floor; NODES] };
        core::array::from_fn(|j| (v.z + v.x * x[j] + v.y * y[j]).max(0.0) + floor)
    }

    /// The integrals of the weights over the second coordinate.
    fn sums(&self, v: Vec3) -> [f32; NODES] {
        core::array::from_fn(|i| {
            let (weights, mut lanes) = (self.weights(v, i), [0.0; LANES]);
            for (j, (weight, share)) in weights.into_iter().zip(self.shares).enumerate() {
                lanes[j % LANES] += weight * share;
            }
            lanes.into_iter().sum()
        })
    }

    /// The weights over the second coordinate at a first coordinate between two nodes.
    fn between(&self, v: Vec3, (i, t): Place) -> [f32; NODES] {
        let (low, high, t) = (self.weights(v, i), self.weights(v, i + 1), t as f32);
        core::array::from_fn(|j| low[j] + (high[j] - low[j]) * t)
    }

    /// The integral between two neighboring nodes, up to a fraction of the way.
    fn part(&self, weights: &[f32; NODES], (k, t): Place) -> f64 {
        let [low, high] = [weights[k], weights[k + 1]].map(f64::from);
        (self.edges[k + 1] - self.edges[k]) * t * (low + 0.5 * (high - low) * t)
    }

    fn total(&self, weights: &[f32; NODES]) -> f64 {
        (0..NODES - 1).map(|k| self.part(weights, (k, 1.0))).sum()
    }

    fn cdf(&self, weights: &[f32; NODES], (k, t): Place) -> f64 {
        let below: f64 = (0..k).map(|k| self.part(weights, (k, 1.0))).sum();
        (below + self.part(weights, (k, t))) / self.total(weights)
    }

    /// The inverse of [`cdf`](Self::cdf).
    fn quantile(&self, weights: &[f32; NODES], p: f64) -> Place {
        let mut rest = p * self.total(weights);
        for k in 0..NODES - 1 {
            let whole = self.part(weights, (k, 1.0));
            if rest < whole || k == NODES - 2 {
                let [low, high] = [weights[k], weights[k + 1]].map(f64::from);
                let area = rest / (self.edges[k + 1] - self.edges[k]);
                let root = (low * low + 2.0 * (high - low) * area).max(0.0);
                return (k, (2.0 * area / (low + asperity_core::math::sqrt_f64(root))).clamp(0.0, 1.0));
            }
            rest -= whole;
        }
        (0, 0.0)
    }

    /// The cell of a uniform number, and the fraction of the way through it.
    fn place(&self, u: f64) -> Place {
        let k = self.edges[1..NODES - 1].partition_point(|&edge| edge <= u);
        (k, (u - self.edges[k]) / (self.edges[k + 1] - self.edges[k]))
    }

    fn gaussian(&self, (k, t): Place) -> f32 {
        let u = self.edges[k] + (self.edges[k + 1] - self.edges[k]) * t;
        bounded(inverse_gaussian_cdf(u)) as f32
    }
}

fn bounded(z: f64) -> f64 {
    if z.is_nan() { 0.0 } else { z.clamp(-FARTHEST, FARTHEST) }
}

/// `Φ(z)` of bounded `z`.
fn uniform(z: f32) -> f64 {
    gaussian_cdf(bounded(f64::from(z)))
}
