//! Pixels of a plane: a sample with its derivatives and the eye.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::{Footprint, PixelEllipse, SurfacePoint};

/// A point of the plane z = 0, with the pixel about it and the eye.
#[derive(Clone, Copy, Debug)]
pub struct Pixel {
    /// The point, whose coordinates are those of the texture as well.
    pub at: Vec2,
    /// By how much it moves from one pixel to the next, to the right and down; zero for a sample without a filter.
    pub derivatives: [Vec2; 2],
    /// The most taps that it is filtered by.
    pub taps: u32,
    /// The eye.
    pub eye: Eye,
}

/// Place of the eye.
#[derive(Clone, Copy, Debug)]
pub enum Eye {
    /// From infinity, in this unit direction.
    Towards(Vec3),
    /// From this point.
    At(Vec3),
}

impl Pixel {
    /// The unit direction to the eye.
    #[must_use]
    pub fn view(&self) -> Vec3 {
        match self.eye {
            Eye::Towards(view) => view,
            Eye::At(eye) => (eye - self.at.extend(0.0)).normalize(),
        }
    }

    /// The ellipse that it covers.
    fn ellipse(&self) -> PixelEllipse {
        let [dx, dy] = self.derivatives.map(|d| d.extend(0.0));
        PixelEllipse::from_derivatives(dx, dy)
    }

    /// The round footprint: the long axis of the pixel.
    #[must_use]
    pub fn footprint(&self) -> Footprint {
        let [dx, dy] = self.derivatives.map(|d| d.extend(0.0));
        Footprint::from_derivatives(dx, dy)
    }

    /// The point of the surface with its whole pixel.
    #[must_use]
    pub fn whole(&self) -> SurfacePoint {
        self.point(self.ellipse())
    }

    /// The point of the surface, with this pixel.
    #[must_use]
    pub fn point(&self, pixel: impl Into<PixelEllipse>) -> SurfacePoint {
        SurfacePoint::new(self.at.extend(0.0), Vec3::Z, pixel).with_uv(self.at, [Vec3::X, Vec3::Y])
    }

    /// The mean of a radiance over the taps of the pixel.
    #[must_use]
    pub fn over(&self, radiance: impl Fn(&Self, Footprint) -> Vec3) -> Vec3 {
        let (sum, count) =
            self.ellipse().fine_taps(self.taps).fold((Vec3::ZERO, 0.0), |(sum, count), tap| {
                let there = Self { at: self.at + tap.offset.truncate(), ..*self };
                (sum + radiance(&there, tap.footprint), count + 1.0)
            });
        sum / count
    }

    /// The pixel of a plane whose surface is so many times as large.
    #[must_use]
    pub fn magnified(&self, by: f32) -> Self {
        let eye = match self.eye {
            Eye::At(eye) => Eye::At(eye / by),
            towards @ Eye::Towards(_) => towards,
        };
        Self { at: self.at / by, derivatives: self.derivatives.map(|d| d / by), eye, ..*self }
    }
}
