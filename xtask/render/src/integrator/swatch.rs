//! Small pictures of a material: a flat patch or a ball under lamps far away, without shadows or paths, and so without noise.

use std::f32::consts::PI;

use asperity_shading::{Footprint, SurfacePoint};
use glam::{Vec2, Vec3};

use crate::{
    integrator::path_tracer::{Appearance, Behind, Coat, Finish, Lit, Seen},
    light::{background::background, lamps::Light},
};

/// A piece of a material and its light.
pub struct Swatch<'a> {
    pub form: Form,
    /// A white matte surface that faces one has its colour.
    pub lamps: &'a [Light],
    /// What smooth surfaces mirror.
    pub mirrored: &'a (dyn Fn(Vec3) -> Vec3 + Sync),
}

/// What has the material; lengths are in metres.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// A patch of the plane z = 0 that fills the picture, as high as this, seen from straight above by an eye at this distance.
    Patch { height: f32, distance: f32 },
    /// A ball of this diameter, of which so much fits the picture's height, seen along y by an eye far away.
    Ball { diameter: f32, height: f32 },
}

/// Where the middle of a patch is: off the lattices of noises.
const CENTRE: Vec2 = Vec2::new(1.371, 0.843);

impl Form {
    /// What is seen at a place of the picture, whose height is 1, from its middle, up and to the right; none beside the ball.
    fn seen(self, place: Vec2, rows: f32) -> Option<Seen> {
        match self {
            Self::Patch { height, distance } => {
                let p = place * height;
                let position = (CENTRE + p).extend(0.0);
                let point = SurfacePoint::new(position, Vec3::Z, Footprint::from_width(height / rows))
                    .with_uv(CENTRE + p, [Vec3::X, Vec3::Y]);
                let view = (-p).extend(distance).normalize();
                Some(Seen { point, view, tangent: Vec3::X })
            }
            Self::Ball { diameter, height } => {
                let radius = 0.5 * diameter;
                let p = place * (height / radius);
                let depth = 1.0 - p.length_squared();
                if depth <= 0.0 {
                    return None;
                }
                let cosine = depth.sqrt();
                let normal = Vec3::new(p.x, -cosine, p.y);
                let east = Vec3::new(-normal.y, normal.x, 0.0);
                let across = east.length().max(1e-3);
                let tangent = east / across;
                let uv = Vec2::new(normal.x.atan2(-normal.y), normal.z.clamp(-1.0, 1.0).asin()) * radius;
                // The longer axis of what a pixel covers.
                let footprint = Footprint::from_width(height / rows / cosine.max(0.05));
                let point = SurfacePoint::new(normal * radius, normal, footprint)
                    .with_uv(uv, [tangent * across, normal.cross(tangent)]);
                Some(Seen { point, view: Vec3::NEG_Y, tangent })
            }
        }
    }
}

impl Swatch<'_> {
    /// The radiance of a material at a point of a picture of so many columns and rows, in pixels from the top left.
    pub fn radiance(&self, finish: &Finish<'_>, [x, y]: [f32; 2], [columns, rows]: [f32; 2]) -> Vec3 {
        let place = Vec2::new(x - 0.5 * columns, 0.5 * rows - y) / rows;
        match self.form.seen(place, rows) {
            Some(seen) => self.lit(&seen, &finish(&seen)),
            None => background(x / columns, y / rows),
        }
    }

    fn lit(&self, seen: &Seen, appearance: &Appearance) -> Vec3 {
        let layers = Lit::new(&appearance.layers, seen);
        let sum = self.lamps.iter().fold(Vec3::ZERO, |sum, lamp| {
            sum + PI * lamp.colour * layers.reflected(seen.point.normal, lamp.direction)
        });
        appearance.glow + appearance.coat.map_or(sum, |coat| self.coated(seen, coat, sum))
    }

    /// What a coat mirrors, and what is left of the light below it; behind a pane or a body it is dark.
    ///
    /// Its slopes that are too fine for the pixel are left out: pictures are to be near enough to resolve them.
    fn coated(&self, seen: &Seen, coat: Coat, below: Vec3) -> Vec3 {
        let cosine = seen.view.dot(coat.normal).max(0.0);
        let direction = 2.0 * seen.view.dot(coat.normal) * coat.normal - seen.view;
        // What a bump mirrors into the surface would be mirrored out again.
        let down = direction.dot(seen.point.normal).min(0.0);
        let direction = (direction - 2.0 * down * seen.point.normal).normalize();
        let share = coat.fresnel.reflectance(cosine);
        let mirrored = (self.mirrored)(direction);
        match coat.behind {
            Behind::Layers => share * mirrored + (1.0 - share) * below,
            Behind::Pane(_) => 2.0 * share / (1.0 + share) * mirrored,
            Behind::Body(_) => share * mirrored,
            Behind::Metal(colour) => colour * mirrored,
        }
    }
}

