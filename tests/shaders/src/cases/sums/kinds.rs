//! Octaves of every noise, all shapes, and ridged multifractals.

use asperity_noise::gpu::{FbmUniform2d, FbmUniform3d, FbmUniform4d};
use asperity_noise::{
    Anchor, Billow, Fbm, FbmSpectrum, Field, GaussianNoise, Normalization, Perlin, PerlinClassic, Plasma,
    Point, Ridged, RidgedMultifractal, Rotation, Sample, Simplex, SparseConvolution, Turbulence,
    ValueCatmullRom, ValueGradient, ValueNoise,
    glam::{DVec2, DVec3, Vec2, Vec3, Vec4},
};
use asperity_wgsl::{
    Part,
    noise::{self, FBM_2D, FBM_3D, FBM_4D},
};

use super::{EXACT, exact_spectrum, float, in_plane, in_space, input, levels, output, plane, put, space};
use crate::case::{Case, INPUTS, OUTPUTS, between, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![
        of("value", ValueNoise::new(4), [&FBM_3D.value, &FBM_2D.value]),
        of(
            "value_catmull_rom",
            ValueCatmullRom::new(4),
            [&FBM_3D.value_catmull_rom, &FBM_2D.value_catmull_rom],
        ),
        of("perlin_classic", PerlinClassic::new(5), [&FBM_3D.perlin_classic, &FBM_2D.perlin_classic]),
        of("perlin", Perlin::new(3), [&FBM_3D.perlin, &FBM_2D.perlin]),
        of("value_gradient", ValueGradient::new(6), [&FBM_3D.value_gradient, &FBM_2D.value_gradient]),
        of("simplex", Simplex::new(8), [&FBM_3D.simplex, &FBM_2D.simplex]),
        of(
            "simplex_classic",
            Simplex::new(8).with_classic_radius(),
            [&FBM_3D.simplex_classic, &FBM_2D.simplex_classic],
        ),
        of(
            "sparse_convolution",
            SparseConvolution::new(9),
            [&FBM_3D.sparse_convolution, &FBM_2D.sparse_convolution],
        ),
        of("gaussian_channel", GaussianNoise::new(7), [&FBM_3D.gaussian_channel, &FBM_2D.gaussian_channel]),
        in_4d("value", ValueNoise::new(4), &FBM_4D.value),
        in_4d("perlin", Perlin::new(3), &FBM_4D.perlin),
        in_4d("simplex", Simplex::new(8), &FBM_4D.simplex),
        in_4d("simplex_classic", Simplex::new(8).with_classic_radius(), &FBM_4D.simplex_classic),
        own(),
        shapes(),
    ]
}

/// Bound of a multifractal's gradient. It is discontinuous where the weight of an octave is clamped
/// at 1, and rounding decides the side. The largest jump seen with fused products and sums is
/// 0.064.
const CUT_OFF: f32 = 0.13;

