//! Images of bump-mapped surfaces by the shaders and by the crates, side by side.

mod materials;
pub(crate) mod page;
pub(crate) mod raster;
pub(crate) mod reference;
pub(crate) mod render;
pub(crate) mod scene;

use std::{path::Path, time::Duration};

use asperity_shader_tests::case::packed;
use asperity_shading::level_of_detail::{GaussianField, ResolvedBumps};
use asperity_shading::ndf_sampling::{Ggx, NormalLut};
use asperity_shading::noise::gpu::{FbmUniform2d, FbmUniform3d};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::{BumpField, Frame, pixel::FrequencyClamp};
use asperity_wgsl::Part;
use asperity_wgsl::noise::MipMapped;
use clap::ValueEnum;
use glam::{Vec2, Vec3};

use crate::{
    device::{self, Gpu},
    picture::{
        render::Renderer,
        scene::{Corner, Scene},
    },
    resources::{Resource, filtered, linear},
};

/// Appearance of the surface.
pub(crate) struct Look {
    pub(crate) alpha: Vec2,
    /// Cells of the first octave per unit.
    pub(crate) frequency: f32,
    /// Maximum fraction of the bumps' variance that is resolved, because the light has a size.
    pub(crate) share: f32,
    pub(crate) exposure: f32,
}

const LOOK: Look = Look { alpha: Vec2::new(0.2, 0.4), frequency: 3.0, share: 0.97, exposure: 1.4 };

/// Parts of the bump methods.
pub(crate) const BUMPS: [(&Part, &str); 2] = [
    (&render::PROCEDURAL, "noise in space, anchored"),
    (&render::TEXTURED, "a mip-mapped texture and table L"),
];

const ZOOMS: [f64; 4] = [1.0, 10.0, 100.0, 10_000.0];

/// Available images.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Subject {
    /// A teapot at four zooms
    Teapot,
    /// A plane up to the horizon at four zooms
    Plane,
    /// Both with bumps from a texture
    Textured,
    /// Floors of every material
    Materials,
}

/// Renders the teapot and the plane at four zooms on each adapter and by the crates, and the
/// materials. Fails if they differ. Two further images with bumps from a texture may differ.
pub(crate) fn run(
    adapter: Option<&str>,
    fastest: bool,
    only: Option<Subject>,
    size: u32,
    out: &Path,
) -> Result<(), String> {
    std::fs::create_dir_all(out).map_err(|error| format!("{}: {error}", out.display()))?;
    let wanted = |subject| only.is_none_or(|only| only == subject);
    let mut worst = 0.0_f64;
    let mut gpus = device::open(adapter)?;
    if fastest {
        gpus.sort_by_key(|gpu| gpu.rank);
        gpus.truncate(1);
    }
    for gpu in gpus {
        println!("\n{}\n", gpu.name);
        if only != Some(Subject::Materials) {
            println!(
                "| picture | pixels that differ by more than 2 of 255 | mean difference | ms |\n|---|---|---|---|"
            );
        }
        let scenes = [Subject::Teapot, Subject::Plane].map(wanted);
        for share in procedural(&gpu, &LOOK, scenes, size, out)? {
            worst = worst.max(share);
        }
        if wanted(Subject::Textured) {
            textured(&gpu, &LOOK, size, out)?;
        }
        if wanted(Subject::Materials) {
            materials::run(&gpu, size / 2, out)?;
        }
    }
    println!("\nimages written to {} (shader left or above, crates right or below)", out.display());
    if worst <= 1e-3 { Ok(()) } else { Err(format!("{:.2} % of an image's pixels differ", 100.0 * worst)) }
}

/// Returns a table of milliseconds per frame: scenes and methods in rows, adapters in columns.
/// Without an adapter, returns a line.
pub(crate) fn times(adapter: Option<&str>, size: u32) -> Result<String, String> {
    let gpus = match device::open(adapter) {
        Ok(gpus) => gpus,
        Err(error) if adapter.is_some() => return Err(error),
        Err(error) => return Ok(format!("{error}\n")),
    };
    let mut rows: Vec<(String, Vec<f64>)> = Vec::new();
    for gpu in &gpus {
        let octaves = sum()?;
        let noise = Renderer::new(gpu, &render::PROCEDURAL, size)?;
        let texture = Textured::new(gpu, &LOOK, size)?;
        let mut row = 0;
        let mut add = |name: String, draw: &dyn Fn() -> Result<Duration, String>| {
            let mut times = (0..5).map(|_| draw()).collect::<Result<Vec<_>, _>>()?;
            times.sort_unstable();
            if rows.len() == row {
                rows.push((name, vec![]));
            }
            rows[row].1.push(times[2].as_secs_f64() * 1e3);
            row += 1;
            Ok::<(), String>(())
        };
        for zoom in ZOOMS {
            for (name, scene) in scenes(zoom, size)? {
                let (_, words) = at_focus(&octaves, &scene, &LOOK);
                add(format!("{name}, ×{zoom} | noise"), &|| {
                    Ok(noise.draw(gpu, &scene, &LOOK, octaves.spectrum(), &words, &[])?.1)
                })?;
                if zoom <= 10.0 {
                    add(format!("{name}, ×{zoom} | texture"), &|| Ok(texture.draw(gpu, &scene, &LOOK)?.1))?;
                }
            }
        }
    }
    let names: Vec<&str> = gpus.iter().map(|gpu| gpu.name.as_str()).collect();
    let mut table =
        format!("| scene | bumps | {} |\n|---|---|{}\n", names.join(" | "), "---|".repeat(names.len()));
    for (name, times) in rows {
        let times: Vec<String> = times.iter().map(|time| format!("{time:.1}")).collect();
        table += &format!("| {name} | {} |\n", times.join(" | "));
    }
    Ok(table)
}

