//! Small images of a material: a flat patch or a ball.

use glam::{Vec2, Vec3};

use crate::geometry::{camera::Camera, shape::Shape};

/// Shape of a swatch. Lengths are in meters.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// A patch of the plane z = 0 of this height that fills the image, seen from straight above at
    /// this distance.
    Patch { height: f32, distance: f32 },
    /// A ball of this diameter, with this height visible in the image, seen along y from far away.
    Ball { diameter: f32, height: f32 },
}

/// Center of a patch, off the lattices of noises.
const CENTER: Vec2 = Vec2::new(1.371, 0.843);

/// Distance from which the viewer counts as infinitely far.
const FAR: f32 = 100.0;

impl Form {
    /// Returns the length of the scene's unit in meters.
    pub fn metres(self) -> f32 {
        match self {
            Self::Patch { .. } => 1.0,
            Self::Ball { diameter, .. } => 0.5 * diameter,
        }
    }

    /// Returns the shape.
    pub fn shape(self) -> Shape {
        match self {
            Self::Patch { .. } => Shape::Plane,
            Self::Ball { .. } => Shape::Sphere,
        }
    }

    /// Returns the camera of an image with these columns and rows.
    pub fn camera(self, [width, height]: [u32; 2]) -> Camera {
        match self {
            Self::Patch { height: extent, distance } => {
                let target = CENTER.extend(0.0);
                let eye = target + Vec3::Z * distance.min(1.0);
                if distance > FAR {
                    return Camera::parallel(eye, target, extent, width, height);
                }
                let field = 2.0 * (0.5 * extent / distance).atan();
                Camera::new(target + Vec3::Z * distance, target, field, width, height)
            }
            Self::Ball { height: extent, .. } => {
                Camera::parallel(Vec3::NEG_Y * 4.0, Vec3::ZERO, extent / self.metres(), width, height)
            }
        }
    }
}