#[cfg(test)]
mod tests {
    use asperity_shading::Lambert;

    use super::*;
    use crate::{integrator::path_tracer::Layer, materials};

    fn chalk(seen: &Seen) -> Appearance {
        let brdf = Lambert::new(Vec3::new(1.0, 0.5, 0.2)).expect("a share");
        Appearance {
            layers: vec![Layer { normal: seen.point.normal, brdf: Box::new(brdf) }],
            ..Default::default()
        }
    }

    #[test]
    fn chalk_that_faces_a_lamp_has_its_colour() {
        let lamps = [
            Light { direction: Vec3::Z, colour: Vec3::ONE },
            Light { direction: Vec3::NEG_Z, colour: Vec3::ONE },
        ];
        let form = Form::Patch { height: 0.1, distance: 1.0 };
        let swatch = Swatch { form, lamps: &lamps, mirrored: &|_| Vec3::ZERO };
        let seen = swatch.radiance(&chalk, [3.0, 9.0], [20.0, 10.0]);
        assert!(seen.abs_diff_eq(Vec3::new(1.0, 0.5, 0.2), 1e-5), "{seen}");
    }

    #[test]
    fn a_chrome_ball_mirrors_what_is_behind_the_eye_in_its_middle_and_has_nothing_beside_it() {
        let chrome = materials::chrome(Vec3::ONE).unwrap();
        let form = Form::Ball { diameter: 0.1, height: 0.1 };
        let swatch = Swatch { form, lamps: &[], mirrored: &|w| w };
        let at = |x, y| swatch.radiance(&chrome, [x, y], [10.0, 10.0]);
        assert!(at(5.0, 5.0).abs_diff_eq(Vec3::NEG_Y, 1e-6), "{}", at(5.0, 5.0));
        // Half of the radius to the right the normal leans by 30 degrees.
        let [sin, cos] = [0.5 * 3.0_f32.sqrt(), 0.5];
        assert!(at(7.5, 5.0).abs_diff_eq(Vec3::new(sin, -cos, 0.0), 1e-6), "{}", at(7.5, 5.0));
        assert_eq!(at(0.5, 0.5), background(0.05, 0.05));
    }

    #[test]
    fn texture_coordinates_of_a_ball_go_along_its_tangents() {
        let form = Form::Ball { diameter: 2.0, height: 2.0 };
        let at = |x, y| form.seen(Vec2::new(x, y), 100.0).unwrap().point;
        let (h, p) = (1e-3, at(0.2, 0.1));
        for step in [Vec2::new(h, 0.0), Vec2::new(0.0, h)] {
            let (a, b) = (at(0.2 - step.x, 0.1 - step.y), at(0.2 + step.x, 0.1 + step.y));
            let uv = b.uv - a.uv;
            let moved = p.tangents[0] * uv.x + p.tangents[1] * uv.y;
            // Third derivatives over a thousandth, and rounding of 1e-7 over it.
            assert!(moved.abs_diff_eq(b.position - a.position, 2e-6), "{step}: {moved}");
        }
    }
}
