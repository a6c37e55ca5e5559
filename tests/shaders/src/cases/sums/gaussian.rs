//! Sums of Gaussian octaves, two channels.

use asperity_noise::gpu::{FbmUniform2d, FbmUniform3d};
use asperity_noise::{
    Fbm, FbmSpectrum, GaussianFbm, GaussianNoise, Lattice, Normalization, Point, Rotation, Sample,
    glam::{DVec3, Vec2, Vec3},
};
use asperity_wgsl::noise::{FBM_2D, FBM_3D, GAUSSIAN_SLOPES_3D};

use super::{EXACT, exact_spectrum, float, in_space, input, levels, output, plane, put, space};
use crate::case::{Case, OUTPUTS, between, packed};

/// Four sums: plain, anchored, with gain above 1, and parallel octaves within [−1, 1].
macro_rules! case {
    ($n:literal, $vector:ident, $uniform:ident, $part:expr, $body:literal, $anchor:expr, $point:ident) => {{
        let of = |seed, spectrum| GaussianFbm::<$vector>::new(GaussianNoise::new(seed), spectrum);
        let plain = of(7, FbmSpectrum::default());
        let anchored = of(8, FbmSpectrum::default()).anchored($anchor);
        let rising = of(9, FbmSpectrum::new(2.4, 1.1, 3).expect("a spectrum"));
        let parallel = of(10, exact_spectrum())
            .with_rotation(Rotation::Aligned)
            .with_normalization(Normalization::UnitRange);
        let uniforms = [plain.gpu(), anchored.gpu(), rising.gpu(), parallel.gpu()];
        Case {
            name: concat!("noise/sums/gaussian_fbm, ", $n, "-D").into(),
            parts: vec![&$part],
            body: $body.into(),
            resources: vec![
                ("gaussian_level", levels()),
                (concat!("fbm_uniform_", $n, "d"), packed(&$uniform::array(&uniforms))),
            ],
            input: Box::new(|i| input(i, 20.0, 4.0)),
            reference: Box::new(move |words| {
                let (p, octaves, mut outputs) = ($point(&words), float(&words, 3), [0; OUTPUTS]);
                let ([first, second], resolved) = match words[8] {
                    0 => resolved(&plain, p, octaves),
                    1 => resolved(&anchored, p, octaves),
                    EXACT => resolved(&parallel, p, octaves),
                    _ => resolved(&rising, p, octaves),
                };
                put(&mut outputs, [first.value, second.value]);
                let gradients = first.gradient.to_array().into_iter().zip(second.gradient.to_array());
                put(&mut outputs[2..], gradients.flat_map(|(first, second)| [first, second]));
                put(&mut outputs[2 + 2 * $n..], resolved);
                outputs
            }),
            outputs: vec![
                output("value", 0..2, 2e-4),
                output("gradient", 2..2 + 2 * $n, 2e-3),
                output("resolved variance and fade", 2 + 2 * $n..4 + 2 * $n, 4e-7),
            ],
        }
    }};
}

pub(super) fn cases() -> Vec<Case> {
    let anchor = DVec3::new(1e6, -4.5e5, 7e5);
    let in_space = case!(
        3,
        Vec3,
        FbmUniform3d,
        FBM_3D.gaussian,
        "\
    let sum = gaussian_fbm_3d(a.xyz, a.w, c.x);
    let pair = sum.pair;
    outcome.a = bits(vec4<f32>(pair.value, pair.dx));
    outcome.b = bits(vec4<f32>(pair.dy, pair.dz));
    outcome.c = bits(vec4<f32>(sum.resolved_variance, sum.fade, 0.0, 0.0));",
        anchor,
        space
    );
    let in_plane = case!(
        2,
        Vec2,
        FbmUniform2d,
        FBM_2D.gaussian,
        "\
    let sum = gaussian_fbm_2d(a.xy, a.w, c.x);
    let pair = sum.pair;
    outcome.a = bits(vec4<f32>(pair.value, pair.dx));
    outcome.b = bits(vec4<f32>(pair.dy, sum.resolved_variance, sum.fade));",
        anchor.truncate(),
        plane
    );
    vec![in_space, in_plane, slopes(anchor)]
}

