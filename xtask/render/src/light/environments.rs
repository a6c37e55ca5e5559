//! Light from all around: soft boxes in a dim room, and a day out of doors.

use std::f32::consts::{PI, TAU};

use asperity_shading::{Environment, EnvironmentMap};
use glam::{Vec2, Vec3};

use crate::{image::tone::hex, interpolation::smoothstep, light::lamps::direction};

/// Light from all around, of which a part may come from soft boxes.
pub trait Surroundings: Environment + Sync {
    /// The soft boxes.
    fn panels(&self) -> &[SoftPanel] {
        &[]
    }

    /// The radiance without them.
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

/// A room with soft boxes: area lights far away.
pub struct Studio {
    panels: Vec<SoftPanel>,
    floor: Vec3,
    ceiling: Vec3,
}

/// A rectangle of light at distance 1 whose border is soft.
pub struct SoftPanel {
    centre: Vec3,
    /// Half the width and half the height.
    half: [Vec3; 2],
    radiance: Vec3,
    area: f32,
    /// The share of the samples, by its light.
    share: f32,
}

/// The share of a panel's half width that is its soft border.
const BORDER: f32 = 0.12;

/// The share of samples that go to the room instead of the panels.
const ROOM: f32 = 0.25;

/// The share of those that go upwards; the others go all around.
const ABOVE: f32 = 0.85;

impl SoftPanel {
    /// A panel about an azimuth and an elevation, of two full angles, in degrees; a white matte surface that faces it has this colour.
    fn new([azimuth, elevation]: [f32; 2], size: [f32; 2], colour: Vec3) -> Self {
        let centre = direction(azimuth, elevation);
        let right = Vec3::Z.cross(centre).normalize();
        let half = size.map(|angle| (0.5 * angle.to_radians()).tan());
        let area = 4.0 * half[0] * half[1];
        // The border passes half of its light.
        let lit = area * (1.0 - 0.5 * BORDER) * (1.0 - 0.5 * BORDER);
        let half = [right * half[0], centre.cross(right) * half[1]];
        Self { centre, half, radiance: colour * (PI / lit), area, share: colour.element_sum() }
    }

    /// Place on the panel that a direction meets, −1 … 1 along both sides.
    fn place(&self, direction: Vec3) -> Option<Vec2> {
        let depth = direction.dot(self.centre);
        if depth <= 0.0 {
            return None;
        }
        let p = direction / depth - self.centre;
        let [x, y] = self.half.map(|half| p.dot(half) / half.length_squared());
        (x.abs() < 1.0 && y.abs() < 1.0).then_some(Vec2::new(x, y))
    }

    /// The radiance from a direction.
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        self.place(direction).map_or(Vec3::ZERO, |p| {
            let soft = (Vec2::ONE - p.abs()) / BORDER;
            self.radiance * soft.x.min(1.0) * soft.y.min(1.0)
        })
    }

    /// A direction to the panel with the density [`density`](Self::density), from a uniform point of the unit square.
    pub fn sample(&self, u: Vec2) -> Vec3 {
        let [x, y] = self.half;
        (self.centre + x * (2.0 * u.x - 1.0) + y * (2.0 * u.y - 1.0)).normalize()
    }

    /// Density of samples by solid angle.
    pub fn density(&self, direction: Vec3) -> f32 {
        let depth = direction.dot(self.centre);
        if self.place(direction).is_some() { 1.0 / (self.area * depth * depth * depth) } else { 0.0 }
    }
}

impl Studio {
    fn lit(mut panels: Vec<SoftPanel>, floor: Vec3, ceiling: Vec3) -> Self {
        let all: f32 = panels.iter().map(|panel| panel.share).sum();
        for panel in &mut panels {
            panel.share *= (1.0 - ROOM) / all;
        }
        Self { panels, floor, ceiling }
    }

    /// A warm key from the upper left, a cool fill from the right and a rim from behind, in a dim room.
    pub fn new(brightness: f32) -> Self {
        let panel = |place, size, colour: Vec3| SoftPanel::new(place, size, colour * brightness);
        let panels = vec![
            panel([-132.0, 46.0], [34.0, 34.0], hex(0xff_f2e2) * 0.85),
            panel([-18.0, 22.0], [18.0, 46.0], hex(0xb9_d0ff) * 0.4),
            panel([100.0, 40.0], [60.0, 20.0], hex(0xff_d6a8) * 0.5),
        ];
        Self::lit(panels, hex(0x4a_4642) * 0.35 * brightness, hex(0xb4_bcc8) * 0.55 * brightness)
    }

    /// A hall for a car: a long sheet of light above it, a strip along its flank and one behind, over a dark floor.
    pub fn hall(brightness: f32) -> Self {
        let panel = |place, size, colour: Vec3| SoftPanel::new(place, size, colour * brightness);
        let panels = vec![
            panel([-150.0, 70.0], [60.0, 60.0], hex(0xff_f6ea) * 0.8),
            panel([-70.0, 10.0], [110.0, 8.0], hex(0xd4_e2ff) * 0.3),
            panel([20.0, 30.0], [60.0, 14.0], hex(0xff_e2c0) * 0.5),
        ];
        Self::lit(panels, hex(0x30_3236) * 0.15 * brightness, hex(0x8a_93a0) * 0.9 * brightness)
    }

    /// The sky of a bright day behind a sun 3 degrees wide, for what lies out of doors.
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
            // From above comes the most.
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

    fn density(&self, direction: Vec3) -> f32 {
        let panels: f32 = self.panels.iter().map(|panel| panel.share * panel.density(direction)).sum();
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
    fn samples_bring_the_light_of_all_directions() {
        for studio in [Studio::new(1.0), Studio::hall(1.0), Studio::day(1.0)] {
            let irradiance = |by: &dyn Environment, seed| -> Vec3 {
                let samples = (0..1 << 16).map(|index| by.sample(Sampler::new(index, seed).point()));
                samples.map(|w| studio.radiance(w) * w.z.max(0.0) / by.density(w) / 65_536.0).sum()
            };
            let (by_light, all) = (irradiance(&studio, 3), irradiance(&Vec3::ONE, 4));
            // 65536 even samples find about 70 times the sun of 3 degrees, a tenth of its light either way.
            assert_abs_diff_eq!(by_light, all, epsilon = 0.12 * all.max_element());
        }
    }

    #[test]
    fn a_panel_lights_what_faces_it_with_its_colour() {
        let colour = Vec3::new(0.2, 0.5, 1.0);
        let panel = SoftPanel::new([30.0, 20.0], [8.0, 12.0], colour);
        let count = 4096;
        let light = (0..count).fold(Vec3::ZERO, |sum, index| {
            let w = panel.sample(Sampler::new(index, 1).point());
            sum + panel.radiance(w) * w.dot(panel.centre) / (PI * panel.density(w)) / count as f32
        });
        // Off its centre it is foreshortened: cos⁴ of 7 degrees.
        assert_abs_diff_eq!(light, colour, epsilon = 0.02);
    }
}
