//! Pixels of a plane: a sample with its derivatives and the viewer.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::{PixelEllipse, SurfacePoint};

/// A point of the plane z = 0 with its pixel and the viewer. Its coordinates are also the texture
/// coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixel {
    pub(super) point: SurfacePoint,
    /// Maximum number of filter taps.
    pub(super) taps: u32,
    pub(super) eye: Eye,
}

/// Position of the viewer.
#[derive(Clone, Copy, Debug)]
pub(super) enum Eye {
    /// At infinity, in this unit direction.
    Towards(Vec3),
    /// At this point.
    At(Vec3),
}

impl Pixel {
    /// Creates the point with its change from one pixel to the next, to the right and down; zero
    /// for an unfiltered sample.
    pub(super) fn new(at: Vec2, derivatives: [Vec2; 2], taps: u32, eye: Eye) -> Self {
        let [dx, dy] = derivatives.map(|d| d.extend(0.0));
        let pixel = PixelEllipse::from_derivatives(dx, dy);
        let point = SurfacePoint::new(at.extend(0.0), Vec3::Z, pixel).with_uv(at, [Vec3::X, Vec3::Y]);
        Self { point, taps, eye }
    }

    /// Returns the unit direction from a point to the viewer.
    pub(super) fn view(&self, from: &SurfacePoint) -> Vec3 {
        match self.eye {
            Eye::Towards(view) => view,
            Eye::At(eye) => (eye - from.position).normalize(),
        }
    }

    /// Averages radiances over the taps of the pixel. `add` accumulates them from the point and the
    /// direction to the viewer.
    pub(super) fn over(&self, means: &mut [Vec3], add: impl Fn(SurfacePoint, Vec3, &mut [Vec3])) {
        let point = self.point;
        means.fill(Vec3::ZERO);
        let mut count = 0.0;
        for tap in point.pixel.fine_taps(self.taps) {
            let (position, uv) = (point.position + tap.offset, point.uv + tap.offset.truncate());
            let there = SurfacePoint { position, uv, pixel: tap.footprint.into(), ..point };
            add(there, self.view(&there), means);
            count += 1.0;
        }
        means.iter_mut().for_each(|mean| *mean /= count);
    }
}
