//! The command line of `asperity`.

pub mod filter;

use std::path::PathBuf;

use crate::input::images::Images;
use crate::input::words::{Words, one_of};
use crate::quality::Quality;
use asperity_render::{geometry::mesh_file::Up, materials::field::NoiseKind, scenes::Set};
use asperity_shading::LevelOfDetail;
use clap::{Args, Parser, Subcommand, ValueEnum};

/// Render meshes, bake textures, and export tables of noise, normal distributions and fractal
/// functions.
#[derive(Debug, Parser)]
#[command(name = "asperity", version, disable_help_subcommand = true)]
pub struct Cli {
    /// The command.
    #[command(subcommand)]
    pub command: Command,
    /// Number of threads [default: all cores].
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Export tables: lattices, noise CDFs, NDFs, normal tables, fractal interpolation functions.
    #[command(after_help = "Examples:
  asperity tables
  asperity tables --ndf ggx:0.1,0.5 --ndf painted.png --measure solid-angle
  asperity tables --normal-map bricks.png --tangent-space directx
  asperity tables --fif system.json --out my-tables
  asperity tables --check")]
    Tables(Tables),
    /// Render a scene or mesh to a PNG, JPEG, WebP or OpenEXR file.
    #[command(after_help = "Examples:
  asperity render --scene teapot --ndf ggx:0.1,0.4 --zoom 4
  asperity render --scene car --material paint --quality draft
  asperity render --scene room --material carpet --tone plain --out carpet.exr
  asperity render --scene sphere --material glass --light studio.exr
  asperity render --scene sphere --ndf beckmann:0.3 --rule fractal --zoom 16 --size 1024
  asperity render --mesh helmet.glb --light studio.hdr
  asperity render --mesh bunny.ply --ndf ward:0.1,0.3 --size 768
  asperity render --mesh helmet.glb --light studio.hdr --camera 0,0.5,3 --fov 40 --no-ground
  asperity render --mesh house.obj --up z --material brick --light sky.hdr --noise 0.02
  asperity render --mesh part.stl --material paint --tint b02a1e --set orange_peel_strength=0.03
  asperity render --frames 24 --out frames/####.png
  asperity render --frames 4000 --zoom-to 10000 --out frames/####.exr --job job.yaml
  asperity render --help-material paint

The image is written immediately and refined progressively; Ctrl-C keeps the last version. --ndf, --normal-map, --rule, --octaves,
--frequency, --gain and --bump-noise belong to the material `bumps`. An option without effect is an error.")]
    Render(Render),
    /// Bake noise, an NDF, a fractal surface or a material to textures for engines.
    #[command(after_help = "Examples:
  asperity bake --noise perlin --tileable --size 4096
  asperity bake --noise cellular --cells 16 --octaves 1 --height 0.01 --tint d9a066 --low-tint 3a2f28
  asperity bake --material brick --side 1.04 --set depth=0.01 --format png,ktx2
  asperity bake --ndf ggx:0.1,0.4 --metallic 1 --tint e4c07a --tileable
  asperity bake --fractal periodic --tileable --size 2048 --height 0.03
  asperity bake --noise perlin --tileable --size 16384 --tile 1024 --format png,exr,ktx2 --out rock
  asperity bake --noise perlin --tileable --size 16384 --out /shared/rock --job rock.yaml
  asperity bake --noise perlin --cells 512 --size 4096 --parts 16 --part 1-3 --out land

Writes base color, normals for OpenGL and DirectX, height, roughness, metallic and ambient occlusion, a glTF and a MaterialX material, and
a record of all parameters. Interrupted runs resume. Peak memory is one tile. A constant map has 4 × 4 texels.")]
    Bake(Bake),
    /// Filter the roughness of a glTF model, so that its normal maps do not sparkle.
    #[command(after_help = filter::EXAMPLES)]
    Filter(filter::Filter),
    /// Check normalization, sampling and inverse of an NDF, and print a report.
    #[command(after_help = "Examples:
  asperity check-ndf --ndf ggx:0.1,0.5
  asperity check-ndf --ndf painted.png --measure solid-angle --seed 7")]
    CheckNdf(CheckNdf),
}

