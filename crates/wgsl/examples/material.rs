//! Prints a WGSL module that shades a carpet, and the bytes of its uniforms:
//! `cargo run -p asperity-wgsl --example material`.
//!
//! `tests/gpu/examples` binds such bytes with wgpu.
#![expect(clippy::print_stdout, reason = "an example prints its result")]

use asperity_noise::gpu::FbmUniform3d;
use asperity_shading::{Carpet, CarpetParameters};
use asperity_wgsl::{Bindings, Part, compose, ordered, shading};

/// The shader, with the part whose functions it calls.
static PIXEL: Part = Part::new(
    "pixel",
    "// The radiance of a carpet in the plane z = 0 under one light, for a pixel of this width.
fn pixel(at: vec2<f32>, width: f32, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    let x = vec3<f32>(1.0, 0.0, 0.0);
    let y = vec3<f32>(0.0, 1.0, 0.0);
    let normal = vec3<f32>(0.0, 0.0, 1.0);
    let point = SurfacePoint(vec3<f32>(at, 0.0), normal, at, x, y, pixel_ellipse_round(width));
    return carpet(point, wo, wi);
}
",
    &[&shading::material::CARPET],
);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let carpet = Carpet::new(CarpetParameters { roughness: 0.7, ..Default::default() })?;
    // Structs with the layout of the module's uniforms. The carpet's sums of octaves start at
    // index 0 of the uniform of sums, which all materials of a module share.
    let uniform = carpet.gpu(0);
    let sums = FbmUniform3d::array(&carpet.gpu_sums());

    println!("{}", compose(&[&PIXEL], Bindings::Textures { group: 0 }));
    for (index, binding) in ordered(&[&PIXEL]).iter().flat_map(|part| part.bindings()).enumerate() {
        let bytes = match binding.name() {
            "carpet_uniform" => bytemuck::bytes_of(&uniform),
            "fbm_uniform_3d" => bytemuck::bytes_of(&sums),
            other => return Err(format!("no resource for `{other}`").into()),
        };
        println!("// Binding {index}, `{}`: {} bytes", binding.name(), bytes.len());
    }
    Ok(())
}
