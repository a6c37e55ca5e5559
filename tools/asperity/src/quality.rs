//! Fineness of pictures: a draft, what a screen shows, what is printed.

use asperity_render::image::tone::{filmic, srgb};
use asperity_render::integrator::adaptive::{Detail, Goal};
use clap::ValueEnum;

/// Fineness of all pictures of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Quality {
    /// Small and grainy, to see what there is.
    Draft,
    /// For a screen.
    #[default]
    Default,
    /// For paper: hours.
    Book,
}

/// The numbers of a quality.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// Side of a square panel of the gallery in pixels.
    pub size: u32,
    /// Samples of a pixel of its plain pictures.
    pub samples_per_pixel: u32,
    /// Relative standard error of the pixels of its still lifes, in the median.
    pub error: f32,
    /// Side of a single picture in pixels.
    pub side: u32,
    /// Grain of a single picture, and the most samples of a pixel.
    pub grain: (f32, u32),
}

impl Quality {
    /// The numbers of this quality.
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
    /// The grain of a still life: errors of what is darker than a tenth of white are told over that.
    pub const fn goal(&self) -> Goal {
        // Two tell the error of a pixel; most of a picture needs few more.
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