/// Options of `check-ndf`.
#[derive(Debug, Args)]
pub struct CheckNdf {
    /// The NDF, as in `tables`; may be repeated.
    #[arg(long, value_name = "NDF", required = true)]
    pub ndf: Vec<String>,
    /// Options for images.
    #[command(flatten)]
    pub images: Images,
    /// Random seed.
    #[arg(long, default_value_t = 0)]
    pub seed: u32,
}

/// Options of `tables`.
#[derive(Debug, Args)]
pub struct Tables {
    /// Tables of one NDF instead of the default set: `ggx:AX[,AY]`, `beckmann:AX[,AY]`,
    /// `ward:AX[,AY]`, `student-t:AX,AY,GAMMA`, `blinn-phong:N`, `ashikhmin-shirley:NU,NV`,
    /// `painted`, or an image file.
    #[arg(long, value_name = "NDF")]
    pub ndf: Vec<String>,
    /// Tables of the NDF estimated from a normal map.
    #[arg(long, value_name = "FILE")]
    pub normal_map: Vec<PathBuf>,
    /// Options for images.
    #[command(flatten)]
    pub images: Images,
    /// Tables of a fractal interpolation function instead of the default set: a JSON file with
    /// `knots`, `alpha`, `q`.
    #[arg(long, value_name = "FILE")]
    pub fif: Vec<PathBuf>,
    /// Write nothing; compare every file in the directory with the output of this command.
    #[arg(long)]
    pub check: bool,
    /// Output directory.
    #[arg(long, value_name = "DIR", default_value = "target/asperity/tables")]
    pub out: PathBuf,
}

