//! Environments: soft boxes in a dim room, and an outdoor day.

use std::f32::consts::{PI, TAU};

use asperity_shading::{Environment, EnvironmentMap};
use glam::{Vec2, Vec3};

use crate::{image::tone::hex, interpolation::smoothstep, light::lamps::direction};

/// An environment, part of which may be soft boxes.
pub trait Surroundings: Environment + Sync {
    /// The soft boxes.
    fn panels(&self) -> &[SoftPanel] {
        &[]
    }

    /// Returns the radiance without the soft boxes.
    fn between(&self, direction: Vec3) -> Vec3 {
        self.radiance(direction)
    }
}

impl Surroundings for Vec3 {}

impl Surroundings for EnvironmentMap {}

impl Surroundings for Studio {
    fn panels(&self) -> &[SoftPanel] {
        &self.panels
    }

    fn between(&self, direction: Vec3) -> Vec3 {
        self.room(direction)
    }
}

/// A room with soft boxes: distant area lights.
pub struct Studio {
    panels: Vec<SoftPanel>,
    floor: Vec3,
    ceiling: Vec3,
}

/// A rectangular light with soft borders.
pub struct SoftPanel {
    center: Vec3,
    /// Directions of the width and the height.
    sides: [Vec3; 2],
    /// Sines of the half angles.
    half: [f32; 2],
    radiance: Vec3,
    /// The fraction of the samples, in proportion to its light.
    share: f32,
}

/// The fraction of a panel's half width that is its soft border.
const BORDER: f32 = 0.12;

/// The fraction of samples for the room instead of the panels.
const ROOM: f32 = 0.25;

/// The fraction of the room's samples in the upper hemisphere. The others cover the sphere.
const ABOVE: f32 = 0.85;

impl SoftPanel {
    /// Creates a panel at azimuth and elevation with two full angles, in degrees. A white matte
    /// surface facing it has this color.
    fn new([azimuth, elevation]: [f32; 2], size: [f32; 2], color: Vec3) -> Self {
        let center = direction(azimuth, elevation);
        let right = Vec3::Z.cross(center).normalize();
        let [width, height] = size.map(|angle| (0.5 * angle.to_radians()).tan());
        // The border transmits half of its light.
        let lit = 4.0 * width * height * (1.0 - 0.5 * BORDER) * (1.0 - 0.5 * BORDER);
        let half = size.map(|angle| (0.5 * angle.to_radians()).sin());
        let sides = [right, center.cross(right)];
        Self { center, sides, half, radiance: color * (PI / lit), share: color.element_sum() }
    }

    /// Returns the fraction of the panel's light from a direction, and the solid-angle density of
    /// its samples. Each side's sine is distributed like the border, so that the two are nearly
    /// proportional.
    fn seen(&self, direction: Vec3) -> Option<[f32; 2]> {
        let depth = direction.dot(self.center);
        if depth <= 0.0 {
            return None;
        }
        let (mut share, mut density) = (1.0, 1.0 / (depth * depth * depth));
        for (side, half) in self.sides.iter().zip(self.half) {
            let aside = direction.dot(*side);
            let secant = 1.0 / (depth * depth + aside * aside).sqrt();
            let (sin, cos) = (aside * secant, depth * secant);
            share *= border(sin / half);
            if share == 0.0 {
                return None;
            }
            density *= cos * cos * cos / (half * (2.0 - BORDER));
        }
        Some([share, share * density])
    }

    /// Returns the radiance from a direction.
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        self.seen(direction).map_or(Vec3::ZERO, |[share, _]| self.radiance * share)
    }

    /// Samples a direction to the panel with the density [`pdf`](Self::pdf), from a uniform
    /// point of the unit square.
    pub fn sample(&self, u: Vec2) -> Vec3 {
        let aside = |k: usize| {
            let sin = self.half[k] * within_border(u[k]);
            self.sides[k] * (sin / (1.0 - sin * sin).sqrt())
        };
        (self.center + aside(0) + aside(1)).normalize()
    }

    /// Returns the solid-angle density of samples.
    pub fn pdf(&self, direction: Vec3) -> f32 {
        self.seen(direction).map_or(0.0, |[_, density]| density)
    }

    /// Returns the radiance from a direction, times a weight that depends on the sample density.
    pub fn weighted(&self, direction: Vec3, weight: impl FnOnce(f32) -> f32) -> Vec3 {
        self.seen(direction).map_or(Vec3::ZERO, |[share, density]| self.radiance * (share * weight(density)))
    }
}

