//! Sums of Gaussian octaves, two channels.

use asperity_noise::{
    Gaussian, GaussianOctaves, Lattice, Normalisation, Octaves, Point, Rotation, Sample, Spectrum,
    glam::{DVec2, DVec3},
};
use asperity_shaders::noise::sums::{self, OctavesUniform};

use super::{EXACT, exact_spectrum, float, input, levels, output, plane, put, space};
use crate::case::{Case, OUTPUTS};

pub(super) fn cases() -> Vec<Case> {
    vec![in_space(), in_plane()]
}

/// The pair; share of the spectrum's variance and weight of the first octave, as bump maps take them.
fn resolved<L: Lattice, V: Point<Coordinates = [f32; N]>, const N: usize>(
    sum: &Octaves<Gaussian<L>, N>,
    p: V,
    octaves: f32,
) -> ([Sample<V>; 2], [f32; 2]) {
    let detail = sum.detail(octaves);
    (detail.pair(p), [detail.share(), detail.spectrum().weight(octaves, 0)])
}

/// Four sums: plain; from an anchor; of a gain above 1; and parallel ones, in [−1, 1].
fn in_space() -> Case {
    let plain = GaussianOctaves::<3>::new(Gaussian::new(7), Spectrum::default());
    let anchored = GaussianOctaves::<3>::new(Gaussian::new(8), Spectrum::default())
        .anchored(DVec3::new(1e6, -4.5e5, 7e5));
    let rising = GaussianOctaves::<3>::new(Gaussian::new(9), Spectrum::new(2.4, 1.1, 3).expect("a spectrum"));
    let parallel =
        GaussianOctaves::<3>::new(Gaussian::new(10), exact_spectrum()).with_rotation(Rotation::Aligned);
    let parallel = parallel.with_normalisation(Normalisation::Range);
    let words = OctavesUniform::<3>::uniform(&[
        OctavesUniform::new(&plain),
        OctavesUniform::new(&anchored),
        OctavesUniform::new(&rising),
        OctavesUniform::new(&parallel),
    ])
    .to_vec();
    Case {
        name: "noise/sums/gaussian_octaves, 3-D".into(),
        parts: vec![&sums::GAUSSIAN_OCTAVES_3D],
        body: "\
    let sum = gaussian_octaves_3d(a.xyz, a.w, c.x);
    let pair = sum.pair;
    outcome.a = bits(vec4<f32>(pair.value, pair.dx));
    outcome.b = bits(vec4<f32>(pair.dy, pair.dz));
    outcome.c = bits(vec4<f32>(sum.share, sum.fade, 0.0, 0.0));"
            .into(),
        resources: vec![("gaussian_level", levels()), ("octaves_uniform_3d", words)],
        input: Box::new(|i| input(i, 20.0, 4.0)),
        reference: Box::new(move |words| {
            let (p, octaves, mut outputs) = (space(&words), float(&words, 3), [0; OUTPUTS]);
            let ([first, second], resolved) = match words[8] {
                0 => resolved(&plain, p, octaves),
                1 => resolved(&anchored, p, octaves),
                EXACT => resolved(&parallel, p, octaves),
                _ => resolved(&rising, p, octaves),
            };
            put(&mut outputs, [first.value, second.value]);
            let gradients = first.gradient.to_array().into_iter().zip(second.gradient.to_array());
            put(&mut outputs[2..], gradients.flat_map(|(first, second)| [first, second]));
            put(&mut outputs[8..], resolved);
            outputs
        }),
        outputs: vec![
            output("value", 0..2, 2e-4),
            output("gradient", 2..8, 2e-3),
            output("share and fade", 8..10, 4e-7),
        ],
    }
}

fn in_plane() -> Case {
    let plain = GaussianOctaves::<2>::new(Gaussian::new(7), Spectrum::default());
    let anchored =
        GaussianOctaves::<2>::new(Gaussian::new(8), Spectrum::default()).anchored(DVec2::new(1e6, -4.5e5));
    let rising = GaussianOctaves::<2>::new(Gaussian::new(9), Spectrum::new(2.4, 1.1, 3).expect("a spectrum"));
    let parallel =
        GaussianOctaves::<2>::new(Gaussian::new(10), exact_spectrum()).with_rotation(Rotation::Aligned);
    let parallel = parallel.with_normalisation(Normalisation::Range);
    let words = OctavesUniform::<2>::uniform(&[
        OctavesUniform::new(&plain),
        OctavesUniform::new(&anchored),
        OctavesUniform::new(&rising),
        OctavesUniform::new(&parallel),
    ])
    .to_vec();
    Case {
        name: "noise/sums/gaussian_octaves, 2-D".into(),
        parts: vec![&sums::GAUSSIAN_OCTAVES_2D],
        body: "\
    let sum = gaussian_octaves_2d(a.xy, a.w, c.x);
    let pair = sum.pair;
    outcome.a = bits(vec4<f32>(pair.value, pair.dx));
    outcome.b = bits(vec4<f32>(pair.dy, sum.share, sum.fade));"
            .into(),
        resources: vec![("gaussian_level", levels()), ("octaves_uniform_2d", words)],
        input: Box::new(|i| input(i, 20.0, 4.0)),
        reference: Box::new(move |words| {
            let (p, octaves, mut outputs) = (plane(&words), float(&words, 3), [0; OUTPUTS]);
            let ([first, second], resolved) = match words[8] {
                0 => resolved(&plain, p, octaves),
                1 => resolved(&anchored, p, octaves),
                EXACT => resolved(&parallel, p, octaves),
                _ => resolved(&rising, p, octaves),
            };
            put(&mut outputs, [first.value, second.value]);
            let gradients = first.gradient.to_array().into_iter().zip(second.gradient.to_array());
            put(&mut outputs[2..], gradients.flat_map(|(first, second)| [first, second]));
            put(&mut outputs[6..], resolved);
            outputs
        }),
        outputs: vec![
            output("value", 0..2, 2e-4),
            output("gradient", 2..6, 2e-3),
            output("share and fade", 6..8, 4e-7),
        ],
    }
}
