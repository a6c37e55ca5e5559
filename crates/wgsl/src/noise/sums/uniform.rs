//! Packed sums of octaves.

use asperity_noise::{
    Billow, Fbm, FbmSpectrum, Field, Normalization, Octave, Plasma, Point, Ridged, Shape, Signed, Turbulence,
};

/// A shape that shaders support. Sealed; implemented by the shapes of `asperity-noise`.
pub trait ShaderShape: Shape + numbered::Numbered {}

impl<T: Shape + numbered::Numbered> ShaderShape for T {}

mod numbered {
    pub trait Numbered {
        /// The number of the shape in `octaves_shape_value`.
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

/// The number of sums of octaves in a uniform. Sums that a module does not use may have any
/// content.
pub const SUMS: usize = 8;

const OCTAVES: usize = FbmSpectrum::MAX_OCTAVES as usize;
/// Words of a spectrum.
const SPECTRUM: usize = 8;

/// A sum of octaves as the words of `OctavesUniform3d`, or its 2-D and 4-D counterparts, one
/// element of an array in a uniform.
///
/// All octaves of the spectrum are included. The number of octaves to evaluate and the footprint
/// are arguments of the shader functions. An anchored sum contains the cells of its anchor, and the
/// shader takes differences to the anchor. Pack the sum again when the anchor moves.
///
/// Words 0 to 7 are the spectrum: lacunarity, gain, maximum number of octaves, variance fraction,
/// mean and standard deviation of an octave, normalization and shape. Each of the 16 octaves
/// follows, with matrices in cells per unit and offsets in cells:
///
/// | dimension | words |
/// |---|---|
/// | 2 | two rows, offset, anchor's cell, key, 3 of padding |
/// | 3 | three rows, each with its offset; anchor's cell, key |
/// | 4 | four rows, offset, anchor's cell, key, 3 of padding |
///
/// ```
/// use asperity_noise::{FbmSpectrum, GaussianFbm, GaussianNoise, glam::Vec3};
/// use asperity_wgsl::noise::sums::OctavesUniform;
///
/// let sum = GaussianFbm::<Vec3>::new(GaussianNoise::new(7), FbmSpectrum::default());
/// let words = OctavesUniform::new(&sum).words();
/// assert_eq!(words.len(), 264);
/// assert_eq!([words[0], words[1], words[2]].map(f32::from_bits), [2.17, 0.5, 10.0]);
/// assert_eq!(words[8], sum.octave(0).matrix[0][0].to_bits());
///
/// // A second sum of the uniform, with index 1 in the shader.
/// let uniform = OctavesUniform::<3>::uniform(&[OctavesUniform::new(&sum.with_seed(1)), OctavesUniform::new(&sum)]);
/// assert_eq!(uniform[264..528], words);
///
/// // An anchor changes only offsets and cells.
/// let far = OctavesUniform::new(&sum.anchored([1e6, -3.0, 0.25])).words();
/// let differing = (8..264).filter(|i| far[*i] != words[*i]);
/// assert!(differing.into_iter().all(|i| [3, 7, 11, 12, 13, 14].contains(&((i - 8) % 16))));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OctavesUniform<const N: usize> {
    spectrum: [u32; SPECTRUM],
    octaves: [Octave<N>; OCTAVES],
}

impl<const N: usize> OctavesUniform<N> {
    /// Packs a sum of octaves for a shader that sums the same kind on the
    /// [`IntegerHash`](asperity_noise::IntegerHash).
    ///
    /// Shaders do not support periods. They use only the spectrum of a tileable sum, for the
    /// weights of its octaves in a texture.
    #[must_use]
    pub fn new<F, V, T>(sum: &Fbm<F, V, T>) -> Self
    where
        F: Field<V>,
        V: Point<Coordinates = [f32; N]>,
        T: ShaderShape,
    {
        let spectrum = sum.spectrum();
        let [mean, deviation] = sum.octave_moments();
        let gain = spectrum.gain();
        let share = if gain < 1.0 {
            1.0 - gain * gain
        } else {
            (0..spectrum.max_octaves())
                .fold(0.0, |sum, i| sum + spectrum.amplitude(i) * spectrum.amplitude(i))
        };
        let floats = [spectrum.lacunarity(), gain, spectrum.max_octaves() as f32, share, mean, deviation];
        let mut words = [0; SPECTRUM];
        for (word, x) in words.iter_mut().zip(floats) {
            *word = x.to_bits();
        }
        words[6] = u32::from(sum.normalization() == Normalization::UnitVariance);
        words[7] = T::NUMBER;
        let mut i = 0;
        let octaves = [(); OCTAVES].map(|()| {
            i += 1;
            sum.octave(i - 1)
        });
        Self { spectrum: words, octaves }
    }

