//! Sums of octaves: spectra, shapes, octaves of every kind of noise.

mod fbm;
mod mip_mapped;

pub use mip_mapped::MipMapped;

use asperity_noise::gpu::{
    FbmLayer2d, FbmLayer3d, FbmLayer4d, FbmSpectrumUniform, FbmUniform2d, FbmUniform3d, FbmUniform4d,
};

use self::fbm::{fbm, filled, octave_part, size};
use super::kinds::{self, CELL, FADE, GAUSSIAN, SAMPLE};
use crate::part::{Binding, Part, part};

/// Shapes of octaves: [`Turbulence`](asperity_noise::Turbulence), plasma, billow and ridged.
static SHAPE: Part = part!("noise/sums/shape");

/// Frequency clamping, [`filtered_fraction`](asperity_noise::filtered_fraction).
pub(crate) static FREQUENCY_CLAMP: Part = part!("noise/sums/frequency_clamp");

/// Weights of a real number of octaves, [`FbmSpectrum`](asperity_noise::FbmSpectrum), and the
/// divisor of a sum.
static SPECTRUM: Part = part!("noise/sums/spectrum", [FbmSpectrumUniform], FREQUENCY_CLAMP);

/// One octave, such as [`FbmLayer3d`]: its affine map in two, three and four dimensions.
static OCTAVE: Part = part!("noise/sums/octave", [FbmLayer2d, FbmLayer3d, FbmLayer4d]);

/// Uniform of sums of octaves in 3-D.
static UNIFORM_3D: Part = part!("noise/sums/uniform_3d", [FbmUniform3d], SPECTRUM, OCTAVE)
    .with_bindings(&[Binding::Uniform { name: "fbm_uniform_3d", of: "array<FbmUniform3d, 8>" }]);

/// Uniform of sums of octaves in 2-D.
static UNIFORM_2D: Part = part!("noise/sums/uniform_2d", [FbmUniform2d], SPECTRUM, OCTAVE)
    .with_bindings(&[Binding::Uniform { name: "fbm_uniform_2d", of: "array<FbmUniform2d, 8>" }]);

/// Uniform of sums of octaves in 4-D.
static UNIFORM_4D: Part = part!("noise/sums/uniform_4d", [FbmUniform4d], SPECTRUM, OCTAVE)
    .with_bindings(&[Binding::Uniform { name: "fbm_uniform_4d", of: "array<FbmUniform4d, 8>" }]);

/// Parts of [`Fbm`](asperity_noise::Fbm) in two or three dimensions, by kind of noise.
///
/// The field `perlin` of [`FBM_3D`] defines `perlin_fbm_3d` and the ridged multifractal
/// `perlin_ridged_multifractal_3d`. All parts of a dimension read one uniform, for instance
/// `fbm_uniform_3d`. It has up to eight sums, which functions index from 0.
///
/// ```
/// # #[cfg(feature = "alloc")] {
/// use asperity_wgsl::{Bindings, compose, noise::FBM_3D};
///
/// let wgsl = compose(&[&FBM_3D.perlin], Bindings::Textures { group: 0 });
/// assert!(wgsl.contains("fn perlin_fbm_3d(p: vec3<f32>, octaves: f32, footprint: f32, sum: u32) -> Sample3d"));
/// assert!(wgsl.contains("fn perlin_ridged_multifractal_3d(p: vec3<f32>, octaves: f32, feedback: f32, sum: u32) -> Sample3d"));
/// assert!(wgsl.contains("var<uniform> fbm_uniform_3d: array<FbmUniform3d, 8>;"));
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct FbmParts {
    /// [`ValueNoise`](asperity_noise::ValueNoise).
    pub value: Part,
    /// [`ValueCatmullRom`](asperity_noise::ValueCatmullRom).
    pub value_catmull_rom: Part,
    /// [`PerlinClassic`](asperity_noise::PerlinClassic).
    pub perlin_classic: Part,
    /// [`Perlin`](asperity_noise::Perlin).
    pub perlin: Part,
    /// [`ValueGradient`](asperity_noise::ValueGradient) with equal weights.
    pub value_gradient: Part,
    /// [`Simplex`](asperity_noise::Simplex).
    pub simplex: Part,
    /// [`Simplex::with_classic_radius`](asperity_noise::Simplex::with_classic_radius).
    pub simplex_classic: Part,
    /// [`SparseConvolution`](asperity_noise::SparseConvolution) with one impulse per cell.
    pub sparse_convolution: Part,
    /// Both channels of [`GaussianFbm`](asperity_noise::GaussianFbm), without a multifractal.
    pub gaussian: Part,
    /// One channel of [`GaussianNoise`](asperity_noise::GaussianNoise).
    pub gaussian_channel: Part,
    /// Running sums for a custom kind of noise.
    ///
    /// ```
    /// # #[cfg(feature = "alloc")] {
    /// use asperity_wgsl::{Bindings, Part, compose, noise::{FBM_3D, VALUE_GRADIENT}};
    ///
    /// // Value-gradient noise that is mostly gradients.
    /// static STEEP: Part = Part::new(
    ///     "steep",
    ///     "fn steep(p: vec3<f32>, octaves: f32, sum: u32) -> Sample3d {
    ///     var total = fbm_total_3d(octaves, 0.0, sum);
    ///     while fbm_goes_on(total.walk) {
    ///         let layer = fbm_layer_3d(sum, total.walk.octave);
    ///         let at = cell_place_3d(fbm_point_3d(layer, p));
    ///         let key = bitcast<u32>(layer.cell_and_key.w);
    ///         let octave = value_gradient_in_cell_3d(layer.cell_and_key.xyz + at.cell, at.place, 0.9, key);
    ///         total = fbm_added_3d(total, layer, sample_known_3d(octave, at.known));
    ///     }
    ///     return fbm_divided_3d(total);
    /// }
    /// ",
    ///     &[&FBM_3D.custom, &VALUE_GRADIENT],
    /// );
    /// assert!(compose(&[&STEEP], Bindings::Textures { group: 0 }).contains("fn steep"));
    /// # }
    /// ```
    pub custom: Part,
}