/// Sums of one noise, clamped to footprints: two anchored, and one with parallel octaves.
fn of<K>(name: &str, noise: K, parts: [&'static Part; 2]) -> Case
where
    K: Field<Vec3> + Field<Vec2> + Anchor<3> + Anchor<2> + Copy,
    <K as Anchor<3>>::Shifted: Field<Vec3> + Copy + Send + Sync + 'static,
    <K as Anchor<2>>::Shifted: Field<Vec2> + Copy + Send + Sync + 'static,
{
    let in_3d = |spectrum| Fbm::<K, Vec3>::new(noise, spectrum);
    let in_2d = |spectrum| Fbm::<K, Vec2>::new(noise, spectrum);
    let exact_3d = in_3d(exact_spectrum()).with_rotation(Rotation::Aligned).anchored([0.0; 3]);
    let exact_2d = in_2d(exact_spectrum()).with_rotation(Rotation::Aligned).anchored([0.0; 2]);
    let there_3d = in_3d(FbmSpectrum::default()).anchored(DVec3::new(1e6, -4.5e5, 7e5));
    let there_2d = in_2d(FbmSpectrum::default()).anchored(DVec2::new(1e6, -4.5e5));
    let [exact, there] = [&exact_3d, &there_3d].map(Fbm::<_, Vec3>::gpu);
    let space_words = packed(&FbmUniform3d::array(&[there, there, there, exact]));
    let [exact, there] = [&exact_2d, &there_2d].map(Fbm::<_, Vec2>::gpu);
    let plane_words = packed(&FbmUniform2d::array(&[there, there, there, exact]));
    Case {
        name: format!("noise/sums/fbm of {name}, 3-D and 2-D"),
        parts: parts.to_vec(),
        body: format!(
            "\
    let u = {name}_fbm_3d(a.xyz, a.w, b.x, c.x);
    outcome.a = bits(vec4<f32>(u.value, u.gradient));
    let v = {name}_fbm_2d(a.xy, a.w, b.x, c.x);
    outcome.b = bits(vec4<f32>(v.value, v.gradient, 0.0));"
        ),
        resources: if name == "gaussian_channel" {
            vec![
                ("gaussian_level", levels()),
                ("fbm_uniform_3d", space_words),
                ("fbm_uniform_2d", plane_words),
            ]
        } else {
            vec![("fbm_uniform_3d", space_words), ("fbm_uniform_2d", plane_words)]
        },
        input: Box::new(|i| input(i, 20.0, 4.0)),
        reference: Box::new(move |words| {
            let [octaves, footprint] = [3, 4].map(|k| float(&words, k));
            let exact = words[8] == EXACT;
            let mut outputs = [0; OUTPUTS];
            let (in_3d, in_2d) = if exact { (&exact_3d, &exact_2d) } else { (&there_3d, &there_2d) };
            put(
                &mut outputs,
                in_space(in_3d.with_octaves(octaves).band_limited(footprint).sample(space(&words))),
            );
            put(
                &mut outputs[4..],
                in_plane(in_2d.with_octaves(octaves).band_limited(footprint).sample(plane(&words))),
            );
            outputs
        }),
        outputs: vec![
            output("value, 3-D", 0..1, 2e-4),
            output("gradient, 3-D", 1..4, 2e-3),
            output("value, 2-D", 4..5, 2e-4),
            output("gradient, 2-D", 5..7, 2e-3),
        ],
    }
}

/// The custom noise of the module's documentation.
static STEEP: Part = Part::new(
    "case/steep",
    "fn steep(p: vec3<f32>, octaves: f32, sum: u32) -> Sample3d {
    var total = fbm_total_3d(octaves, 0.0, sum);
    while fbm_goes_on(total.walk) {
        let layer = fbm_layer_3d(sum, total.walk.octave);
        let at = cell_place_3d(fbm_point_3d(layer, p));
        let key = bitcast<u32>(layer.cell_and_key.w);
        let octave = value_gradient_in_cell_3d(layer.cell_and_key.xyz + at.cell, at.place, 0.9, key);
        total = fbm_added_3d(total, layer, sample_known_3d(octave, at.known));
    }
    return fbm_divided_3d(total);
}
",
    &[&FBM_3D.custom, &noise::VALUE_GRADIENT],
);

fn own() -> Case {
    let kind = ValueGradient::new(6).with_weight(0.9).expect("a weight");
    let there = Fbm::<_, Vec3>::new(kind, FbmSpectrum::default()).anchored([0.0; 3]);
    let exact =
        Fbm::<_, Vec3>::new(kind, exact_spectrum()).with_rotation(Rotation::Aligned).anchored([0.0; 3]);
    let sums = [&there, &there, &there, &exact].map(Fbm::<_, Vec3>::gpu);
    Case {
        name: "noise/sums/fbm of a custom noise, 3-D".into(),
        parts: vec![&STEEP],
        body: "\
    let sum = steep(a.xyz, a.w, c.x);
    outcome.a = bits(vec4<f32>(sum.value, sum.gradient));"
            .into(),
        resources: vec![("fbm_uniform_3d", packed(&FbmUniform3d::array(&sums)))],
        input: Box::new(|i| input(i, 20.0, 4.0)),
        reference: Box::new(move |words| {
            let (sum, mut outputs) = (if words[8] == EXACT { exact } else { there }, [0; OUTPUTS]);
            put(&mut outputs, in_space(sum.sample_with_octaves(space(&words), float(&words, 3))));
            outputs
        }),
        outputs: vec![output("value", 0..1, 2e-4), output("gradient", 1..4, 2e-3)],
    }
}

/// Sums and multifractals of one noise in four dimensions, the fourth coordinate in word 6.
fn in_4d<K>(name: &str, noise: K, part: &'static Part) -> Case
where
    K: Field<Vec4> + Anchor<4> + Copy,
    K::Shifted: Field<Vec4> + Copy + Send + Sync + 'static,
{
    let there = Fbm::<K, Vec4>::new(noise, FbmSpectrum::default()).anchored([1e6, -4.5e5, 7e5, 2e5]);
    let exact =
        Fbm::<K, Vec4>::new(noise, exact_spectrum()).with_rotation(Rotation::Aligned).anchored([0.0; 4]);
    let words = packed(&FbmUniform4d::array(&[&there, &there, &there, &exact].map(Fbm::<_, Vec4>::gpu)));
    Case {
        name: format!("noise/sums/fbm and ridged_multifractal of {name}, 4-D"),
        parts: vec![part],
        body: format!(
            "\
    let p = vec4<f32>(a.xyz, b.z);
    let s = {name}_fbm_4d(p, a.w, b.x, c.x);
    outcome.a = bits(s.gradient);
    let t = {name}_ridged_multifractal_4d(p, a.w, b.y, c.x);
    outcome.b = bits(t.gradient);
    outcome.c = bits(vec4<f32>(s.value, t.value, 0.0, 0.0));"
        ),
        resources: vec![("fbm_uniform_4d", words)],
        input: Box::new(|i| {
            let mut words = input(i, 10.0, 3.0);
            words[6] = between(i, 7, -10.0, 10.0).to_bits();
            words
        }),
        reference: Box::new(move |words| {
            let [octaves, footprint, feedback, w] = [3, 4, 5, 6].map(|k| float(&words, k));
            let (p, mut outputs) = (space(&words).extend(w), [0; OUTPUTS]);
            let sum = if words[8] == EXACT { exact } else { there };
            let sample = sum.with_octaves(octaves).band_limited(footprint).sample(p);
            let multifractal = RidgedMultifractal::from_fbm(sum, feedback)
                .expect("a feedback")
                .with_octaves(octaves)
                .sample(p);
            put(&mut outputs, sample.gradient.to_array().into_iter().chain(multifractal.gradient.to_array()));
            put(&mut outputs[8..], [sample.value, multifractal.value]);
            outputs
        }),
        outputs: vec![
            output("gradient", 0..4, 2e-3),
            output("gradient of the multifractal", 4..8, CUT_OFF),
            output("values", 8..10, 2e-4),
        ],
    }
}

/// Sums of all nontrivial shapes.
struct Shapes<K, V: Point> {
    turbulence: Fbm<K, V, Turbulence>,
    plasma: Fbm<K, V, Plasma>,
    billow: Fbm<K, V, Billow>,
    ridged: Fbm<K, V, Ridged>,
    multifractals: [Fbm<K, V>; 2],
}

impl<K: Field<V> + Copy, V: Point> Shapes<K, V> {
    fn of(turned: Fbm<K, V>, exact: Fbm<K, V>) -> Self {
        Self {
            turbulence: turned.with_shape(Turbulence),
            plasma: turned.with_shape(Plasma).with_normalization(Normalization::UnitRange),
            billow: turned.with_shape(Billow),
            ridged: exact.with_shape(Ridged),
            multifractals: [turned, exact],
        }
    }

    /// Returns the sum of a number, and the multifractal of its octaves.
    fn samples(&self, words: &[u32; INPUTS], p: V) -> [Sample<V>; 2] {
        let [octaves, footprint, feedback] = [3, 4, 5].map(|k| float(words, k));
        let of = |field: &dyn Field<V>| field.sample(p);
        let sum = match words[8] {
            0 => of(&self.turbulence.with_octaves(octaves).band_limited(footprint)),
            1 => of(&self.plasma.with_octaves(octaves).band_limited(footprint)),
            EXACT => of(&self.ridged.with_octaves(octaves).band_limited(footprint)),
            _ => of(&self.billow.with_octaves(octaves).band_limited(footprint)),
        };
        let octaves_of = self.multifractals[usize::from(words[8] == EXACT)];
        let multifractal = RidgedMultifractal::from_fbm(octaves_of, feedback).expect("a feedback");
        [sum, of(&multifractal.with_octaves(octaves))]
    }
}

fn shapes() -> Case {
    // Anchored, which compiles without SIMD.
    let turned = Fbm::<_, Vec3>::new(Perlin::new(6), FbmSpectrum::default()).anchored([0.0; 3]);
    let exact = Fbm::<_, Vec3>::new(Perlin::new(7), exact_spectrum()).with_rotation(Rotation::Aligned);
    let solid = Shapes::of(turned, exact.anchored([0.0; 3]));
    let turned = Fbm::<_, Vec2>::new(Perlin::new(6), FbmSpectrum::default()).anchored([0.0; 2]);
    let exact = Fbm::<_, Vec2>::new(Perlin::new(7), exact_spectrum()).with_rotation(Rotation::Aligned);
    let flat = Shapes::of(turned, exact.anchored([0.0; 2]));
    let in_3d = packed(&FbmUniform3d::array(&[
        solid.turbulence.gpu(),
        solid.plasma.gpu(),
        solid.billow.gpu(),
        solid.ridged.gpu(),
    ]));
    let in_2d = packed(&FbmUniform2d::array(&[
        flat.turbulence.gpu(),
        flat.plasma.gpu(),
        flat.billow.gpu(),
        flat.ridged.gpu(),
    ]));
    Case {
        name: "noise/sums/shapes and ridged_multifractal, 3-D and 2-D".into(),
        parts: vec![&FBM_3D.perlin, &FBM_2D.perlin],
        body: "\
    let u = perlin_fbm_3d(a.xyz, a.w, b.x, c.x);
    outcome.a = bits(vec4<f32>(u.value, u.gradient));
    let v = perlin_ridged_multifractal_3d(a.xyz, a.w, b.y, c.x);
    outcome.b = bits(vec4<f32>(v.value, v.gradient));
    let s = perlin_fbm_2d(a.xy, a.w, b.x, c.x);
    let t = perlin_ridged_multifractal_2d(a.xy, a.w, b.y, c.x);
    outcome.c = bits(vec4<f32>(s.value, s.gradient, t.value));
    outcome.d = bits(vec4<f32>(t.gradient, 0.0, 0.0));"
            .into(),
        resources: vec![("fbm_uniform_3d", in_3d), ("fbm_uniform_2d", in_2d)],
        input: Box::new(|i| input(i, 20.0, 4.0)),
        reference: Box::new(move |words| {
            let mut outputs = [0; OUTPUTS];
            let in_3d = solid.samples(&words, space(&words)).map(in_space);
            put(&mut outputs, in_3d.into_iter().flatten());
            let in_2d = flat.samples(&words, plane(&words)).map(in_plane);
            put(&mut outputs[8..], in_2d.into_iter().flatten());
            outputs
        }),
        outputs: vec![
            output("value, 3-D", 0..1, 2e-4),
            output("gradient, 3-D", 1..4, 2e-3),
            output("multifractal, 3-D", 4..5, 2e-4),
            output("its gradient, 3-D", 5..8, CUT_OFF),
            output("value, 2-D", 8..9, 2e-4),
            output("gradient, 2-D", 9..11, 2e-3),
            output("multifractal, 2-D", 11..12, 2e-4),
            output("its gradient, 2-D", 12..14, CUT_OFF),
        ],
    }
}