/// Returns the fraction of light at a position within [−1, 1] along a side.
fn border(x: f32) -> f32 {
    ((1.0 - x.abs()) / BORDER).clamp(0.0, 1.0)
}

/// Samples a position within [−1, 1] with the density of the [`border`], from a uniform number.
fn within_border(u: f32) -> f32 {
    let signed = 2.0 * u - 1.0;
    // The remaining fraction of the half's area beyond the position: within the border, a
    // triangle's.
    let beyond = (1.0 - signed.abs()) * (1.0 - 0.5 * BORDER);
    let x = if beyond < 0.5 * BORDER {
        1.0 - (2.0 * BORDER * beyond).sqrt()
    } else {
        1.0 - 0.5 * BORDER - beyond
    };
    x.copysign(signed)
}

impl Studio {
    fn lit(mut panels: Vec<SoftPanel>, floor: Vec3, ceiling: Vec3) -> Self {
        let all: f32 = panels.iter().map(|panel| panel.share).sum();
        for panel in &mut panels {
            panel.share *= (1.0 - ROOM) / all;
        }
        Self { panels, floor, ceiling }
    }

    /// A warm key from the upper left, a cool fill from the right and a rim from behind, in a dim
    /// room.
    pub fn new(brightness: f32) -> Self {
        let panel = |place, size, color: Vec3| SoftPanel::new(place, size, color * brightness);
        let panels = vec![
            panel([-132.0, 46.0], [34.0, 34.0], hex(0xff_f2e2) * 0.85),
            panel([-18.0, 22.0], [18.0, 46.0], hex(0xb9_d0ff) * 0.4),
            panel([100.0, 40.0], [60.0, 20.0], hex(0xff_d6a8) * 0.5),
        ];
        Self::lit(panels, hex(0x4a_4642) * 0.35 * brightness, hex(0xb4_bcc8) * 0.55 * brightness)
    }

    /// A hall for a car: a long light sheet above, a strip along its flank and a strip behind, over
    /// a dark floor.
    pub fn hall(brightness: f32) -> Self {
        let panel = |place, size, color: Vec3| SoftPanel::new(place, size, color * brightness);
        let panels = vec![
            panel([-150.0, 70.0], [60.0, 60.0], hex(0xff_f6ea) * 0.8),
            panel([-70.0, 10.0], [110.0, 8.0], hex(0xd4_e2ff) * 0.3),
            panel([20.0, 30.0], [60.0, 14.0], hex(0xff_e2c0) * 0.5),
        ];
        Self::lit(panels, hex(0x30_3236) * 0.15 * brightness, hex(0x8a_93a0) * 0.9 * brightness)
    }

    /// A bright sky with a sun of 3 degrees, for outdoor subjects.
    pub fn day(brightness: f32) -> Self {
        let sun = SoftPanel::new([-140.0, 38.0], [3.0, 3.0], hex(0xff_f0d8) * 1.1 * brightness);
        Self::lit(vec![sun], hex(0x6b_645a) * 0.3 * brightness, hex(0x9c_bce8) * 0.8 * brightness)
    }

    fn room(&self, direction: Vec3) -> Vec3 {
        self.floor.lerp(self.ceiling, smoothstep(0.0, 1.0, 0.5 + 0.9 * direction.z))
    }
}

impl Environment for Studio {
    fn radiance(&self, direction: Vec3) -> Vec3 {
        self.panels.iter().fold(self.room(direction), |sum, panel| sum + panel.radiance(direction))
    }

