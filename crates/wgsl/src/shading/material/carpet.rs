//! Carpet.

use asperity_shading::Carpet;
use asperity_shading::material::{SeamPattern, half_mean};

use super::surface::{FBM, GLOSSY, SEGMENTS, SURFACE_POINT, fbm_words, octaves_of};
use super::wear::segment_words;
use crate::ndf::ELEMENTARY;
use crate::noise::sums::OctavesUniform;
use crate::part::{Binding, Part, part};
use crate::shading::DIRECTION;
use crate::shading::pixel::FOOTPRINT;

/// Seams, lines or a grid, filtered over a pixel: [`Seams`](asperity_shading::material::Seams).
pub static SEAMS: Part = part!("shading/material/carpet/seams", DIRECTION, ELEMENTARY);

/// Short bent fibers that cover each other, [`Fibers`](asperity_shading::material::Fibers).
pub static FIBRES: Part = part!("shading/material/carpet/fibres", SEGMENTS, FOOTPRINT);

/// Carpet of threads, fibers, seams and dark areas, with rim light: [`Carpet`].
pub static CARPET: Part = part!("shading/material/carpet/carpet", SURFACE_POINT, FBM, SEAMS, FIBRES, GLOSSY)
    .with_bindings(&[Binding::Uniform { name: "carpet_uniform", of: "Carpet" }]);

/// Carpet as the words of the structure `Carpet`, and its sums of octaves.
///
/// | words | |
/// |---|---|
/// | 0–15 | for threads, shining threads, dark areas and threads over seams: cells per unit of length, highest frequency over lowest, octaves, index of the sum |
/// | 16–27 | fibers: their segments, half their width, bend, contrast, mean brightness |
/// | 28–31 | mean square of the slopes of fibers, their weight in the colors, tilt by them; pattern of seams: none, lines, grid |
/// | 32–39 | across the seams, their frequency in radians, darkening, slope; fraction covered by threads; variation and tilt by threads |
/// | 40–43 | rise by shining threads, darkening of dark areas, half the mean of simplex noise's magnitude, roughness |
/// | 44–55 | diffuse color, Beckmann's α; specular color, width of the rim; its light, 0 |
/// | 56–87 | coefficients of the mean of shining threads |
///
/// ```
/// use asperity_wgsl::shading::material::CarpetUniform;
/// use asperity_shading::{Carpet, CarpetParameters};
///
/// let carpet = CarpetUniform::new(&Carpet::new(CarpetParameters::default())?, 0);
/// assert_eq!([3, 7, 11, 15].map(|word| carpet.words()[word]), [0, 1, 2, 3]);
/// assert_eq!(carpet.sums().len(), 4);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarpetUniform {
    words: [u32; Self::WORDS],
    sums: [OctavesUniform<3>; 4],
}

impl CarpetUniform {
    /// Words of the structure.
    pub const WORDS: usize = 88;

    /// Packs carpet whose sums of octaves have the indices from `first` on in the uniform of sums.
    #[must_use]
    pub fn new(carpet: &Carpet, first: u32) -> Self {
        let (p, (threads, shine, dark, seams, crossover, fibres)) = (carpet.parameters(), carpet.parts());
        let (veins, frequency, coefficients) = shine.parts();
        let (segments, [half, mean, square_slope]) = fibres.parts();
        let f = &p.fibers;
        let fibre = [half, f.fiber_bend * segments.length, f.fiber_contrast, mean];
        let fibred = [square_slope, p.fiber_strength, p.fiber_bump_strength];
        let pattern = match p.seams_pattern {
            SeamPattern::None => 0,
            SeamPattern::Lines => 1,
            SeamPattern::Grid => 2,
        };
        let rim = p.fake_rim_light * p.fake_rim_light_color;
        let floats = [
            seams.direction().x,
            seams.direction().y,
            seams.frequency(),
            p.seams_amplitude,
            p.seams_bump_strength,
            p.seam_crossover_strength,
            p.diffuse_thread_strength,
            p.diffuse_thread_bump_strength,
            p.specular_thread_strength,
            p.dark_area_strength,
            half_mean(),
            p.roughness,
            p.diffuse.x,
            p.diffuse.y,
            p.diffuse.z,
            p.specular_roughness,
            p.specular.x,
            p.specular.y,
            p.specular.z,
            p.fake_rim_light_width,
            rim.x,
            rim.y,
            rim.z,
            0.0,
        ];
        let of_veins = [frequency.to_bits(), 4.0_f32.to_bits(), 3.0_f32.to_bits(), first.wrapping_add(1)];
        let fbms = [
            fbm_words(threads.noise(), first),
            of_veins,
            fbm_words(dark.noise(), first.wrapping_add(2)),
            fbm_words(crossover, first.wrapping_add(3)),
        ];
        let mut words = [0; Self::WORDS];
        for (to, from) in words.chunks_exact_mut(4).zip(&fbms) {
            to.copy_from_slice(from);
        }
        words[16..24].copy_from_slice(&segment_words(segments));
        words[24..28].copy_from_slice(&fibre.map(f32::to_bits));
        words[28..31].copy_from_slice(&fibred.map(f32::to_bits));
        words[31] = pattern;
        words[32..56].copy_from_slice(&floats.map(f32::to_bits));
        for (to, from) in words[56..].iter_mut().zip(coefficients.iter().flatten()) {
            *to = from.to_bits();
        }
        let of_veins = OctavesUniform::new(veins);
        let sums = [octaves_of(threads.noise()), of_veins, octaves_of(dark.noise()), octaves_of(crossover)];
        Self { words, sums }
    }

    /// Returns the words, in the layout of `Carpet`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.words
    }

    /// Returns the sums of octaves for the uniform of sums, from index `first` on.
    ///
    /// They belong to threads, shining threads, dark areas and threads over seams.
    #[must_use]
    pub const fn sums(&self) -> [OctavesUniform<3>; 4] {
        self.sums
    }
}
