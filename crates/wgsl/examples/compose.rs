//! Prints a WGSL module and its packed bindings, without a graphics API:
//! `cargo run -p asperity-wgsl --example compose`.
#![expect(clippy::print_stdout, reason = "an example prints its result")]

use asperity_noise::glam::{DVec3, Vec3};
use asperity_noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_wgsl::noise::sums::{self, OctavesUniform};
use asperity_wgsl::noise::{GAUSSIAN_LEVELS_WIDTH, gaussian_levels};
use asperity_wgsl::{Binding, Bindings, Part, compose, ndf, ordered};

/// A custom part, with the parts whose functions it calls.
static BUMPS: Part = Part::new(
    "bumps",
    "// The normal of a rough surface at p, relative to the anchor, with the octaves that a pixel resolves.
fn bumps(p: vec3<f32>, octaves: f32) -> vec3<f32> {
    return ggx_from_gaussian(vec2<f32>(0.2, 0.4), gaussian_octaves_3d(p, octaves, 0u).pair.value);
}
",
    &[&sums::GAUSSIAN_OCTAVES_3D, &ndf::GGX],
);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Anchored: at high zooms `f32` cannot resolve points far from the origin.
    let sum = GaussianFbm::<Vec3>::new(GaussianNoise::new(7), FbmSpectrum::new(2.0, 0.5, 16)?);
    let words =
        OctavesUniform::<3>::uniform(&[OctavesUniform::new(&sum.anchored(DVec3::new(310.0, -27.5, 4.0)))]);
    let levels: Vec<f32> = gaussian_levels().collect();

    let wgsl = compose(&[&BUMPS], Bindings::Textures { group: 0 });
    println!("{wgsl}\n// Bindings, in the order of `ordered`:");
    for (index, binding) in ordered(&[&BUMPS]).iter().flat_map(|part| part.bindings()).enumerate() {
        let size = match binding {
            Binding::Uniform { of, .. } => format!("a uniform of {of}: {} words", words.len()),
            Binding::Table { element, width, .. } => {
                let rows = levels.len() / GAUSSIAN_LEVELS_WIDTH as usize;
                format!("a texture of {}, {width} × {rows} texels", element.wgsl())
            }
            _ => String::new(),
        };
        println!("// {index}: `{}`, {size}", binding.name());
    }
    println!("// Words of the first octave: {:08x?}", &words[8..24]);
    Ok(())
}
