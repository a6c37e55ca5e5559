//! A sphere of 40 cells, far and near, from its sum's octaves at a focus and from absolute
//! coordinates.

use asperity_noise::gpu::FbmUniform3d;
use asperity_noise::{
    FbmSpectrum, GaussianFbm, GaussianNoise, Sample,
    glam::{DVec3, Vec3},
};
use asperity_wgsl::noise::FBM_3D;

use super::{float, levels, output, put, space};
use crate::case::{Case, INPUTS, OUTPUTS, between, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![anchored()]
}

/// Cells of the first octave from the sphere's center to its surface.
const RADIUS: f64 = 40.0;

/// The focus on the sphere.
fn focus() -> DVec3 {
    DVec3::new(0.36, -0.48, 0.8) * RADIUS
}

/// Views the sphere with 512 pixels: all of it at zoom 1.
fn seen(i: u32, zoom: f64) -> (DVec3, f32) {
    let [u, v] = [0, 1].map(|k| f64::from(between(i, k, -0.7, 0.7)) * RADIUS / zoom);
    let towards = focus() / RADIUS;
    let (right, up) = towards.any_orthonormal_pair();
    let depth = RADIUS - (RADIUS * RADIUS - u * u - v * v).sqrt();
    // The number of octaves that a pixel resolves.
    let octaves = (zoom * 512.0 / (4.0 * RADIUS)).ln() / f64::from(sum().spectrum().lacunarity()).ln();
    (right * u + up * v - towards * depth, octaves as f32)
}

fn sum() -> GaussianFbm<Vec3> {
    GaussianFbm::new(GaussianNoise::new(12), FbmSpectrum::new(2.17, 0.5, 16).expect("a spectrum"))
}

/// The sphere at zoom 1, 100 and 10⁴, with points relative to the focus.
fn anchored() -> Case {
    let sum = sum().anchored(focus());
    let uniform = sum.gpu();
    let name = "noise/sums/gaussian_fbm from an anchor, zoom 1, 100 and 10⁴";
    view(name, vec![1.0, 100.0, 1e4], DVec3::ZERO, &uniform, move |p, octaves| {
        sum.pair_with_octaves(p, octaves)
    })
}

/// The sphere at one zoom, with points relative to its center. This is the failure that anchors
/// avoid, and is not a passing case.
#[must_use]
pub fn absolute(zoom: f64) -> Case {
    let sum = sum();
    let uniform = sum.gpu();
    let name = "noise/sums/gaussian_fbm by absolute coordinates";
    view(name, vec![zoom], focus(), &uniform, move |p, octaves| sum.pair_with_octaves(p, octaves))
}

fn view(
    name: &str,
    zooms: Vec<f64>,
    origin: DVec3,
    sum: &FbmUniform3d,
    pair: impl Fn(Vec3, f32) -> [Sample<Vec3>; 2] + Send + Sync + 'static,
) -> Case {
    Case {
        name: name.into(),
        parts: vec![&FBM_3D.gaussian],
        body: "\
    let pair = gaussian_fbm_3d(a.xyz, a.w, 0u).pair;
    outcome.a = bits(vec4<f32>(pair.value, pair.dx));
    outcome.b = bits(vec4<f32>(pair.dy, pair.dz));"
            .into(),
        resources: vec![
            ("gaussian_level", levels()),
            ("fbm_uniform_3d", packed(&FbmUniform3d::array(&[*sum]))),
        ],
        input: Box::new(move |i| {
            let (offset, octaves) = seen(i, zooms[i as usize % zooms.len()]);
            let mut words = [0; INPUTS];
            put(&mut words, (origin + offset).as_vec3().to_array().into_iter().chain([octaves]));
            words
        }),
        reference: Box::new(move |words| {
            let ([first, second], mut outputs) = (pair(space(&words), float(&words, 3)), [0; OUTPUTS]);
            put(&mut outputs, [first.value, second.value]);
            let gradients = first.gradient.to_array().into_iter().zip(second.gradient.to_array());
            put(&mut outputs[2..], gradients.flat_map(|(first, second)| [first, second]));
            outputs
        }),
        outputs: vec![output("value", 0..2, 2e-4), output("gradient", 2..8, 2e-3)],
    }
}