    /// Fills words with the spectrum, followed by the words that `layer` makes of each octave.
    fn fill<const WIDTH: usize>(&self, words: &mut [u32], layer: impl Fn(&Octave<N>) -> [u32; WIDTH]) {
        words[..SPECTRUM].copy_from_slice(&self.spectrum);
        for (words, octave) in words[SPECTRUM..].chunks_exact_mut(WIDTH).zip(&self.octaves) {
            words.copy_from_slice(&layer(octave));
        }
    }
}

/// Words of consecutive sums, filled with 0 to the end.
fn joined<const EACH: usize, const ALL: usize>(sums: impl Iterator<Item = [u32; EACH]>) -> [u32; ALL] {
    let mut words = [0; ALL];
    for (words, sum) in words.chunks_exact_mut(EACH).zip(sums) {
        words.copy_from_slice(&sum);
    }
    words
}

impl OctavesUniform<3> {
    /// Number of words of a sum in 3-D.
    pub const WORDS: usize = SPECTRUM + 16 * OCTAVES;

    /// Packs a whole uniform; sums beyond [`SUMS`] are ignored.
    #[must_use]
    pub fn uniform(sums: &[Self]) -> [u32; SUMS * Self::WORDS] {
        joined(sums.iter().map(Self::words))
    }

    /// Returns the words, in the layout of `OctavesUniform3d`.
    #[must_use]
    pub fn words(&self) -> [u32; Self::WORDS] {
        let mut words = [0; Self::WORDS];
        self.fill(&mut words, |octave| {
            let mut words = [octave.key; 16];
            for (row, words) in words.chunks_exact_mut(4).take(3).enumerate() {
                let [x, y, z] = octave.matrix[row];
                words.copy_from_slice(&[x, y, z, octave.offset[row]].map(f32::to_bits));
            }
            words[12..15].copy_from_slice(&octave.cell.map(i32::cast_unsigned));
            words
        });
        words
    }
}

impl OctavesUniform<2> {
    /// Number of words of a sum in 2-D.
    pub const WORDS: usize = SPECTRUM + 12 * OCTAVES;

    /// Packs a whole uniform; sums beyond [`SUMS`] are ignored.
    #[must_use]
    pub fn uniform(sums: &[Self]) -> [u32; SUMS * Self::WORDS] {
        joined(sums.iter().map(Self::words))
    }

    /// Returns the words, in the layout of `OctavesUniform2d`.
    #[must_use]
    pub fn words(&self) -> [u32; Self::WORDS] {
        let mut words = [0; Self::WORDS];
        self.fill(&mut words, |octave| {
            let ([x, y], [a, b]) = (octave.matrix, octave.offset);
            let [k, l, m, n, o, p] = [x[0], x[1], y[0], y[1], a, b].map(f32::to_bits);
            let [i, j] = octave.cell.map(i32::cast_unsigned);
            [k, l, m, n, o, p, i, j, octave.key, 0, 0, 0]
        });
        words
    }
}

impl OctavesUniform<4> {
    /// Number of words of a sum in 4-D.
    pub const WORDS: usize = SPECTRUM + 28 * OCTAVES;

    /// Packs a whole uniform; sums beyond [`SUMS`] are ignored.
    #[must_use]
    pub fn uniform(sums: &[Self]) -> [u32; SUMS * Self::WORDS] {
        joined(sums.iter().map(Self::words))
    }

    /// Returns the words, in the layout of `OctavesUniform4d`.
    #[must_use]
    pub fn words(&self) -> [u32; Self::WORDS] {
        let mut words = [0; Self::WORDS];
        self.fill(&mut words, |octave| {
            let mut words = [0; 28];
            let rows = octave.matrix.iter().chain([&octave.offset]);
            for (words, row) in words.chunks_exact_mut(4).zip(rows) {
                words.copy_from_slice(&row.map(f32::to_bits));
            }
            words[20..24].copy_from_slice(&octave.cell.map(i32::cast_unsigned));
            words[24] = octave.key;
            words
        });
        words
    }
}
