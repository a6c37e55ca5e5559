//! Projected areas of an NDF from a table over views.

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::{FRAC_PI_2, TAU};

use glam::{Vec2, Vec3};

use crate::masked::wedge::direction;
use crate::ndf::Ndf;
use asperity_core::math;

/// Azimuths of the table; even, so that each has an opposite one.
const AZIMUTHS: usize = 256;

/// Intervals of the elevation.
const ELEVATIONS: usize = 128;

/// Rings and sectors of the quadrature.
const RINGS: usize = 768;
const SECTORS: usize = 512;

/// `σ` along the lines from the horizon to the zenith.
///
/// ```text
/// v(q) = (1 − q) e_φ + q e_z,    F(q) = σ(v(q)) = Σ w max(0, (1 − q) m·e_φ + q m_z),    F′ = Σ_{flip_to_visible} w (m_z − m·e_φ)
/// ```
///
/// `σ` is homogeneous in the length of `v`, so these lines represent all views. Between the nodes,
/// `q = (j/n)²`, it is a cubic of the values and slopes at both ends. The nodes are denser near the
/// horizon where narrow lobes turn away. Between azimuths it is a cubic through four of them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ProjectedArea {
    /// `F` and `F′` at the nodes of each azimuth.
    nodes: Vec<[f32; 2]>,
}

impl ProjectedArea {
    pub(crate) fn new<N: Ndf + ?Sized>(ndf: &N) -> Self {
        let facets = facets(ndf);
        let mut nodes = vec![[0.0; 2]; AZIMUTHS * (ELEVATIONS + 1)];
        for k in 0..AZIMUTHS / 2 {
            let azimuth = TAU * k as f64 / AZIMUTHS as f64;
            let e = Vec2::new(math::cos_f64(azimuth) as f32, math::sin_f64(azimuth) as f32);
            // For both directions: what faces them at the horizon, and what begins to face them in
            // each interval.
            let mut turned = [[[0.0_f64; 2]; ELEVATIONS + 1]; 2];
            for &(m, weight) in &facets {
                let along = m.truncate().dot(e);
                let (near, far) = if along >= 0.0 { (0, 1) } else { (1, 0) };
                let (weight, steep, up) = (f64::from(weight), f64::from(along.abs()), f64::from(m.z));
                add(&mut turned[near][0], weight * steep, weight * (up - steep));
                let q = along.abs() / (along.abs() + m.z);
                let interval = ((math::sqrt(q) * ELEVATIONS as f32) as usize).min(ELEVATIONS - 1);
                add(&mut turned[far][interval + 1], -weight * steep, weight * (up + steep));
            }
            for (side, turned) in turned.iter().enumerate() {
                let row = (k + side * AZIMUTHS / 2) * (ELEVATIONS + 1);
                let mut sum = [0.0; 2];
                for (j, part) in turned.iter().enumerate() {
                    add(&mut sum, part[0], part[1]);
                    nodes[row + j] = [(sum[0] + place(j) * sum[1]) as f32, sum[1] as f32];
                }
            }
        }
        Self { nodes }
    }

    /// `σ(v)` for `v.z ≥ 0`, times the length of `v`.
    pub(crate) fn at(&self, v: Vec3) -> f64 {
        let [x, y, z] = v.to_array().map(f64::from);
        let across = math::sqrt_f64(x * x + y * y);
        let length = across + z;
        let q = z / length;
        let j = ((math::sqrt_f64(q) * ELEVATIONS as f64) as usize).min(ELEVATIONS - 1);
        let (from, width) = (place(j), place(j + 1) - place(j));
        let s = (q - from) / width;
        let turn = math::atan2_f64(y, x) / TAU * AZIMUTHS as f64;
        let first = math::floor_f64(turn);
        let t = turn - first;
        // Lagrange cubic through four azimuths.
        let weights = [
            -t * (t - 1.0) * (t - 2.0) / 6.0,
            (t * t - 1.0) * (t - 2.0) / 2.0,
            -t * (t + 1.0) * (t - 2.0) / 2.0,
            t * (t * t - 1.0) / 6.0,
        ];
        let mut sum = 0.0;
        for (k, weight) in weights.into_iter().enumerate() {
            let azimuth = (first as i64 + k as i64 - 1).rem_euclid(AZIMUTHS as i64) as usize;
            let row = azimuth * (ELEVATIONS + 1) + j;
            if let Some(&[begin, end, ..]) = self.nodes.get(row..) {
                sum += weight * hermite(begin.map(f64::from), end.map(f64::from), width, s);
            }
        }
        let area = sum * length;
        if area > 0.0 { area } else { 0.0 }
    }
}

fn add(sum: &mut [f64; 2], a: f64, b: f64) {
    *sum = [sum[0] + a, sum[1] + b];
}

/// `q` of a node.
fn place(j: usize) -> f64 {
    let t = j as f64 / ELEVATIONS as f64;
    t * t
}

/// The cubic from values and slopes at both ends of an interval.
fn hermite([a, slope_a]: [f64; 2], [b, slope_b]: [f64; 2], width: f64, s: f64) -> f64 {
    let r = 1.0 - s;
    a * r * r * (1.0 + 2.0 * s) + b * s * s * (3.0 - 2.0 * s) + width * s * r * (slope_a * r - slope_b * s)
}

/// Normals at the centers of rings, denser near the zenith, with weights `D dω` such that `Σ w m_z
/// = 1`.
fn facets<N: Ndf + ?Sized>(ndf: &N) -> Vec<(Vec3, f32)> {
    let mut facets = Vec::new();
    let mut total = 0.0;
    for ring in 0..RINGS {
        let t = (ring as f64 + 0.5) / RINGS as f64;
        let theta = FRAC_PI_2 * t * t;
        let (sin, half) = (math::sin_f64(theta), math::sin_f64(0.5 * theta));
        // dω = sin θ dθ dφ, dθ = π t dt. The number of sectors cancels, because the sum is divided
        // by it.
        let solid_angle = sin * t;
        for sector in 0..SECTORS {
            // Rings are rotated against each other, so that no edge along a meridian is counted too
            // often.
            let turn = (sector as f64 + (ring as f64 * 0.618_033_988_75) % 1.0) / SECTORS as f64;
            let m = direction((2.0 * half * half) as f32, turn as f32);
            let weight = f64::from(ndf.d(m)) * solid_angle;
            if weight > 0.0 {
                total += weight * f64::from(m.z);
                facets.push((m, weight as f32));
            }
        }
    }
    for (_, weight) in &mut facets {
        *weight = (f64::from(*weight) / total) as f32;
    }
    facets
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ggx, Microfacet};

    #[test]
    fn projected_areas_match_ggx() {
        for (x, y, least) in [(0.3, 0.6, 2e-5), (0.5, 0.05, 5e-4)] {
            let ggx = Ggx::new(x, y).unwrap();
            let table = ProjectedArea::new(&ggx);
            let mut worst = (0.0_f64, Vec3::Z);
            for k in 0..4000 {
                let (up, azimuth) = ((k as f32 * 0.618_034).fract().powi(3), k as f32 * 2.4);
                let across = (1.0 - up * up).sqrt();
                let v = Vec3::new(across * azimuth.cos(), across * azimuth.sin(), up);
                let error = (table.at(v) / f64::from(ggx.projected_area(v)) - 1.0).abs();
                if error > worst.0 {
                    worst = (error, v);
                }
            }
            assert!(worst.0 < least, "({x}, {y}): {worst:?}");
        }
    }
}
