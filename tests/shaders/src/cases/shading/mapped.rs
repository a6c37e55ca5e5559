//! Bump maps of a density, and hand-made normal maps.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::gpu::{BumpMappedUniform, SlopePyramidUniform};
use asperity_shading::level_of_detail::{LevelOfDetail, ResolvedBumps};
use asperity_shading::material::NormalMapped;
use asperity_shading::ndf_sampling::Ndf;
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::normal_map::{SlopeLobe, SlopeLobes, SlopeMoments, SlopePyramid};
use asperity_shading::{Beckmann, BumpField, BumpMapped, Ggx, PixelEllipse};
use asperity_wgsl::shading::material::{BUMP_MAPPED, NORMAL_MAPPED};
use asperity_wgsl::shading::normal_map::SLOPE_PYRAMID;

use super::material::{material, sums};
use super::{equal, floats, inputs, number, vec2, words};
use crate::case::{Bound, Case, Output, packed};

pub(super) fn cases() -> Vec<Case> {
    let ggx = BumpMapped {
        ndf: Ggx::new_clamped(0.2, 0.4),
        bumps: bumps(),
        rule: LevelOfDetail::Exact,
        color: COPPER,
    };
    let ggx_uniform = ggx.gpu(0);
    let ndf = Beckmann::new_clamped(0.3, 0.2);
    let beckmann = BumpMapped { ndf, bumps: bumps(), rule: LevelOfDetail::Fractal, color: COPPER };
    let beckmann_uniform = beckmann.gpu(0);
    vec![
        moments(),
        pyramid(),
        stone(),
        bump_mapped("exact rule of GGX", ggx_uniform, ggx),
        bump_mapped("fractal rule of Beckmann", beckmann_uniform, beckmann),
    ]
}

const COPPER: Vec3 = Vec3::new(0.9, 0.6, 0.5);

fn bumps() -> BumpField<GaussianFbm<Vec3>> {
    let spectrum = FbmSpectrum::new(2.0, 0.6, 6).expect("a spectrum");
    BumpField::new(GaussianFbm::new(GaussianNoise::new(3), spectrum), 5.0).expect("a frequency")
}

fn bump_mapped(
    name: &str,
    uniform: BumpMappedUniform,
    of: BumpMapped<impl Ndf + Send + Sync + 'static, GaussianFbm<Vec3>>,
) -> Case {
    let resources = vec![
        ("gaussian_level", GaussianNoise::gpu_levels().map(f32::to_bits).collect()),
        ("bump_mapped_uniform", packed(&uniform)),
        sums(&[of.bumps.field().gpu()]),
    ];
    material(
        &format!("bump_mapped, {name}"),
        &BUMP_MAPPED,
        resources,
        [2.0, 3e-3, 0.3],
        // The logarithm that counts octaves comes from the library in the crate.
        [Bound::Absolute(8e-7), Bound::Absolute(1e-2)],
        of,
    )
}

/// Stone bumps, 12 × 20 texels in four groups: flat with ridges and occasional slopes.
fn map() -> SlopePyramid<4, &'static [Vec2], &'static [SlopeLobes<4>]> {
    let slope = |k: usize| {
        let (column, row) = (k % 12, k / 12);
        let ridge = match column % 6 {
            0 => 0.8,
            1 => -0.8,
            _ => 0.0,
        };
        let dent = if row % 5 == 2 { 0.4 } else { 0.02 * (k % 7) as f32 };
        Vec2::new(ridge, dent)
    };
    let map = SlopePyramid::new(12, 20, (0..240).map(slope).collect()).expect("a small map");
    Box::leak(Box::new(map)).view()
}

fn numbers(map: &SlopePyramid<4, &[Vec2], &[SlopeLobes<4>]>) -> (&'static str, Vec<u32>) {
    ("slope_pyramid_number", map.gpu_numbers().map(f32::to_bits).collect())
}

