//! Ambient occlusion of a height field: the fraction of uniform sky light that its horizons let
//! through.

use std::f32::consts::FRAC_PI_2;

use glam::{Vec2, Vec3};

/// Slices of the sky, each with two horizons.
const SLICES: usize = 4;

/// Heights around a tile, in units of the texture's side.
pub(super) struct Surroundings {
    pub(super) heights: Vec<f32>,
    /// Texels along a side of `heights`, and the number of texels before the tile.
    pub(super) side: usize,
    pub(super) margin: usize,
    /// The side of a texel.
    pub(super) texel: f32,
}

/// Horizon sample positions: along eight directions, at increasing distances.
pub(super) struct Places([Vec<Place>; 2 * SLICES]);

#[derive(Clone, Copy)]
struct Place {
    step: isize,
    inverse_distance: f32,
}

impl Places {
    /// Positions at most `margin` texels away, for surroundings of this side.
    pub(super) fn new(around: &Surroundings) -> Self {
        let mut distances = vec![1];
        while let Some(next) = distances.last().map(|&last: &usize| (last + 1).max(last * 3 / 2))
            && next <= around.margin
        {
            distances.push(next);
        }
        distances.retain(|&distance| distance <= around.margin);
        Self(std::array::from_fn(|k| {
            // Every other direction is a diagonal.
            let (sin, cos) = (k as f32 * std::f32::consts::FRAC_PI_4).sin_cos();
            let mut places: Vec<(isize, isize)> = distances
                .iter()
                .map(|&distance| [cos, sin].map(|x| (x * distance as f32).round() as isize))
                .map(|[x, y]| (x, y))
                .collect();
            places.dedup();
            let place = |(x, y): (isize, isize)| Place {
                // Rows run downward.
                step: x - y * around.side as isize,
                inverse_distance: 1.0 / (Vec2::new(x as f32, y as f32).length() * around.texel),
            };
            places.into_iter().map(place).collect()
        }))
    }

    /// Returns the fraction of uniform sky light that reaches a texel with this normal.
    ///
    /// ```text
    /// A = Σ |n_p| (a(h₀) + a(h₁)) / Σ |n_p| (a(γ − π/2) + a(γ + π/2)),   a(h) = ¼ (−cos(2h − γ) + cos γ + 2h sin γ)
    /// ```
    ///
    /// over slices of the sky. γ is the angle of the normal's projection n_p in a slice, and h are
    /// the slice's two horizons, within π/2 of γ. Source: Jimenez, Wu, Pesce, Jarabo 2016,
    /// *Practical Real-Time Strategies for Accurate Indirect Occlusion*, eq. 7, divided by the
    /// value of an open sky.
    pub(super) fn occlusion(&self, around: &Surroundings, [column, row]: [usize; 2], normal: Vec3) -> f32 {
        let index = (row + around.margin) * around.side + column + around.margin;
        let own = around.heights[index];
        let (mut seen, mut open) = (0.0, 0.0);
        for slice in 0..SLICES {
            let (sin, cos) = (slice as f32 * std::f32::consts::FRAC_PI_4).sin_cos();
            let along = normal.x * cos + normal.y * sin;
            let (gamma, length) = (along.atan2(normal.z), along.hypot(normal.z));
            let horizon = |direction: usize| {
                let steepest = self.0[direction].iter().fold(f32::NEG_INFINITY, |steepest, place| {
                    let other = around.heights[index.wrapping_add_signed(place.step)];
                    steepest.max((other - own) * place.inverse_distance)
                });
                FRAC_PI_2 - steepest.atan()
            };
            let h =
                [(horizon(slice)).min(gamma + FRAC_PI_2), (-horizon(slice + SLICES)).max(gamma - FRAC_PI_2)];
            let arc = |h: f32| 0.25 * (gamma.cos() - (2.0 * h - gamma).cos() + 2.0 * h * gamma.sin());
            seen += length * (arc(h[0]) + arc(h[1]));
            open += length * (arc(gamma + FRAC_PI_2) + arc(gamma - FRAC_PI_2));
        }
        if open > 0.0 { (seen / open).clamp(0.0, 1.0) } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn around(height: impl Fn(f32, f32) -> f32) -> Surroundings {
        let (margin, side) = (40, 81);
        let heights = (0..side * side)
            .map(|k| height((k % side) as f32 - margin as f32, margin as f32 - (k / side) as f32) / 64.0)
            .collect();
        Surroundings { heights, side, margin, texel: 1.0 / 64.0 }
    }

    #[test]
    fn occlusion_of_inclined_plane_is_one() {
        let flat = around(|_, _| 0.25);
        assert!((Places::new(&flat).occlusion(&flat, [0, 0], Vec3::Z) - 1.0).abs() < 1e-6);
        let inclined = around(|x, y| 0.5 * x - 0.25 * y);
        let normal = Vec3::new(-0.5, 0.25, 1.0).normalize();
        assert!((Places::new(&inclined).occlusion(&inclined, [0, 0], normal) - 1.0).abs() < 1e-3);
        // Flip the slope, to check that the axes are not mirrored.
        let wrong = Vec3::new(-0.5, -0.25, 1.0).normalize();
        assert!(Places::new(&inclined).occlusion(&inclined, [0, 0], wrong) < 0.99);
    }

    #[test]
    fn occlusion_of_wall_and_cone() {
        // A high wall next to the texel hides half of every slice except the slice along the wall.
        let wall = around(|x, _| if x > 0.5 { 1e4 } else { 0.0 });
        let lit = Places::new(&wall).occlusion(&wall, [0, 0], Vec3::Z);
        // 3 of 4 slices are half hidden, and half of the integral over azimuth is.
        assert!((lit - 0.625).abs() < 1e-3, "{lit}");
        // At the bottom of a 45° cone, the visible sky is a cap with sin² 45° of the light.
        let cone = around(f32::hypot);
        let lit = Places::new(&cone).occlusion(&cone, [0, 0], Vec3::Z);
        assert!((lit - 0.5).abs() < 1e-3, "{lit}");
    }
}