    fn sample(&self, u: Vec2) -> Vec3 {
        if u.x < ROOM {
            // The zenith is brightest.
            let x = u.x / ROOM;
            let z = if x < ABOVE { x / ABOVE } else { 1.0 - 2.0 * (x - ABOVE) / (1.0 - ABOVE) };
            let (sin, cos) = (TAU * u.y).sin_cos();
            return Vec3::new(cos, sin, 0.0) * (1.0 - z * z).max(0.0).sqrt() + Vec3::Z * z;
        }
        let mut left = u.x - ROOM;
        let mut panel = &self.panels[0];
        for next in &self.panels {
            panel = next;
            if left < panel.share {
                break;
            }
            left -= panel.share;
        }
        panel.sample(Vec2::new((left / panel.share).min(1.0), u.y))
    }

    fn pdf(&self, direction: Vec3) -> f32 {
        let panels: f32 = self.panels.iter().map(|panel| panel.share * panel.pdf(direction)).sum();
        let above = if direction.z > 0.0 { 2.0 * ABOVE } else { 0.0 };
        ROOM * (above + 1.0 - ABOVE) / (4.0 * PI) + panels
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;
    use crate::sampling::sampler::Sampler;

    #[test]
    fn samples_integrate_all_light() {
        for studio in [Studio::new(1.0), Studio::hall(1.0), Studio::day(1.0)] {
            let irradiance = |by: &dyn Environment, seed| -> Vec3 {
                let samples = (0..1 << 16).map(|index| by.sample(Sampler::new(index, seed).point()));
                samples.map(|w| studio.radiance(w) * w.z.max(0.0) / by.pdf(w) / 65_536.0).sum()
            };
            let (by_light, all) = (irradiance(&studio, 3), irradiance(&Vec3::ONE, 4));
            // 65536 stratified samples hit the sun of 3 degrees about 70 times, which gives its
            // light to within a tenth.
            assert_abs_diff_eq!(by_light, all, epsilon = 0.12 * all.max_element());
        }
    }

    #[test]
    fn panel_lights_a_facing_surface_with_its_color() {
        let color = Vec3::new(0.2, 0.5, 1.0);
        let panel = SoftPanel::new([30.0, 20.0], [8.0, 12.0], color);
        let count = 4096;
        let light = (0..count).fold(Vec3::ZERO, |sum, index| {
            let w = panel.sample(Sampler::new(index, 1).point());
            sum + panel.radiance(w) * w.dot(panel.center) / (PI * panel.pdf(w)) / count as f32
        });
        // Off its center it is foreshortened: cos⁴ of 7 degrees.
        assert_abs_diff_eq!(light, color, epsilon = 0.02);
    }

    #[test]
    fn panel_sample_density_and_weights() {
        for studio in [Studio::new(1.0), Studio::hall(1.0), Studio::day(1.0)] {
            for panel in &studio.panels {
                let count = 1 << 14;
                // The mean over samples of the reciprocal density is the solid angle of the panel.
                let (mut solid_angle, mut range) = (0.0, [f32::INFINITY, 0.0_f32]);
                for index in 0..count {
                    let w = panel.sample(Sampler::new(index, 1).point());
                    let [share, density] = panel.seen(w).unwrap();
                    assert_eq!(panel.weighted(w, |_| 2.0), 2.0 * panel.radiance(w));
                    let sent = share / density;
                    range = [range[0].min(sent), range[1].max(sent)];
                    solid_angle += share / density / count as f32;
                }
                let [x, y] = panel.half.map(|sin| sin / (1.0 - sin * sin).sqrt());
                // By quadrature: a cell of the rectangle at depth 1 subtends depth³ of its area.
                let side = 400;
                let middle = |k: u32| (2.0 * k as f32 + 1.0) / side as f32 - 1.0;
                let expected: f32 = (0..side * side)
                    .map(|cell| {
                        let at = [x * middle(cell % side), y * middle(cell / side)];
                        let w = (panel.center + panel.sides[0] * at[0] + panel.sides[1] * at[1]).normalize();
                        let depth = w.dot(panel.center);
                        panel.seen(w).map_or(0.0, |[share, _]| share * depth * depth * depth)
                    })
                    .sum::<f32>()
                    * (4.0 * x * y / (side * side) as f32);
                assert_abs_diff_eq!(solid_angle, expected, epsilon = 2e-3 * expected);
                let corner = (x * y).powi(2) / (1.0 + x * x + y * y);
                assert!(range[1] / range[0] < (1.0 + corner).powf(1.5) * 1.001, "{range:?}");
            }
        }
    }
}