fn stone() -> Case {
    let stone = NormalMapped { map: map(), roughness: Beckmann::new_clamped(0.25, 0.35), color: COPPER };
    let uniform = packed(&stone.gpu());
    material(
        "normal_mapped",
        &NORMAL_MAPPED,
        vec![("normal_mapped_uniform", uniform), numbers(&stone.map)],
        [1.5, 1e-3, 2.0],
        // The root of a covariance is computed in 64 bits in the crate. Exponential and logarithm
        // come from the library.
        [Bound::Absolute(4e-7), Bound::Absolute(1e-4)],
        stone,
    )
}

/// Returns weight, mean and covariance of a lobe, or zeros for a lobe without weight.
fn lobe_words(lobe: SlopeLobe) -> [f32; 6] {
    if lobe.weight > 0.0 {
        let [xx, xy, yy] = lobe.moments.covariance;
        [lobe.weight, lobe.moments.mean.x, lobe.moments.mean.y, xx, xy, yy]
    } else {
        [0.0; 6]
    }
}

fn pyramid() -> Case {
    let map = map();
    let SlopePyramidUniform { width, height, last_level: last, groups } = map.gpu();
    Case {
        name: "shading/normal_map/slope_pyramid".into(),
        parts: vec![&SLOPE_PYRAMID],
        body: format!(
            "\
    let map = SlopePyramid({width}u, {height}u, {last}u, {groups}u);
    let group = d.x % 4u;
    var level = slope_pyramid_level(map, a.xy, d.y, group);
    level.moments.mean *= select(0.0, 1.0, level.weight > 0.0);
    let pixel = pixel_ellipse_aligned(a.zw);
    let seen = slope_pyramid_sample_along(map, a.xy, pixel, 8u, group);
    outcome.a = bits(vec4<f32>(level.weight, level.moments.mean, level.moments.covariance.x));
    outcome.b = bits(vec4<f32>(level.moments.covariance.yz, slope_pyramid_slope(map, a.xy)));
    outcome.c = bits(vec4<f32>(seen.weight, seen.weight * seen.moments.mean, seen.weight * seen.moments.covariance.x));
    outcome.d = bits(vec4<f32>(seen.weight * seen.moments.covariance.yz, 0.0, 0.0));"
        ),
        resources: vec![numbers(&map)],
        input: Box::new(|i| {
            let uv = [0, 1].map(|k| number(i, k, [-2.0, 2.0]));
            let widths = [2, 3].map(|k| match i % 4 {
                0 => 0.0,
                _ => number(i, k, [-6.0, 1.0]).exp(),
            });
            let mut words = inputs(i, &[uv[0], uv[1], widths[0], widths[1]]);
            words[12..14].copy_from_slice(&[i, i / 4 % 7]);
            words
        }),
        reference: Box::new(move |inputs| {
            let (uv, sides, group) = (vec2(inputs, 0), vec2(inputs, 2), inputs[12] as usize % 4);
            let level = lobe_words(map.level(uv, inputs[13]).lobes()[group]);
            let slope = map.slope(uv);
            let seen = map.sample_along(uv, &PixelEllipse::aligned(sides), 8).lobes()[group];
            let [weight, x, y, xx, xy, yy] = lobe_words(seen);
            let seen = [weight, weight * x, weight * y, weight * xx, weight * xy, weight * yy];
            words(&[&level[..], &slope.to_array(), &seen].concat())
        }),
        outputs: vec![
            equal("a level", 0..6, Bound::Absolute(1e-5)),
            equal("slope", 6..8, Bound::Absolute(1e-5)),
            // The logarithm that selects the level comes from the library in the crate.
            Output::new("a long pixel", 8..14, Bound::Absolute(2e-7), Bound::Absolute(1e-4)),
        ],
    }
}