/// Whitened gradients in a tangent plane, and the height.
fn slopes(anchor: DVec3) -> Case {
    let of = |seed, spectrum| GaussianFbm::<Vec3>::new(GaussianNoise::new(seed), spectrum);
    let plain = of(7, FbmSpectrum::default());
    let anchored = of(8, FbmSpectrum::default()).anchored(anchor);
    let rising = of(9, FbmSpectrum::new(2.4, 1.1, 3).expect("a spectrum"));
    let parallel = of(10, exact_spectrum()).with_rotation(Rotation::Aligned);
    let uniforms = [plain.gpu(), anchored.gpu(), rising.gpu(), parallel.gpu()];
    Case {
        name: "noise/sums/gaussian_slopes".into(),
        parts: vec![&GAUSSIAN_SLOPES_3D],
        body: "\
    let along = bitcast<vec3<f32>>(d.xyz);
    let seen = gaussian_slopes_3d(a.xyz, along, 2.0 * along.zxy, a.w, c.x);
    let height = gaussian_height_3d(a.xyz, a.w, c.x);
    outcome.a = bits(vec4<f32>(seen.z, seen.resolved_variance, seen.fade));
    outcome.b = bits(vec4<f32>(height.value, height.gradient));"
            .into(),
        resources: vec![
            ("gaussian_level", levels()),
            ("fbm_uniform_3d", packed(&FbmUniform3d::array(&uniforms))),
        ],
        input: Box::new(|i| {
            let mut words = input(i, 20.0, 4.0);
            let along = Vec3::new(between(i, 7, 0.2, 1.0), between(i, 8, -1.0, -0.2), 0.0);
            put(&mut words[12..15], along.to_array());
            words
        }),
        reference: Box::new(move |words| {
            let (p, octaves, mut outputs) = (space(&words), float(&words, 3), [0; OUTPUTS]);
            let along = Vec3::from(std::array::from_fn(|k| float(&words, 12 + k)));
            let tangents = [along, 2.0 * Vec3::new(along.z, along.x, along.y)];
            let (z, spectrum, height) = match words[8] {
                0 => relief(&plain, p, tangents, octaves),
                1 => relief(&anchored, p, tangents, octaves),
                EXACT => relief(&parallel, p, tangents, octaves),
                _ => relief(&rising, p, tangents, octaves),
            };
            put(&mut outputs, z);
            put(&mut outputs[2..], [spectrum.resolved_variance(octaves), spectrum.weight(octaves, 0)]);
            put(&mut outputs[4..], in_space(height));
            outputs
        }),
        outputs: vec![
            output("slopes", 0..2, 2e-3),
            output("resolved variance and fade", 2..4, 4e-7),
            output("height", 4..5, 2e-4),
            output("gradient of the height", 5..8, 2e-3),
        ],
    }
}

fn relief<L: Lattice>(
    sum: &Fbm<GaussianNoise<L>, Vec3>,
    p: Vec3,
    tangents: [Vec3; 2],
    octaves: f32,
) -> ([f32; 2], FbmSpectrum, Sample<Vec3>) {
    let z = sum.whitened_gradient_with_octaves(p, tangents, octaves);
    (z, *sum.spectrum(), sum.height_with_octaves(p, octaves))
}

/// The pair, the fraction of the spectrum's variance and the weight of the first octave, as used by
/// bump maps.
fn resolved<L: Lattice, V: Point<Coordinates = [f32; N]>, const N: usize>(
    sum: &Fbm<GaussianNoise<L>, V>,
    p: V,
    octaves: f32,
) -> ([Sample<V>; 2], [f32; 2]) {
    let spectrum = sum.spectrum();
    (sum.pair_with_octaves(p, octaves), [spectrum.resolved_variance(octaves), spectrum.weight(octaves, 0)])
}