/// Options of `render`.
#[derive(Debug, Args)]
pub struct Render {
    /// The scene.
    #[arg(long, value_parser = one_of(SCENES), default_value = "teapot")]
    pub scene: Set,
    /// Render this mesh instead, centered and scaled to fill the image: .obj, .ply, .stl, .glb or
    /// .gltf.
    #[arg(long, value_name = "FILE", conflicts_with = "scene")]
    pub mesh: Option<PathBuf>,
    /// Up axis of the mesh [default: z for .stl, else y].
    #[arg(long, value_parser = one_of(UPS), requires = "mesh")]
    pub up: Option<Up>,
    /// Crease angle in degrees for meshes without normals [default: 40].
    #[arg(long, value_name = "DEGREES", requires = "mesh", value_parser = degrees)]
    pub crease: Option<f32>,
    /// Position of the camera, in coordinates of the mesh file [default: in front, slightly from the
    /// right and above].
    #[arg(long, value_name = "X,Y,Z", requires = "mesh", allow_hyphen_values = true, value_parser = point)]
    pub camera: Option<[f64; 3]>,
    /// Point at the center of the image, in coordinates of the mesh file [default: the center of the
    /// mesh].
    #[arg(long, value_name = "X,Y,Z", requires = "mesh", allow_hyphen_values = true, value_parser = point)]
    pub target: Option<[f64; 3]>,
    /// Field of view of the camera over the height of the image, in degrees [default: 27].
    #[arg(long, value_name = "DEGREES", requires = "mesh", allow_negative_numbers = true, value_parser = field_of_view)]
    pub fov: Option<f32>,
    /// Omit the ground below the mesh.
    #[arg(long, requires = "mesh")]
    pub no_ground: bool,
    /// Material of the subject [default: that of a .glb or .gltf file, else depends on the scene].
    #[arg(long, value_enum)]
    pub material: Option<Material>,
    /// Color of the material, sRGB in hexadecimal.
    #[arg(long, value_name = "RRGGBB", value_parser = color)]
    pub tint: Option<u32>,
    /// Roughness of the material, between 0 and 1; for bumps, GGX.
    #[arg(long, value_parser = share, conflicts_with_all = ["ndf", "normal_map"])]
    pub roughness: Option<f32>,
    /// Scale of the material's pattern [default: 1].
    #[arg(long, value_parser = positive)]
    pub scale: Option<f32>,
    /// Set a parameter of the material; may be repeated. `--help-material` lists them.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
    /// List the parameters of a material and exit.
    #[arg(long, value_enum, value_name = "MATERIAL", exclusive = true)]
    pub help_material: Option<Material>,
    /// Light: `lamps` (directional, without shadows; for bumps only), `studio`, `day`, or a
    /// latitude–longitude image: Radiance HDR, OpenEXR, PNG, JPEG, WebP [default: `lamps` for
    /// bumps, else `studio`].
    #[arg(long, value_name = "LIGHT")]
    pub light: Option<String>,
    /// Background: `light`, or a color [default: the light if --light is given, else dark gray].
    #[arg(long, value_name = "light|RRGGBB", value_parser = behind)]
    pub background: Option<Background>,
    /// Tone curve [default: filmic]; OpenEXR files store radiance.
    #[arg(long, value_enum)]
    pub tone: Option<Tone>,
    /// The NDF of bumps: `ggx:AX[,AY]`, `beckmann:AX[,AY]`, `ward:AX[,AY]`,
    /// `student-t:AX,AY,GAMMA`, `blinn-phong:N`, `ashikhmin-shirley:NU,NV`, `painted`, or an image
    /// file [default: ggx:0.2,0.4].
    #[arg(long)]
    pub ndf: Option<String>,
    /// Use the NDF estimated from this normal map.
    #[arg(long, value_name = "FILE", conflicts_with = "ndf")]
    pub normal_map: Option<PathBuf>,
    /// Options for images.
    #[command(flatten)]
    pub images: Images,
    /// The level-of-detail rule of bumps [default: exact].
    #[arg(long, value_parser = one_of(RULES))]
    pub rule: Option<LevelOfDetail>,
    /// Magnification: 1 shows the whole object.
    #[arg(long, default_value_t = 1.0, value_parser = positive)]
    pub zoom: f32,
    /// Maximum number of octaves of bumps, up to 16 [default: 16].
    #[arg(long, value_parser = whole(0, 16))]
    pub octaves: Option<u32>,
    /// Lattice cells of the first octave per unit of length [default: depends on the scene].
    #[arg(long, value_parser = positive)]
    pub frequency: Option<f32>,
    /// Ratio of the amplitudes of consecutive octaves of bumps, in (0, 1] [default: 0.8].
    #[arg(long, value_parser = share)]
    pub gain: Option<f32>,
    /// Noise of the bumps [default: gaussian].
    #[arg(long, value_parser = one_of(NOISES))]
    pub bump_noise: Option<NoiseKind>,
    /// Exposure [default: 1.45; for an image, chosen from its brightness].
    #[arg(long, value_parser = positive)]
    pub exposure: Option<f32>,
    /// Quality preset; --size, --spp and --noise override it.
    #[arg(long, value_enum, default_value_t)]
    pub quality: Quality,
    /// Width and height in pixels, 16 to 8192 [default: 512; draft 256, book 2048].
    #[arg(long, value_parser = whole(16, 8192))]
    pub size: Option<u32>,
    /// Maximum samples per pixel, up to 65536; without --noise, the exact number [default: 1024;
    /// draft 128, book 8192].
    #[arg(long, value_parser = whole(1, 65_536))]
    pub spp: Option<u32>,
    /// Stop at this standard deviation, where white is 1 [default: 0.008; draft 0.03, book 0.004].
    #[arg(long, value_parser = share)]
    pub noise: Option<f32>,
    /// Random seed.
    #[arg(long, default_value_t = 1)]
    pub seed: u32,
    /// Output file; its extension selects the format: .png, .jpg, .webp or .exr. With --frames, `#`
    /// characters in the name are replaced by the frame number.
    #[arg(long, value_name = "FILE", default_value = "target/asperity/render.png")]
    pub out: PathBuf,
    /// Number of frames: an orbit around the subject, or a zoom with --zoom-to.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub frames: Option<u32>,
    /// Render only these frames, counted from 1.
    #[arg(long, value_name = "N|N-N", requires = "frames", value_parser = numbers)]
    pub frame: Option<[u32; 2]>,
    /// Degrees of the orbit over all frames [default: 360; 0 with --zoom-to].
    #[arg(long, value_name = "DEGREES", requires = "frames", conflicts_with = "zoom_to", allow_negative_numbers = true, value_parser = turned)]
    pub turn: Option<f32>,
    /// Magnification of the last frame.
    #[arg(long, value_name = "ZOOM", requires = "frames", value_parser = positive)]
    pub zoom_to: Option<f32>,
    /// Write an Open Job Description template (.yaml or .json) with one task per frame, and render
    /// nothing.
    #[arg(long, value_name = "FILE", requires = "frames")]
    pub job: Option<PathBuf>,
}

