//! Parts of sums of octaves in two, three and four dimensions, from templates expanded at compile
//! time.

/// The length of a template with its placeholders replaced.
pub(crate) const fn size(template: &str, words: &[(u8, &str)]) -> usize {
    let (text, mut size) = (template.as_bytes(), template.len());
    let mut i = placeholder(text, 0, words);
    while i < text.len() {
        size = size - 1 + word(text[i], words).len();
        i = placeholder(text, i + 1, words);
    }
    size
}

/// A template with its placeholders replaced by words.
pub(crate) const fn filled<const N: usize>(template: &str, words: &[(u8, &str)]) -> [u8; N] {
    let (text, mut out, mut i) = (template.as_bytes(), [0; N], 0);
    let mut rest: &mut [u8] = &mut out;
    while i < text.len() {
        let end = placeholder(text, i, words);
        rest = put(rest, text.split_at(end).0.split_at(i).1);
        if end < text.len() {
            rest = put(rest, word(text[end], words).as_bytes());
        }
        i = end + 1;
    }
    out
}

/// Writes bytes, and returns the space after them.
const fn put<'a>(space: &'a mut [u8], bytes: &[u8]) -> &'a mut [u8] {
    let (place, rest) = space.split_at_mut(bytes.len());
    place.copy_from_slice(bytes);
    rest
}

/// The index of the first placeholder from `i` on.
const fn placeholder(text: &[u8], mut i: usize, words: &[(u8, &str)]) -> usize {
    // Compilers run this loop slowly, so that most bytes are compared once.
    while i < text.len()
        && (matches!(text[i], b'a'..=b'z' | b' ' | b'0'..=b'9' | b'\n')
            || index(text[i], words) == words.len())
    {
        i += 1;
    }
    i
}

/// The word for a placeholder.
const fn word<'a>(mark: u8, words: &[(u8, &'a str)]) -> &'a str {
    words[index(mark, words)].1
}

/// The index of a placeholder; the number of words if the byte is none.
const fn index(mark: u8, words: &[(u8, &str)]) -> usize {
    let mut k = 0;
    while k < words.len() && words[k].0 != mark {
        k += 1;
    }
    k
}

/// A part from a template: `#` is the dimension, `~` describes it, `@` and `%` are the cell and the
/// key of a layer.
macro_rules! octave_part {
    ([$digit:literal, $place:literal, $cell:literal, $key:literal], $file:expr, [$($template:literal),*],
     [$($mark:literal => $word:expr),*], [$($need:expr),*]) => {{
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

/// The parts of a dimension: a running sum for custom kinds, and the sums of each kind of noise, or
/// of all kinds.
macro_rules! fbm {
    (all $sums:ident, $d:tt, $uniform:ident, $gaussian:expr) => {
        fbm!(
            $sums: FbmParts, $d, $uniform,
            [
                value, value_catmull_rom, perlin_classic, perlin, value_gradient, simplex, simplex_classic,
                sparse_convolution, gaussian_channel
            ],
            gaussian = $gaussian
        )
    };
    ($sums:ident: $parts:ident, $d:tt, $uniform:ident, [$($kind:ident),*] $(, $field:ident = $part:expr)*) => {
        $parts {
            $($kind: fbm!(@$kind $sums $d $uniform),)*
            $($field: $part,)*
            custom: octave_part!(
                $d, "custom", ["total", "ridged_multifractal"], [],
                [SAMPLE, SHAPE, SPECTRUM, OCTAVE, $uniform]
            ),
        }
    };
    (@value $s:ident $d:tt $u:ident) => {
        fbm!(@cells $s $d $u, VALUE "value", "", "value noise, asperity_noise::ValueNoise")
    };
    (@value_catmull_rom $s:ident $d:tt $u:ident) => {
        fbm!(@cells $s $d $u, VALUE_CATMULL_ROM "value_catmull_rom", "",
            "value noise by splines, asperity_noise::ValueCatmullRom")
    };
    (@perlin_classic $s:ident $d:tt $u:ident) => {
        fbm!(@cells $s $d $u, PERLIN_CLASSIC "perlin_classic", "",
            "Perlin noise of 1985, asperity_noise::PerlinClassic")
    };
    (@perlin $s:ident $d:tt $u:ident) => {
        fbm!(@cells $s $d $u, PERLIN "perlin", "", "Perlin noise of 2002, asperity_noise::Perlin")
    };
    (@value_gradient $s:ident $d:tt $u:ident) => {
        fbm!(@cells $s $d $u, VALUE_GRADIENT "value_gradient", " 0.5,",
            "value-gradient noise with equal weights, asperity_noise::ValueGradient")
    };
    (@sparse_convolution $s:ident $d:tt $u:ident) => {
        fbm!(@cells $s $d $u, SPARSE_CONVOLUTION "sparse_convolution", " 1u,",
            "sparse convolution noise of one impulse per cell, asperity_noise::SparseConvolution")
    };
    (@gaussian_channel $s:ident $d:tt $u:ident) => {
        fbm!(@of $s $d $u, "cells", "gaussian_channel", "gaussian", "",
            "Gaussian noise, one channel, asperity_noise::GaussianNoise", [CELL, kinds::GAUSSIAN])
    };
    (@simplex $s:ident $d:tt $u:ident) => {
        fbm!(@of $s $d $u, "points", "simplex", "simplex", "",
            "simplex noise with the continuous kernel, asperity_noise::Simplex", [kinds::SIMPLEX])
    };
    (@simplex_classic $s:ident $d:tt $u:ident) => {
        fbm!(@of $s $d $u, "points", "simplex_classic", "simplex_classic", "",
            "simplex noise with the classic radius, asperity_noise::Simplex", [kinds::SIMPLEX])
    };
    (@cells $s:ident $d:tt $u:ident, $kind:ident $function:literal, $more:literal, $what:literal) => {
        fbm!(@of $s $d $u, "cells", $function, $function, $more, $what, [CELL, kinds::$kind])
    };
    (@of $s:ident $d:tt $u:ident, $template:literal, $function:literal, $kind:literal, $more:literal,
     $what:literal, [$($need:path),*]) => {
        octave_part!(
            $d, $function, [$template, "sums"],
            [b'$' => $function, b'!' => $kind, b'?' => $more, b'&' => $what],
            [SAMPLE, $($need,)* SPECTRUM, OCTAVE, $u, $s.custom]
        )
    };
}

pub(crate) use {fbm, octave_part};