/// Parts of [`Fbm`](asperity_noise::Fbm) in four dimensions, see [`FbmParts`].
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct FbmParts4d {
    /// [`ValueNoise`](asperity_noise::ValueNoise).
    pub value: Part,
    /// [`Perlin`](asperity_noise::Perlin).
    pub perlin: Part,
    /// [`Simplex`](asperity_noise::Simplex).
    pub simplex: Part,
    /// [`Simplex::with_classic_radius`](asperity_noise::Simplex::with_classic_radius).
    pub simplex_classic: Part,
    /// Running sums for a custom kind of noise, as [`FbmParts::custom`].
    pub custom: Part,
}

/// [`Fbm`](asperity_noise::Fbm) in 2-D: `value_fbm_2d`, `perlin_fbm_2d`, …
pub static FBM_2D: FbmParts = fbm!(
    all FBM_2D,
    ["2", "in 2-D", "layer.cell", "layer.key"],
    UNIFORM_2D,
    part!("noise/sums/gaussian_fbm_2d", SPECTRUM, OCTAVE, UNIFORM_2D, CELL, GAUSSIAN)
);

/// [`Fbm`](asperity_noise::Fbm) in 3-D: `value_fbm_3d`, `perlin_fbm_3d`, …
pub static FBM_3D: FbmParts = fbm!(
    all FBM_3D,
    ["3", "in 3-D", "layer.cell_and_key.xyz", "bitcast<u32>(layer.cell_and_key.w)"],
    UNIFORM_3D,
    part!("noise/sums/gaussian_fbm_3d", SPECTRUM, OCTAVE, UNIFORM_3D, CELL, GAUSSIAN)
);

/// [`Fbm`](asperity_noise::Fbm) in 4-D: `value_fbm_4d`, `perlin_fbm_4d`, `simplex_fbm_4d`, …
pub static FBM_4D: FbmParts4d = fbm!(
    FBM_4D: FbmParts4d,
    ["4", "in 4-D", "layer.cell", "layer.key"],
    UNIFORM_4D,
    [value, perlin, simplex, simplex_classic]
);

/// Slopes of Gaussian noise in a tangent plane in 3-D,
/// [`Fbm::whitened_gradient`](asperity_noise::Fbm::whitened_gradient), and its
/// [`height`](asperity_noise::Fbm::height).
pub static GAUSSIAN_SLOPES_3D: Part =
    part!("noise/sums/gaussian_slopes_3d", SPECTRUM, OCTAVE, UNIFORM_3D, CELL, FADE, GAUSSIAN);

/// Octaves of Gaussian noise in 2-D from a mip-mapped texture, [`MipMapped`].
///
/// The method of Kautz, Heidrich, Seidel 2001, §5.2.2. Bound to the two-channel texture
/// `mip_mapped_noise`, and to a repeating sampler that is linear between texels and levels.
pub static MIP_MAPPED: Part = part!("noise/sums/mip_mapped", SPECTRUM, UNIFORM_2D).with_bindings(&[
    Binding::Texture { name: "mip_mapped_noise" },
    Binding::Sampler { name: "mip_mapped_sampler" },
]);