/// Options of `bake`.
#[derive(Debug, Args)]
pub struct Bake {
    /// fBm of this noise as a height field [default: gaussian].
    #[arg(long, group = "surface", value_parser = one_of(BAKED_NOISES))]
    pub noise: Option<BakedNoise>,
    /// Bumps whose normals have this NDF, as in `tables`; there is no height map.
    #[arg(long, group = "surface")]
    pub ndf: Option<String>,
    /// A fractal surface.
    #[arg(long, group = "surface", value_enum)]
    pub fractal: Option<BakedFractal>,
    /// A material of `render` on a flat square.
    #[arg(long, group = "surface", value_enum)]
    pub material: Option<Material>,
    /// Set a parameter of the material; may be repeated. `render --help-material` lists them.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment, requires = "material")]
    pub set: Vec<(String, String)>,
    /// Side of the square in meters, for --material.
    #[arg(long, default_value_t = 0.25, value_parser = positive, requires = "material")]
    pub side: f32,
    /// Options for images.
    #[command(flatten)]
    pub images: Images,
    /// Texels along a side, a power of two.
    #[arg(long, default_value_t = 1024, value_parser = whole(64, 65_536))]
    pub size: u32,
    /// Texels along the side of a tile, a power of two; determines peak memory.
    #[arg(long, default_value_t = 1024, value_parser = whole(64, 4096))]
    pub tile: u32,
    /// Samples along the side of a texel, 1 or an even number.
    #[arg(long, default_value_t = 2, value_parser = whole(1, 16))]
    pub samples: u32,
    /// Make the texture tileable, or report why it cannot be.
    #[arg(long)]
    pub tileable: bool,
    /// Lattice cells, or nodes of a fractal surface, along a side [default: 8].
    #[arg(long, value_parser = whole(1, 65_536))]
    pub cells: Option<u32>,
    /// Octaves of noise, up to 16 [default: 6].
    #[arg(long, value_parser = whole(1, 16))]
    pub octaves: Option<u32>,
    /// Ratio of the frequencies of consecutive octaves [default: 2 if tileable, else 2.17].
    #[arg(long, value_parser = positive)]
    pub lacunarity: Option<f32>,
    /// Ratio of the amplitudes of consecutive octaves, in (0, 1] [default: 0.5].
    #[arg(long, value_parser = share)]
    pub gain: Option<f32>,
    /// Vertical scaling of a fractal surface, below 0.447; larger is rougher [default: 0.375].
    #[arg(long, value_parser = share)]
    pub scaling: Option<f32>,
    /// Standard deviation of the heights, in sides of the texture [default: 0.01].
    #[arg(long, value_parser = positive)]
    pub height: Option<f32>,
    /// Maximum distance of occluders, in sides of the texture or of each of its --parts [default:
    /// 0.015625].
    #[arg(long, value_parser = share)]
    pub occlusion: Option<f32>,
    /// Color, sRGB in hexadecimal [default: b4b0a8].
    #[arg(long, value_name = "RRGGBB", value_parser = color)]
    pub tint: Option<u32>,
    /// Color of low parts [default: --tint].
    #[arg(long, value_name = "RRGGBB", value_parser = color)]
    pub low_tint: Option<u32>,
    /// Roughness √α of the surface between its bumps [default: 0.6; 0 with --ndf].
    #[arg(long, value_parser = share)]
    pub roughness: Option<f32>,
    /// Metallic, 0 to 1 [default: 0].
    #[arg(long, value_parser = fraction)]
    pub metallic: Option<f32>,
    /// Random seed.
    #[arg(long, default_value_t = 1)]
    pub seed: u32,
    /// Formats, separated by commas.
    #[arg(long, value_delimiter = ',', value_parser = one_of(BAKED_FORMATS), default_value = "png")]
    pub format: Vec<BakedFormat>,
    /// Bake only these tiles, counted from 1 row by row; a run without it writes the textures once
    /// all tiles exist.
    #[arg(long, value_name = "N|N-N", value_parser = numbers)]
    pub tiles: Option<[u32; 2]>,
    /// Split the texture into N × N parts of --size texels, each a set in its own directory,
    /// `u1_v1` at the lower left. --cells, --height and --side refer to the whole.
    #[arg(long, value_name = "N", value_parser = whole(2, 16_384), conflicts_with = "tiles")]
    pub parts: Option<u32>,
    /// Bake only these parts, counted from 1 row by row.
    #[arg(long, value_name = "N|N-N", requires = "parts", value_parser = numbers)]
    pub part: Option<[u32; 2]>,
    /// Write an Open Job Description template (.yaml or .json) with one task per tile or part, and
    /// bake nothing.
    #[arg(long, value_name = "FILE")]
    pub job: Option<PathBuf>,
    /// Output directory.
    #[arg(long, value_name = "DIR", default_value = "target/asperity/bake")]
    pub out: PathBuf,
}