fn moments() -> Case {
    Case {
        name: "shading/normal_map/slope_moments".into(),
        parts: vec![&SLOPE_PYRAMID],
        body: "\
    let moments = SlopeMoments(a.xy, vec3<f32>(a.zw, b.x));
    let split = gaussian_split(bitcast<vec2<f32>>(c.xy), bitcast<f32>(c.z));
    let seen = slope_moments_detailed(moments, b.yz, split);
    let h = vec3<f32>(b.w, bitcast<vec2<f32>>(d.xy));
    outcome.a = bits(vec4<f32>(seen.mean, 0.0, 0.0));
    outcome.b = bits(vec4<f32>(offset_beckmann_covariance(seen), max(offset_beckmann_d(seen, h), 1e-30)));
    outcome.c = bits(vec4<f32>(slope_moments_normal(moments), 0.0));
    outcome.d = bits(vec4<f32>(slope_moments_mean_normal(moments), 0.0));"
            .into(),
        resources: vec![numbers(&map())],
        input: Box::new(|i| {
            let n = |k, range| number(i, k, range);
            let deviations = [2, 3].map(|k| n(k, [-5.0, 1.0]).exp());
            let correlation = n(4, [-0.99, 0.99]);
            let [xx, yy] = deviations.map(|d| d * d);
            let xy = correlation * deviations[0] * deviations[1];
            let mean = [n(0, [-1.0, 1.0]), n(1, [-1.0, 1.0])];
            let alpha = [5, 6].map(|k| n(k, [-3.0, 0.0]).exp());
            let slope = [
                mean[0] + 1.5 * (deviations[0] + alpha[0]) * n(7, [-1.0, 1.0]),
                mean[1] + 1.5 * (deviations[1] + alpha[1]) * n(8, [-1.0, 1.0]),
            ];
            let h = Vec3::new(slope[0], slope[1], 1.0).normalize();
            let z = [9, 10].map(|k| n(k, [-2.0, 2.0]));
            let share = super::share(i, 11);
            let mut words = inputs(
                i,
                &[mean[0], mean[1], xx, xy, yy, alpha[0], alpha[1], h.x, z[0], z[1], share, 0.0, h.y, h.z],
            );
            // Roughnesses are valid.
            words[5..7].copy_from_slice(&alpha.map(f32::to_bits));
            // A half vector is normalized, or zero.
            for (word, good) in [7, 12, 13].into_iter().zip(h.to_array()) {
                if f32::from_bits(words[word]).is_finite() {
                    words[word] = good.to_bits();
                }
            }
            words
        }),
        reference: Box::new(|inputs| {
            let [x, y, xx, xy, yy, alpha_x, alpha_y, h] = floats(inputs, 0);
            let ([z1, z2, share], [h2, h3]) = (floats(inputs, 8), floats(inputs, 12));
            let moments = SlopeMoments { mean: Vec2::new(x, y), covariance: [xx, xy, yy] };
            let noise = ResolvedBumps { z: Vec2::new(z1, z2), variance: share, blend: 1.0 };
            let seen = moments.add_detail(Beckmann::new_clamped(alpha_x, alpha_y), noise);
            let density = seen.d(Vec3::new(h, h2, h3)).max(1e-30);
            let ([cxx, cxy, cyy], mean) = (seen.covariance(), seen.mean());
            let (n, m) = (moments.normal(), moments.mean_normal());
            words(&[mean.x, mean.y, 0.0, 0.0, cxx, cxy, cyy, density, n.x, n.y, n.z, 0.0, m.x, m.y, m.z, 0.0])
        }),
        outputs: vec![
            equal("mean", 0..2, Bound::Absolute(1e-5)),
            // The root of the covariance is computed in 64 bits in the crate.
            Output::new("covariance", 4..7, Bound::Relative(6e-7), Bound::Relative(1e-4)),
            Output::new("density", 7..8, Bound::Relative(2e-5), Bound::Relative(1e-3)),
            equal("normal", 8..11, Bound::Absolute(1e-6)),
            equal("mean normal", 12..15, Bound::Absolute(1e-6)),
        ],
    }
}