/// Returns the scenes of a zoom.
fn scenes(zoom: f64, size: u32) -> Result<[(&'static str, Scene); 2], String> {
    Ok([("teapot", scene::teapot_scene(zoom, size)?), ("plane", scene::plane_scene(zoom, size))])
}

/// Bumps from noise in space, anchored at the focus: returns the fraction of differing pixels per
/// image.
fn procedural(gpu: &Gpu, look: &Look, wanted: [bool; 2], size: u32, out: &Path) -> Result<Vec<f64>, String> {
    let octaves = sum()?;
    let spectrum = *octaves.spectrum();
    let renderer = Renderer::new(gpu, &render::PROCEDURAL, size)?;
    let mut shares = Vec::new();
    // One strip per scene: zooms from left to right, shader above and crates below.
    let mut strips: [(&str, Strip); 2] = Default::default();
    for zoom in ZOOMS {
        for (((name, scene), strip), wanted) in scenes(zoom, size)?.into_iter().zip(&mut strips).zip(wanted) {
            if !wanted {
                continue;
            }
            let (anchored, words) = at_focus(&octaves, &scene, look);
            let (ours, time) = renderer.draw(gpu, &scene, look, &spectrum, &words, &[])?;
            let bumps = BumpField::new(anchored, look.frequency).map_err(|error| error.to_string())?;
            let seen = |corner: &Corner, frame: &Frame, pixel| {
                bumps.coordinates(corner.position.as_vec3(), frame, pixel)
            };
            let theirs = reference::picture(&scene, look, seen, size)?;
            shares.push(report(&format!("{name}-{zoom}"), &ours, &theirs, time, size, out)?);
            strip.0 = name;
            strip.1[0].push(ours);
            strip.1[1].push(theirs);
        }
    }
    for (name, rows) in strips.into_iter().filter(|(_, rows)| !rows[0].is_empty()) {
        write_strip(name, &rows, size, out)?;
    }
    Ok(shares)
}

/// The images of a scene, by the shader and by the crates, in order of zoom.
type Strip = [Vec<Vec<[u8; 3]>>; 2];

/// Writes the images of a scene, shader above and crates below.
fn write_strip(name: &str, strip: &Strip, size: u32, out: &Path) -> Result<(), String> {
    let rows: Vec<Vec<_>> = strip.iter().map(|row| row.iter().map(Vec::as_slice).collect()).collect();
    png(&out.join(format!("gpu-{name}.png")), size, &rows)
}

/// Returns the sum of the bumps.
fn sum() -> Result<GaussianFbm<Vec3>, String> {
    let spectrum = FbmSpectrum::new(2.17, 0.8, 16).map_err(|error| error.to_string())?;
    Ok(GaussianFbm::new(GaussianNoise::new(7), spectrum))
}

/// Returns a sum anchored at a scene's focus, and its words.
fn at_focus(
    octaves: &GaussianFbm<Vec3>,
    scene: &Scene,
    look: &Look,
) -> (impl GaussianField + use<>, (&'static str, Vec<u32>)) {
    let at: [f64; 3] = (scene.focus * f64::from(look.frequency)).into();
    let anchored = octaves.anchored(at);
    let words = packed(&FbmUniform3d::array(&[anchored.gpu()]));
    (anchored, ("fbm_uniform_3d", words))
}

/// Period of the noise texture in cells.
const PERIOD: u16 = 8;

/// A noise texture and a normal texture, and the renderer that reads them.
struct Textured {
    texture: MipMapped,
    renderer: Renderer,
    words: (&'static str, Vec<u32>),
    made: [(&'static str, Resource); 4],
}

impl Textured {
    fn new(gpu: &Gpu, look: &Look, size: u32) -> Result<Self, String> {
        let texture = MipMapped::new(7, PERIOD.into(), 6, 0.8).map_err(|error| error.to_string())?;
        let ggx = Ggx::new(look.alpha.x, look.alpha.y).map_err(|error| error.to_string())?;
        let table = NormalLut::new(&ggx, 256).map_err(|error| error.to_string())?;
        let entries = table.view().entries();
        let sizes: Vec<u32> = (0..texture.levels()).map(|level| texture.size(level)).collect();
        let made = [
            ("mip_mapped_noise", filtered(gpu, &sizes, |level, x, y| texture.texel(level, x, y))),
            ("mip_mapped_sampler", linear(gpu, wgpu::AddressMode::Repeat)),
            ("normal_table_texture", filtered(gpu, &[256], |_, x, y| entries[(y * 256 + x) as usize])),
            ("normal_table_sampler", linear(gpu, wgpu::AddressMode::ClampToEdge)),
        ];
        let sums = packed(&FbmUniform2d::array(&[texture.sum().gpu()]));
        let renderer = Renderer::new(gpu, &render::TEXTURED, size)?;
        Ok(Self { texture, renderer, words: ("fbm_uniform_2d", sums), made })
    }

    fn draw(&self, gpu: &Gpu, scene: &Scene, look: &Look) -> Result<(Vec<[u8; 3]>, Duration), String> {
        let spectrum = self.texture.sum().spectrum();
        self.renderer.draw(gpu, scene, look, spectrum, &self.words, &self.made)
    }
}

/// Bumps from a mip-mapped noise texture and table L, compared with the noise of the texture.
fn textured(gpu: &Gpu, look: &Look, size: u32, out: &Path) -> Result<(), String> {
    let made = Textured::new(gpu, look, size)?;
    let mut strip: Strip = Default::default();
    let sum = made.texture.sum();
    let spectrum = *sum.spectrum();
    let clamp = FrequencyClamp::new(look.frequency, spectrum.lacunarity(), spectrum.max_octaves() as f32)
        .map_err(|error| error.to_string())?;
    for zoom in &ZOOMS[..2] {
        for (name, scene) in scenes(*zoom, size)? {
            let (ours, time) = made.draw(gpu, &scene, look)?;
            let seen = |corner: &Corner, _: &Frame, pixel| {
                let octaves = clamp.octaves(pixel);
                let [x, y] = sum.pair_with_octaves(corner.uv.as_vec2() * f32::from(PERIOD), octaves);
                let (variance, blend) = (spectrum.resolved_variance(octaves), spectrum.weight(octaves, 0));
                ResolvedBumps { z: Vec2::new(x.value, y.value), variance, blend }
            };
            let theirs = reference::picture(&scene, look, seen, size)?;
            report(&format!("textured-{name}-{zoom}"), &ours, &theirs, time, size, out)?;
            strip[0].push(ours);
            strip[1].push(theirs);
        }
    }
    write_strip("textured", &strip, size, out)
}

/// Prints the difference of an image to the crates, writes both, and returns the fraction of pixels
/// that differ by more than 2.
fn report(
    name: &str,
    ours: &[[u8; 3]],
    theirs: &[[u8; 3]],
    time: Duration,
    size: u32,
    out: &Path,
) -> Result<f64, String> {
    let differences: Vec<u8> = ours.iter().zip(theirs).map(|(a, b)| difference(*a, *b)).collect();
    let count = differences.len() as f64;
    let share = differences.iter().filter(|&&d| d > 2).count() as f64 / count;
    let mean = differences.iter().map(|&d| f64::from(d)).sum::<f64>() / count;
    println!("| {name} | {:.3} % | {mean:.2} | {:.0} |", 100.0 * share, time.as_secs_f64() * 1e3);
    png(&out.join(format!("gpu-{name}.png")), size, &[vec![ours, theirs]])?;
    Ok(share)
}

fn difference(a: [u8; 3], b: [u8; 3]) -> u8 {
    a.into_iter().zip(b).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
}

/// Writes images side by side, row below row.
fn png(path: &Path, size: u32, rows: &[Vec<&[[u8; 3]]>]) -> Result<(), String> {
    let stride = size as usize;
    let lines = rows.iter().flat_map(|row| {
        (0..stride).flat_map(move |y| row.iter().flat_map(move |picture| &picture[y * stride..][..stride]))
    });
    let bytes: Vec<u8> = lines.flatten().copied().collect();
    let [columns, rows] = [rows.first().map_or(0, Vec::len), rows.len()].map(|count| count as u32);
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, size * columns, size * rows);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let encoded = encoder.write_header().and_then(|mut writer| writer.write_image_data(&bytes));
    encoded.map_err(|error| format!("{}: {error}", path.display()))?;
    crate::write(path, &file)
}
