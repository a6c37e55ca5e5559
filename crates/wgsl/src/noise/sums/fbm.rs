//! Parts of sums of octaves in two, three and four dimensions, from templates expanded at compile
//! time.

/// The length of a template with its placeholders replaced.
pub(crate) const fn size(template: &str, words: &[(u8, &str)]) -> usize {
    let (text, mut i, mut size) = (template.as_bytes(), 0, 0);
    while i < text.len() {
        size += word(text, i, words).len();
        i += 1;
    }
    size
}

/// A template with its placeholders replaced by words.
pub(crate) const fn filled<const N: usize>(template: &str, words: &[(u8, &str)]) -> [u8; N] {
    let (text, mut out, mut i, mut n) = (template.as_bytes(), [0; N], 0, 0);
    while i < text.len() {
        let (word, mut k) = (word(text, i, words), 0);
        while k < word.len() {
            out[n] = word[k];
            (n, k) = (n + 1, k + 1);
        }
        i += 1;
    }
    out
}

/// The word for the placeholder at byte `i`, or the byte itself.
const fn word<'a>(text: &'a [u8], i: usize, words: &[(u8, &'a str)]) -> &'a [u8] {
    let mut k = 0;
    while k < words.len() {
        if words[k].0 == text[i] {
            return words[k].1.as_bytes();
        }
        k += 1;
    }
    text.split_at(i).1.split_at(1).0
}

/// A part from a template: `#` is the dimension, `~` describes it, `@` and `%` are the cell and the
/// key of a layer.
macro_rules! octave_part {
    ([$digit:literal, $place:literal, $cell:literal, $key:literal], $file:expr, [$($template:literal),*],
     [$($mark:literal => $word:expr),*], [$($need:path),*]) => {{
        const TEMPLATE: &str = concat!($(include_str!(
            concat!(env!("CARGO_MANIFEST_DIR"), "/src/wgsl/noise/sums/fbm/", $template, ".template")
        )),*);
        const WORDS: &[(u8, &str)] =
            &[(b'#', $digit), (b'~', $place), (b'@', $cell), (b'%', $key) $(, ($mark, $word))*];
        const TEXT: [u8; size(TEMPLATE, WORDS)] = filled(TEMPLATE, WORDS);
        const SOURCE: &str = match core::str::from_utf8(&TEXT) {
            Ok(source) => source,
            Err(_) => panic!("templates are ASCII"),
        };
        Part::new(concat!("noise/sums/fbm_", $digit, "d/", $file), SOURCE, &[$(&$need),*])
    }};
}

/// Defines the parts of sums in a dimension: a running sum, a ridged multifractal, and octaves of
/// each kind of noise.
macro_rules! fbm {
    ($dimension:tt, $uniform:path, [$($kind:ident),*]) => {
        use $crate::noise::sums::fbm::{filled, size};
        use $crate::noise::sums::{OCTAVE, SHAPE, SPECTRUM};
        use $crate::noise::{self, CELL, SAMPLE};
        use $crate::part::Part;

        /// Running sum of octaves of any kind, [`Fbm`](asperity_noise::Fbm).
        pub static TOTAL: Part =
            octave_part!($dimension, "total", ["total"], [], [SAMPLE, SHAPE, SPECTRUM, OCTAVE, $uniform]);

        /// Running ridged multifractal, [`RidgedMultifractal`](asperity_noise::RidgedMultifractal).
        ///
        /// It uses the octaves of a sum in a uniform and ignores the sum's shape and normalization.
        pub static RIDGED_MULTIFRACTAL: Part = octave_part!(
            $dimension, "ridged_multifractal", ["ridged_multifractal"], [],
            [SAMPLE, SHAPE, SPECTRUM, OCTAVE, $uniform]
        );

        $(fbm!(@$kind $dimension $uniform);)*
    };
    (@VALUE $d:tt $u:path) => {
        fbm!(@cells $d $u, VALUE "value", "value", "", "value noise, asperity_noise::ValueNoise");
    };
    (@VALUE_CATMULL_ROM $d:tt $u:path) => {
        fbm!(@cells $d $u, VALUE_CATMULL_ROM "value_catmull_rom", "value_catmull_rom", "",
            "value noise by splines, asperity_noise::ValueCatmullRom");
    };
    (@PERLIN_CLASSIC $d:tt $u:path) => {
        fbm!(@cells $d $u, PERLIN_CLASSIC "perlin_classic", "perlin_classic", "",
            "Perlin noise of 1985, asperity_noise::PerlinClassic");
    };
    (@PERLIN $d:tt $u:path) => {
        fbm!(@cells $d $u, PERLIN "perlin", "perlin", "",
            "Perlin noise of 2002, asperity_noise::Perlin");
    };
    (@VALUE_GRADIENT $d:tt $u:path) => {
        fbm!(@cells $d $u, VALUE_GRADIENT "value_gradient", "value_gradient", " 0.5,",
            "value-gradient noise with equal weights, asperity_noise::ValueGradient");
    };
    (@SPARSE $d:tt $u:path) => {
        fbm!(@cells $d $u, SPARSE "sparse_convolution", "sparse", " 1u,",
            "sparse convolution noise of one impulse per cell, asperity_noise::SparseConvolution");
    };
    (@GAUSSIAN $d:tt $u:path) => {
        fbm!(@of $d $u, GAUSSIAN "gaussian", "cells", "gaussian_channel", "gaussian", "",
            "Gaussian noise, one channel, asperity_noise::GaussianNoise", [CELL, noise::GAUSSIAN]);
    };
    (@SIMPLEX $d:tt $u:path) => {
        fbm!(@of $d $u, SIMPLEX "simplex", "points", "simplex", "simplex", "",
            "simplex noise with the continuous kernel, asperity_noise::Simplex", [noise::SIMPLEX]);
    };
    (@SIMPLEX_WIDE $d:tt $u:path) => {
        fbm!(@of $d $u, SIMPLEX_WIDE "simplex_wide", "points", "simplex_wide", "simplex_wide", "",
            "simplex noise with the customary wider kernel, asperity_noise::Simplex", [noise::SIMPLEX]);
    };
    (@cells $d:tt $u:path, $name:ident $file:literal, $function:literal, $more:literal, $what:literal) => {
        fbm!(@of $d $u, $name $file, "cells", $function, $function, $more, $what, [CELL, noise::$name]);
    };
    (@of $d:tt $u:path, $name:ident $file:literal, $template:literal, $function:literal, $kind:literal,
     $more:literal, $what:literal, [$($need:path),*]) => {
        #[doc = concat!("Sums and ridged multifractals of octaves of ", $what, ": `", $function, "_octaves_*`.")]
        pub static $name: Part = octave_part!(
            $d, $file, [$template, "sums"], [b'$' => $function, b'!' => $kind, b'?' => $more, b'&' => $what],
            [SAMPLE, $($need,)* SPECTRUM, OCTAVE, $u, TOTAL, RIDGED_MULTIFRACTAL]
        );
    };
}

pub(crate) use {fbm, octave_part};
