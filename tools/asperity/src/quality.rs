//! Quality levels of images: draft, screen, print.

use asperity_render::image::tone::{filmic, srgb};
use asperity_render::integrator::adaptive::{Detail, Goal};
use clap::ValueEnum;

/// Quality of all images of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Quality {
    /// Small and noisy, for previews.
    Draft,
    /// For a screen.
    #[default]
    Default,
    /// For print. Takes hours.
    Book,
}

/// The parameters of a quality level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// Side of a square gallery panel in pixels.
    pub size: u32,
    /// Samples per pixel of ordinary gallery images.
    pub samples_per_pixel: u32,
    /// Median relative standard error of the pixels of still lifes.
    pub error: f32,
    /// Side of a single image in pixels.
    pub side: u32,
    /// Target noise of a single image, and the maximum samples per pixel.
    pub grain: (f32, u32),
}

impl Quality {
    /// Returns the parameters of this quality level.
    #[must_use]
    pub const fn fineness(self) -> Fineness {
        match self {
            Self::Draft => {
                Fineness { size: 192, samples_per_pixel: 1, error: 0.08, side: 256, grain: (0.03, 128) }
            }
            Self::Default => {
                Fineness { size: 384, samples_per_pixel: 4, error: 0.02, side: 512, grain: (0.008, 1024) }
            }
            Self::Book => {
                Fineness { size: 1024, samples_per_pixel: 32, error: 0.008, side: 2048, grain: (0.004, 8192) }
            }
        }
    }
}

impl Fineness {
    /// Returns the noise target of a still life. Errors of pixels darker than a tenth of white are
    /// relative to that value.
    pub const fn goal(&self) -> Goal {
        // Two samples estimate the error of a pixel. Most of an image needs few more.
        let samples = [self.samples_per_pixel.div_ceil(2), 10 * self.samples_per_pixel];
        Goal {
            error: self.error,
            shown: |luminance| srgb(filmic(EXPOSURE * luminance)),
            dark: 0.1,
            samples,
            detail: Detail::Coarse,
        }
    }
}

/// Exposure of still lifes in the studio.
pub const EXPOSURE: f32 = 1.45;
