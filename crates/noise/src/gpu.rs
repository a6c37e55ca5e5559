//! Sums of octaves as uniforms of shaders.
//!
//! The shaders are in the crate `asperity-wgsl`. The feature `bytemuck` implements `Pod` for the
//! structs. Their declarations in WGSL are generated from the same definitions.
//!
//! ```
//! use asperity_noise::gpu::FbmUniform3d;
//! use asperity_noise::{FbmSpectrum, GaussianFbm, GaussianNoise, glam::Vec3};
//!
//! let sum = GaussianFbm::<Vec3>::new(GaussianNoise::new(7), FbmSpectrum::default());
//! let packed = sum.gpu();
//! assert_eq!((packed.spectrum.lacunarity, packed.spectrum.max_octaves), (2.17, 10.0));
//! // The first octave is rotated and not scaled, so its rows have length 1.
//! let [x, y, z, _] = packed.layers[0].row_x;
//! assert!((Vec3::new(x, y, z).length() - 1.0).abs() < 1e-6);
//!
//! // An anchor changes only offsets and cells. In the shader, this sum has the index 1.
//! let far = sum.anchored([1e6, -3.0, 0.25]).gpu();
//! assert_ne!(far.layers[0].cell_and_key[..3], packed.layers[0].cell_and_key[..3]);
//! assert_eq!(FbmUniform3d::array(&[packed, far])[1], far);
//! ```

use asperity_core::gpu_struct;
use glam::{Vec2, Vec3, Vec4};

use crate::{
    contract::field::Field,
    kinds::gaussian::GaussianNoise,
    lattice::{gaussian_levels::TAIL_LINES, integer_hash::IntegerHash, lattice::Lattice, variates::LEVELS},
    point::Point,
    sums::{
        fbm::{Fbm, Normalization},
        octave::Octave,
        shape::Signed,
        turbulence::{Billow, Plasma, Ridged, Turbulence},
    },
};

impl IntegerHash {
    /// Returns the key of a seed, which shaders take instead of the seed.
    ///
    /// Its computation takes 64 bits.
    ///
    /// ```
    /// use asperity_noise::IntegerHash;
    ///
    /// assert_ne!(IntegerHash::gpu_key(1), IntegerHash::gpu_key(2));
    /// ```
    #[must_use]
    pub fn gpu_key(seed: u32) -> u32 {
        Self.key(seed)
    }
}

impl GaussianNoise {
    /// Iterates over the table `gaussian_level` of shaders, in units of the standard deviation.
    ///
    /// It has 88 rows of 64 texels. The first 4096 texels are the levels in ascending order, and
    /// the next repeats the last level. Then follow the lines of the values in the tails, each of
    /// two numbers, and zeros.
    ///
    /// ```
    /// use asperity_noise::GaussianNoise;
    ///
    /// let levels: Vec<f32> = GaussianNoise::gpu_levels().collect();
    /// assert!(levels.len() == 88 * 64 && levels[..4096].is_sorted());
    /// assert!(levels[0] == -levels[4095] && levels[4096] == levels[4095]);
    /// ```
    pub fn gpu_levels() -> impl Iterator<Item = f32> {
        let levels = LEVELS.iter().copied();
        let lines = TAIL_LINES.iter().copied().flatten();
        levels.chain(lines).chain(core::iter::repeat(0.0)).take(88 * 64)
    }
}

/// The number of sums in a uniform of shaders.
const SUMS: usize = 8;

mod numbered {
    use crate::sums::shape::Shape;

    #[diagnostic::on_unimplemented(
        message = "shaders do not support the shape `{Self}`",
        note = "use `Signed`, `Turbulence`, `Plasma`, `Billow` or `Ridged`"
    )]
    pub trait Numbered: Shape {
        /// The number of the shape in `fbm_shape_value`.
        const NUMBER: u32;
    }
}

macro_rules! shapes {
    ($($shape:ty: $number:literal),*) => {
        $(impl numbered::Numbered for $shape {
            const NUMBER: u32 = $number;
        })*
    };
}

shapes!(Signed: 0, Turbulence: 1, Plasma: 2, Billow: 3, Ridged: 4);

gpu_struct! {
    /// The spectrum and the divisor of a sum of octaves.
    pub struct FbmSpectrumUniform as "FbmSpectrum" {
        /// Ratio of the frequencies of successive octaves.
        lacunarity: f32,
        /// Ratio of their amplitudes.
        gain: f32,
        /// At most 16.
        max_octaves: f32,
        /// 1 - gain^2 for a gain below 1, otherwise the sum of the squares of all amplitudes.
        variance: f32,
        /// Mean of one octave of amplitude 1.
        mean: f32,
        /// Standard deviation of one octave of amplitude 1.
        deviation: f32,
        /// 0 for `Normalization::UnitRange`, 1 for `Normalization::UnitVariance`.
        normalization: u32,
        /// 0 for `Signed`, then `Turbulence`, `Plasma`, `Billow`, `Ridged`.
        shape: u32,
    }
}