const SCENES: &Words<Set> = &[
    ("teapot", "The Utah teapot", Set::Teapot),
    ("sphere", "A sphere", Set::Sphere),
    ("plane", "A plane at an angle; to the horizon with materials other than bumps", Set::Plane),
    ("car", "A smooth car body", Set::Car),
    ("room", "The corner of a room", Set::Room),
    ("wall", "A wall at a low angle", Set::Wall),
    ("vase", "A turned vase on a table", Set::Vase),
];

const UPS: &Words<Up> =
    &[("y", "As in glTF and most other formats", Up::Y), ("z", "As in CAD and maps", Up::Z)];

const RULES: &Words<LevelOfDetail> = &[
    ("exact", "Keeps the mean at every zoom", LevelOfDetail::Exact),
    (
        "fractal",
        "Kautz et al. 2001: every facet is shaded with the whole distribution",
        LevelOfDetail::Fractal,
    ),
];

const NOISES: &Words<NoiseKind> = &[
    ("gaussian", "Slopes of exactly Gaussian value-gradient noise", NoiseKind::Gaussian),
    ("channels", "Two channels of this noise, which do not look like a relief", NoiseKind::Channels),
    ("perlin", "Perlin noise (2002) through its measured CDF", NoiseKind::Perlin),
    ("simplex", "Simplex noise through its measured CDF", NoiseKind::Simplex),
];

const BAKED_NOISES: &Words<BakedNoise> = &[
    ("gaussian", "Exactly Gaussian value-gradient noise", BakedNoise::Gaussian),
    ("perlin", "Perlin noise (2002)", BakedNoise::Perlin),
    ("simplex", "Simplex noise; tileable with a multiple of 3 cells, as a slice of 3-D", BakedNoise::Simplex),
    ("value", "Value noise", BakedNoise::Value),
    ("sparse", "Sparse convolution noise", BakedNoise::Sparse),
    ("cellular", "Cellular (Worley) noise", BakedNoise::Cellular),
];

const BAKED_FORMATS: &Words<BakedFormat> = &[
    ("png", "16 bits per channel, with a glTF material", BakedFormat::Png),
    ("exr", "Tiled OpenEXR, half floats, all mip levels", BakedFormat::Exr),
    ("ktx2", "Block-compressed (BC7, BC5, BC4), all mip levels", BakedFormat::Ktx2),
];

/// The noises of `bake`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BakedNoise {
    Gaussian,
    Perlin,
    Simplex,
    Value,
    Sparse,
    Cellular,
}

/// The formats of `bake`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BakedFormat {
    Png,
    Exr,
    Ktx2,
}

/// The fractal surfaces of `bake`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BakedFractal {
    /// The periodic surface, without grain.
    Periodic,
}

/// The materials of `render`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Material {
    /// Bumps with the distribution --ndf.
    Bumps,
    /// Car carpet.
    Carpet,
    /// Metallic paint with sparkles.
    Paint,
    /// Metallic paint with counted flakes.
    Flakes,
    /// Tempered glass, a refracting solid.
    Glass,
    /// Rough glass, a refracting solid.
    Frosted,
    /// Plastic with blemishes and dents.
    Plastic,
    /// Scratched metal.
    Scratched,
    /// Polished metal.
    Chrome,
    /// Bricks and mortar.
    Brick,
    /// Blue marble.
    Marble,
    /// Stars on paper.
    Wallpaper,
}

/// Tone curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Tone {
    /// A filmic curve with toe and shoulder.
    Filmic,
    /// Clipped at white.
    Plain,
}

/// Background of the subject.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Background {
    /// The light.
    Light,
    /// A color.
    Color(u32),
}

fn behind(text: &str) -> Result<Background, &'static str> {
    let given = || color(text).map(Background::Color);
    if text == "light" {
        Ok(Background::Light)
    } else {
        given().map_err(|_| "must be `light` or six hexadecimal digits")
    }
}

fn assignment(text: &str) -> Result<(String, String), &'static str> {
    let parts = text.split_once('=').ok_or("must be NAME=VALUE, such as coat_roughness=0.1")?;
    Ok((parts.0.trim().into(), parts.1.trim().into()))
}

/// A parser of whole numbers of a range.
fn whole(least: u32, most: u32) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync {
    move |text| {
        let number = text.parse().ok().filter(|n| (least..=most).contains(n));
        number.ok_or_else(|| format!("must be an integer from {least} to {most}"))
    }
}

fn degrees(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| (0.0..=180.0).contains(x));
    number.ok_or("must be an angle from 0 to 180 degrees")
}

fn field_of_view(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| (0.1..=170.0).contains(x));
    number.ok_or("must be an angle from 0.1 to 170 degrees")
}

fn point(text: &str) -> Result<[f64; 3], &'static str> {
    let coordinate = |text: &str| text.trim().parse().ok().filter(|x: &f64| x.abs() <= 1e30);
    let all: Option<Vec<_>> = text.split(',').map(coordinate).collect();
    all.and_then(|all| all.try_into().ok()).ok_or("must be three numbers, such as 0,1.5,-4")
}

fn turned(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| x.abs() <= 36_000.0);
    number.ok_or("must be an angle of at most 36000 degrees")
}

/// A number from 1, or a range of them, first and last.
fn numbers(text: &str) -> Result<[u32; 2], &'static str> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    match [first, last].map(str::parse) {
        [Ok(first), Ok(last)] if 1 <= first && first <= last => Ok([first, last]),
        _ => Err("must be a number from 1, or a range such as 13-24"),
    }
}

fn positive(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| x.is_finite() && *x > 0.0);
    number.ok_or("must be a number above 0")
}

fn fraction(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| (0.0..=1.0).contains(x));
    number.ok_or("must be a number from 0 to 1")
}

fn share(text: &str) -> Result<f32, &'static str> {
    positive(text).ok().filter(|x| *x <= 1.0).ok_or("must be a number above 0 and at most 1")
}

fn color(text: &str) -> Result<u32, &'static str> {
    let digits = text.trim_start_matches('#');
    match u32::from_str_radix(digits, 16) {
        Ok(rgb) if digits.len() == 6 => Ok(rgb),
        _ => Err("must be six hexadecimal digits, such as d9a066"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_values_are_usage_errors() {
        for line in [
            "asperity render --zoom 0",
            "asperity render --zoom nan",
            "asperity render --gain 1.5",
            "asperity render --gain 2",
            "asperity render --tint f2b18",
            "asperity render --background sky",
            "asperity render --set gain",
            "asperity render --octaves 17",
            "asperity render --roughness 0.2 --ndf ggx:0.2",
            "asperity render --crease 30",
            "asperity render --mesh a.obj --crease 181",
            "asperity render --scene barn",
            "asperity render --mesh a.obj --scene plane",
            "asperity render --up z",
            "asperity render --fov 30",
            "asperity render --no-ground",
            "asperity render --mesh a.obj --fov 0",
            "asperity render --mesh a.obj --camera 1,2",
            "asperity render --mesh a.obj --target 1,2,nan",
            "asperity render --mesh a.obj --up x",
            "asperity check-ndf",
            "asperity render --jobs 0",
            "asperity nothing",
        ] {
            let error = Cli::try_parse_from(line.split(' ')).unwrap_err();
            assert_eq!(error.exit_code(), 2, "{line}");
        }
        let error = Cli::try_parse_from(["asperity", "render", "--size", "1e3"]).unwrap_err().to_string();
        assert!(error.contains("must be an integer from 16 to 8192"), "{error}");
    }
}