gpu_struct! {
    /// One octave in 2-D: its affine map into the cells of its lattice, and its key.
    pub struct FbmLayer2d as "FbmLayer2d" {
        /// Both rows of the matrix, rotation times frequency, in cells per unit.
        rows: [f32; 4],
        /// Offset in cells.
        offset: [f32; 2],
        /// Origin of the cells.
        cell: [i32; 2],
        /// Key of the random words.
        key: u32,
        .. padding: [u32; 3]
    }
}

gpu_struct! {
    /// One octave in 3-D: its affine map into the cells of its lattice, and its key.
    pub struct FbmLayer3d as "FbmLayer3d" {
        /// First row of the matrix, rotation times frequency, in cells per unit; offset in cells.
        row_x: [f32; 4],
        /// Second row and offset.
        row_y: [f32; 4],
        /// Third row and offset.
        row_z: [f32; 4],
        /// Origin of the cells, and the bits of the key of the random words.
        cell_and_key: [i32; 4],
    }
}

gpu_struct! {
    /// One octave in 4-D: its affine map into the cells of its lattice, and its key.
    pub struct FbmLayer4d as "FbmLayer4d" {
        /// First row of the matrix, rotation times frequency, in cells per unit.
        row_x: [f32; 4],
        /// Second row.
        row_y: [f32; 4],
        /// Third row.
        row_z: [f32; 4],
        /// Fourth row.
        row_w: [f32; 4],
        /// Offset in cells.
        offset: [f32; 4],
        /// Origin of the cells.
        cell: [i32; 4],
        /// Key of the random words.
        key: u32,
        .. padding: [u32; 3]
    }
}

impl FbmSpectrumUniform {
    fn new<F: Field<V>, V: Point, T: numbered::Numbered>(sum: &Fbm<F, V, T>) -> Self {
        let spectrum = sum.spectrum();
        let [mean, deviation] = sum.octave_moments();
        let gain = spectrum.gain();
        let variance = if gain < 1.0 {
            1.0 - gain * gain
        } else {
            (0..spectrum.max_octaves())
                .fold(0.0, |sum, i| sum + spectrum.amplitude(i) * spectrum.amplitude(i))
        };
        Self {
            lacunarity: spectrum.lacunarity(),
            gain,
            max_octaves: spectrum.max_octaves() as f32,
            variance,
            mean,
            deviation,
            normalization: u32::from(sum.normalization() == Normalization::UnitVariance),
            shape: T::NUMBER,
        }
    }
}

impl From<Octave<2>> for FbmLayer2d {
    fn from(Octave { matrix: [[a, b], [c, d]], offset, cell, key, .. }: Octave<2>) -> Self {
        Self { rows: [a, b, c, d], offset, cell, key, padding: [0; 3] }
    }
}

impl From<Octave<3>> for FbmLayer3d {
    fn from(Octave { matrix, offset, cell: [x, y, z], key, .. }: Octave<3>) -> Self {
        let row = |i: usize| [matrix[i][0], matrix[i][1], matrix[i][2], offset[i]];
        Self { row_x: row(0), row_y: row(1), row_z: row(2), cell_and_key: [x, y, z, key.cast_signed()] }
    }
}

impl From<Octave<4>> for FbmLayer4d {
    fn from(Octave { matrix: [row_x, row_y, row_z, row_w], offset, cell, key, .. }: Octave<4>) -> Self {
        Self { row_x, row_y, row_z, row_w, offset, cell, key, padding: [0; 3] }
    }
}

macro_rules! sums {
    ($($point:ident $name:ident $wgsl:literal $layer:ident;)*) => {$(
        gpu_struct! {
            /// A sum of octaves, with all octaves of its spectrum.
            ///
            /// The number of octaves and the footprint are arguments of the shader functions. An
            /// anchored sum has the cells of its anchor, and shaders take differences to the
            /// anchor. Pack the sum again when the anchor moves.
            pub struct $name as $wgsl {
                /// Spectrum and divisor.
                spectrum: FbmSpectrumUniform,
                /// Octaves.
                layers: [$layer; 16],
            }
        }

        impl $name {
            /// Returns a whole uniform of sums; the index of a sum is an argument of the shader
            /// functions.
            ///
            /// Sums beyond the eighth are ignored, missing sums are zero.
            #[must_use]
            pub fn array(sums: &[Self]) -> [Self; SUMS] {
                core::array::from_fn(|i| sums.get(i).copied().unwrap_or_default())
            }
        }

        impl<F: Field<$point>, T: numbered::Numbered> Fbm<F, $point, T> {
            /// Returns the sum as the uniform of a shader that sums the same noise.
            ///
            /// Shaders use [`IntegerHash`](crate::IntegerHash) and do not support periods. They
            /// use only the spectrum of a tileable sum, for the weights of its octaves in a
            /// texture.
            #[must_use]
            pub fn gpu(&self) -> $name {
                $name {
                    spectrum: FbmSpectrumUniform::new(self),
                    layers: core::array::from_fn(|i| self.octave(i).into()),
                }
            }
        }
    )*};
}

sums!(
    Vec2 FbmUniform2d "FbmUniform2d" FbmLayer2d;
    Vec3 FbmUniform3d "FbmUniform3d" FbmLayer3d;
    Vec4 FbmUniform4d "FbmUniform4d" FbmLayer4d;
);
