//! The command line: what can be asked, in the words of `--help`.

use std::path::PathBuf;

use asperity_ndf_sampling::{
    Measure, Reconstruction,
    normal_map::{Blue, TangentSpace},
};
use asperity_render::{geometry::mesh_file::Up, materials::field::NoiseKind, scenes::Set};
use asperity_shading::LevelOfDetail;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::quality::Quality;

/// The builder of Asperity: tables, gallery, single pictures and every check.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", version, disable_help_subcommand = true)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Worker threads; all cores if not given.
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) jobs: Option<u16>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Build every table, draw every figure, write the page.
    #[command(after_help = "Examples:
  cargo xtask gallery
  cargo xtask gallery --only teapot --size 768 --spp 16
  cargo xtask gallery --only car --quality book
  cargo xtask gallery --list")]
    Gallery(Gallery),
    /// Build the tables alone: lattices, noise CDFs, densities, normal tables, fractal interpolation functions.
    #[command(after_help = "Examples:
  cargo xtask tables
  cargo xtask tables --ndf ggx:0.1,0.5 --ndf painted.png --measure solid-angle
  cargo xtask tables --normal-map bricks.png --tangent-space directx
  cargo xtask tables --fif system.json --out my-tables
  cargo xtask tables --check")]
    Tables(Tables),
    /// Render a scene or a mesh with a chosen material and light to a PNG, JPEG, WebP or OpenEXR file.
    #[command(after_help = "Examples:
  cargo xtask render --scene teapot --ndf ggx:0.1,0.4 --zoom 4
  cargo xtask render --scene car --material paint --quality draft
  cargo xtask render --scene room --material carpet --tone plain --out carpet.exr
  cargo xtask render --scene sphere --material glass --light studio.exr
  cargo xtask render --scene sphere --ndf beckmann:0.3 --rule fractal --zoom 16 --size 1024
  cargo xtask render --mesh bunny.ply --ndf ward:0.1,0.3 --size 768
  cargo xtask render --mesh house.obj --up z --material brick --light sky.hdr --noise 0.02
  cargo xtask render --mesh part.stl --material paint --tint b02a1e --set orange_peel_strength=0.03
  cargo xtask render --frames 24 --out frames/####.png
  cargo xtask render --frames 4000 --zoom-to 10000 --out frames/####.exr --job job.yaml
  cargo xtask render --help-material paint

The picture appears at once, coarse, and is written anew as it grows finer: watch the file, stop with Ctrl-C at will.
--ndf, --normal-map, --rule, --octaves, --frequency, --gain and --bump-noise are of bumps; what another material would pass over is refused.")]
    Render(Render),
    /// Bake a noise, a density, a fractal surface or a material to the textures of a material, for engines.
    #[command(after_help = "Examples:
  cargo xtask bake --noise perlin --tileable --size 4096
  cargo xtask bake --noise cellular --cells 16 --octaves 1 --height 0.01 --tint d9a066 --low-tint 3a2f28
  cargo xtask bake --material brick --side 1.04 --set depth=0.01 --format png,ktx2
  cargo xtask bake --ndf ggx:0.1,0.4 --metallic 1 --tint e4c07a --tileable
  cargo xtask bake --fractal torus --tileable --size 2048 --height 0.03
  cargo xtask bake --noise perlin --tileable --size 16384 --tile 1024 --format png,exr,ktx2 --out rock
  cargo xtask bake --noise perlin --tileable --size 16384 --out /shared/rock --job rock.yaml
  cargo xtask bake --noise perlin --cells 512 --size 4096 --parts 16 --part 1-3 --out land

Base colour, normals for OpenGL and DirectX, height, roughness, metallic and ambient occlusion are written, with a glTF and a
MaterialX material and a record of all parameters. Tiles are kept until the set is whole: a run that was stopped goes on when it is called again, and memory is
that of one tile. A map that is the same everywhere has 4 × 4 texels.")]
    Bake(Bake),
    /// Run the crates' benches, or time our noises beside those of other libraries.
    #[command(after_help = "Examples:
  cargo xtask bench
  cargo xtask bench --only perlin
  cargo xtask bench --peers
  cargo xtask bench --peers --only fill_grid/3-d --only value/ --rounds 41
  FASTNOISE2_LIB_DIR=/path/to/lib cargo xtask bench --peers --ship
  cargo bench --package asperity-noise -- 3-d/perlin

The benches of noise have every kind at every SIMD level and take a quarter of an hour to build; the last
example builds one kind alone, in two minutes. FastNoise2 is C++ and is measured if FASTNOISE2_LIB_DIR names
the folder of its static library; xtask/peers/README.md says how to build it.")]
    Bench(Bench),
    /// Write the functions of the shaders in every shading language with a page of all, or compare them with the crates on adapters.
    #[command(after_help = "Examples:
  cargo xtask shaders
  cargo xtask shaders --part noise/kinds/gaussian --dialect glsl-es-300 --out my-shaders
  cargo xtask shaders --check
  cargo xtask shaders --adapter llvmpipe --part ndf/density

index.html in the folder, target/asperity/shaders if none is named, has every part with its bindings and a use in wgpu, Bevy,
three.js, Godot, Unity and Metal.

Drivers in software are Debian's mesa-vulkan-drivers, and SwiftShader, which comes with Chromium; validators are those of
spirv-tools and glslang-tools, and g++. What is missing is said. The program is built in tests/gpu, which takes minutes the first time.")]
    Shaders(Shaders),
    /// Write the live page: bumps, noise, fractal functions and materials under one's hands, in one file.
    #[command(after_help = "Examples:
  cargo xtask web
  cargo xtask web --serve 8000

index.html opens from the disk; the folder `hosted` is for a web server. Nothing is asked of any network.")]
    Web(Web),
    /// Check a density's normalisation, samples, map and inverse map, and print a report.
    #[command(after_help = "Examples:
  cargo xtask check --ndf ggx:0.1,0.5
  cargo xtask check --ndf painted.png --measure solid-angle --seed 7")]
    Check(Check),
    /// Check dependency edges, the order of rooms, circles of files, and the heads of all files.
    Tidy,
    /// Run every gate that stands before `main`.
    Ci(Ci),
    /// Attack every constructor, evaluation and reader with what a fuzzer makes up.
    #[command(after_help = "Examples:
  cargo xtask fuzz
  cargo xtask fuzz --only gltf --seconds 600
  cargo xtask fuzz --runs 10000000 --seconds 3600 --ship

The attacks are in tests/fuzz; libFuzzer is C++ and is built with them. What breaks a promise is kept in tests/fuzz/target/findings.")]
    Fuzz(Fuzz),
    /// Link the crates without std and without an allocator, and call them.
    NoStd,
    /// Compute every crate's values on every platform at hand, emulated ones too, and compare their bits with the golden ones.
    #[command(after_help = "Examples:
  cargo xtask bits
  cargo xtask bits --ship

x86-64 at every SIMD level and, built without std, AArch64, big-endian PowerPC, WebAssembly with and without SIMD128, and a Cortex-M4
on bare metal. Emulators are Debian's qemu-user and qemu-system-arm; linkers are gcc-aarch64-linux-gnu, gcc-powerpc64-linux-gnu and lld;
WebAssembly runs in node. The table says what is missing.")]
    Bits(Bits),
    /// Count the lines of every crate that tests run, and name what they do not.
    #[command(after_help = "Examples:
  cargo xtask coverage
  cargo xtask coverage --tests-of asperity-fif

It builds the tests anew in target/coverage and needs llvm-profdata and llvm-cov of the LLVM that rustc has: the component llvm-tools of
rustup, or Debian's llvm-22.")]
    Coverage(Coverage),
    /// Draw a picture from tables in flash on an emulated Cortex-M4 and compare it with this machine's, or say what is missing for that.
    Firmware(Firmware),
}

#[derive(Debug, Args)]
pub(crate) struct Check {
    /// The density, in the words of `tables`; may be given again.
    #[arg(long, value_name = "NDF", required = true)]
    pub(crate) ndf: Vec<String>,
    #[command(flatten)]
    pub(crate) images: Images,
    /// Seed of the samples.
    #[arg(long, default_value_t = 0)]
    pub(crate) seed: u32,
}

#[derive(Debug, Args)]
pub(crate) struct Bits {
    /// Make this machine's values golden, and write the table into `docs/trust`, if every platform has them.
    #[arg(long)]
    pub(crate) ship: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Coverage {
    /// Packages whose tests run; the published crates and the workspace's own tests if none is named. Repeat it.
    #[arg(long, value_name = "PACKAGE")]
    pub(crate) tests_of: Vec<String>,
    /// Write the table also into `docs/trust`, where it is checked in.
    #[arg(long, conflicts_with = "tests_of")]
    pub(crate) ship: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Firmware {
    /// Write the table, and the page with what functions cost into `docs/trust`.
    #[arg(long)]
    pub(crate) ship: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Ci {
    /// Run only the gates whose name contains NAME; may be given again.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
    /// Run the weekly gates too, which take minutes: feature sets, shaders on drivers, the live page, firmware,
    /// bits of every platform, packages in an empty workspace, fuzz targets.
    #[arg(long, conflicts_with = "only")]
    pub(crate) weekly: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Fuzz {
    /// Run only the attacks whose name contains NAME; may be given again.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
    /// Seconds of every attack.
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) seconds: u32,
    /// The most executions of every attack.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) runs: Option<u32>,
    /// Write the table into `docs/trust`, where it is checked in.
    #[arg(long, conflicts_with = "only")]
    pub(crate) ship: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Gallery {
    /// Draw only the figures whose name contains NAME; may be given again.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
    /// List the figures and stop.
    #[arg(long)]
    pub(crate) list: bool,
    /// Fineness of the pictures; --size and --spp set it one by one.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) quality: Quality,
    /// Side of a square panel in pixels [default: 384; of a draft 192, for a book 1024].
    #[arg(long, value_parser = clap::value_parser!(u32).range(16..=4096))]
    pub(crate) size: Option<u32>,
    /// Samples per pixel; some figures take a multiple, still lifes as many as they need [default: 4; of a draft 1, for a book 32].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(crate) spp: Option<u32>,
    /// Seed of every random choice.
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u32,
    /// Draw also what is already there.
    #[arg(long)]
    pub(crate) afresh: bool,
    /// Folder of the gallery and its tables.
    #[arg(long, value_name = "DIR", default_value = "target/asperity")]
    pub(crate) out: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct Tables {
    /// Tables of one density instead of the default set: `ggx:AX[,AY]`, `beckmann:AX[,AY]`, `ward:AX[,AY]`,
    /// `student-t:AX,AY,GAMMA`, `blinn-phong:N`, `ashikhmin-shirley:NU,NV`, `painted`, or an image file.
    #[arg(long, value_name = "NDF")]
    pub(crate) ndf: Vec<String>,
    /// Tables of the density that a normal map's normals have.
    #[arg(long, value_name = "FILE")]
    pub(crate) normal_map: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) images: Images,
    /// Tables of a fractal interpolation function instead of the default set: a JSON file with `knots`, `alpha`, `q`.
    #[arg(long, value_name = "FILE")]
    pub(crate) fif: Vec<PathBuf>,
    /// Write nothing: compare every file in the folder with what the same command makes and, where no table is named, the tables
    /// that the crates ship too.
    #[arg(long, conflicts_with = "ship")]
    pub(crate) check: bool,
    /// Write the tables that the crates ship into the source tree.
    #[arg(long, conflicts_with_all = ["ndf", "normal_map", "fif"])]
    pub(crate) ship: bool,
    /// Folder of the tables.
    #[arg(long, value_name = "DIR", default_value = "target/asperity/tables")]
    pub(crate) out: PathBuf,
}

impl Tables {
    /// Whether no single table is named.
    pub(crate) const fn makes_the_usual(&self) -> bool {
        self.ndf.is_empty() && self.normal_map.is_empty() && self.fif.is_empty()
    }
}

#[derive(Debug, Args)]
pub(crate) struct Render {
    /// The scene.
    #[arg(long, value_parser = one_of(SCENES), default_value = "teapot")]
    pub(crate) scene: Set,
    /// See the mesh of this file instead, centred and scaled to fill the picture: .obj, .ply, .stl, .glb or .gltf.
    #[arg(long, value_name = "FILE", conflicts_with = "scene")]
    pub(crate) mesh: Option<PathBuf>,
    /// Which way is up in the mesh's file [default: z of .stl, else y].
    #[arg(long, value_parser = one_of(UPS), requires = "mesh")]
    pub(crate) up: Option<Up>,
    /// Angle between triangles from which on there is an edge, in degrees, where a file has no normals [default: 40].
    #[arg(long, value_name = "DEGREES", requires = "mesh", value_parser = degrees)]
    pub(crate) crease: Option<f32>,
    /// The material of the subject [default: what suits the scene].
    #[arg(long, value_enum)]
    pub(crate) material: Option<Material>,
    /// Colour of the material, sRGB in hexadecimal.
    #[arg(long, value_name = "RRGGBB", value_parser = colour)]
    pub(crate) tint: Option<u32>,
    /// Roughness of the material, between 0 and 1; of bumps that of a GGX density.
    #[arg(long, value_parser = share, conflicts_with_all = ["ndf", "normal_map"])]
    pub(crate) roughness: Option<f32>,
    /// Size of the material's pattern over the usual one.
    #[arg(long, value_parser = positive)]
    pub(crate) scale: Option<f32>,
    /// Set a parameter of the material; may be given again. `--help-material` lists them.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// List the parameters of a material and stop.
    #[arg(long, value_enum, value_name = "MATERIAL", exclusive = true)]
    pub(crate) help_material: Option<Material>,
    /// The light: `lamps` (from single directions, without shadows; for bumps alone), `studio`, `day`, or an image of the
    /// surroundings by longitude and latitude: Radiance HDR, OpenEXR, PNG, JPEG, WebP [default: `lamps` for bumps, else `studio`].
    #[arg(long, value_name = "LIGHT")]
    pub(crate) light: Option<String>,
    /// Background of the subject: `light`, or a colour [default: a light that is given, else dark grey].
    #[arg(long, value_name = "light|RRGGBB", value_parser = behind)]
    pub(crate) background: Option<Background>,
    /// Tone curve [default: filmic]; OpenEXR files have the radiance itself.
    #[arg(long, value_enum)]
    pub(crate) tone: Option<Tone>,
    /// The density of normals of bumps: `ggx:AX[,AY]`, `beckmann:AX[,AY]`, `ward:AX[,AY]`, `student-t:AX,AY,GAMMA`,
    /// `blinn-phong:N`, `ashikhmin-shirley:NU,NV`, `painted`, or an image file [default: ggx:0.2,0.4].
    #[arg(long)]
    pub(crate) ndf: Option<String>,
    /// Take the density of this normal map's normals.
    #[arg(long, value_name = "FILE", conflicts_with = "ndf")]
    pub(crate) normal_map: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) images: Images,
    /// The level-of-detail rule of bumps [default: exact].
    #[arg(long, value_parser = one_of(RULES))]
    pub(crate) rule: Option<LevelOfDetail>,
    /// Magnification: 1 shows the whole object.
    #[arg(long, default_value_t = 1.0, value_parser = positive)]
    pub(crate) zoom: f32,
    /// The most octaves of bumps, up to 16 [default: 16].
    #[arg(long, value_parser = whole(0, 16))]
    pub(crate) octaves: Option<u32>,
    /// Lattice cells of the bumps' first octave per unit of length [default: what suits the scene].
    #[arg(long, value_parser = positive)]
    pub(crate) frequency: Option<f32>,
    /// Amplitude of each octave of bumps over the one before, above 0, at most 1 [default: 0.8].
    #[arg(long, value_parser = share)]
    pub(crate) gain: Option<f32>,
    /// The noise that bumps are made of [default: gaussian].
    #[arg(long, value_parser = one_of(NOISES))]
    pub(crate) bump_noise: Option<NoiseKind>,
    /// Exposure [default: 1.45, of an image of the surroundings what suits its brightness].
    #[arg(long, value_parser = positive)]
    pub(crate) exposure: Option<f32>,
    /// Fineness of the picture; --size, --spp and --noise set it one by one.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) quality: Quality,
    /// Side of the picture in pixels, from 16 to 8192 [default: 512; of a draft 256, for a book 2048].
    #[arg(long, value_parser = whole(16, 8192))]
    pub(crate) size: Option<u32>,
    /// The most samples per pixel, up to 65536; alone, exactly so many [default: 1024; of a draft 128, for a book 8192].
    #[arg(long, value_parser = whole(1, 65_536))]
    pub(crate) spp: Option<u32>,
    /// Grain at which the picture is done: its standard deviation, where white is 1 [default: 0.008; of a draft 0.03, for a book 0.004].
    #[arg(long, value_parser = share)]
    pub(crate) noise: Option<f32>,
    /// Seed of every random choice.
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u32,
    /// The picture's file, in the format of its ending: .png, .jpg, .webp or .exr; written anew as it grows finer. Of frames its name
    /// has a row of `#` for their numbers.
    #[arg(long, value_name = "FILE", default_value = "target/asperity/render.png")]
    pub(crate) out: PathBuf,
    /// Draw so many frames: once round the subject, or nearer.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) frames: Option<u32>,
    /// Draw these frames alone, counted from 1.
    #[arg(long, value_name = "N|N-N", requires = "frames", value_parser = numbers)]
    pub(crate) frame: Option<[u32; 2]>,
    /// Degrees that the camera goes round while the frames pass [default: 360, with --zoom-to 0].
    #[arg(long, value_name = "DEGREES", requires = "frames", conflicts_with = "zoom_to", allow_negative_numbers = true, value_parser = turned)]
    pub(crate) turn: Option<f32>,
    /// Magnification of the last frame.
    #[arg(long, value_name = "ZOOM", requires = "frames", value_parser = positive)]
    pub(crate) zoom_to: Option<f32>,
    /// Write the frames as a job for many machines in place of drawing them: a template of Open Job Description, .yaml or .json.
    #[arg(long, value_name = "FILE", requires = "frames")]
    pub(crate) job: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct Bake {
    /// A height field of octaves of this noise [default: gaussian].
    #[arg(long, group = "surface", value_parser = one_of(BAKED_NOISES))]
    pub(crate) noise: Option<BakedNoise>,
    /// Bumps whose normals have this density, in the words of `tables`: they have normals, but no heights.
    #[arg(long, group = "surface")]
    pub(crate) ndf: Option<String>,
    /// A fractal surface.
    #[arg(long, group = "surface", value_enum)]
    pub(crate) fractal: Option<BakedFractal>,
    /// A material of `render`, on a flat square.
    #[arg(long, group = "surface", value_enum)]
    pub(crate) material: Option<Material>,
    /// Set a parameter of the material; may be given again. `render --help-material` lists them.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment, requires = "material")]
    pub(crate) set: Vec<(String, String)>,
    /// Side of the square that a material is seen on, in metres.
    #[arg(long, default_value_t = 0.25, value_parser = positive, requires = "material")]
    pub(crate) side: f32,
    #[command(flatten)]
    pub(crate) images: Images,
    /// Texels along a side, a power of two.
    #[arg(long, default_value_t = 1024, value_parser = whole(64, 65_536))]
    pub(crate) size: u32,
    /// Texels along the side of a tile, a power of two: what is in memory at once.
    #[arg(long, default_value_t = 1024, value_parser = whole(64, 4096))]
    pub(crate) tile: u32,
    /// Samples along the side of a texel, 1 or an even number.
    #[arg(long, default_value_t = 2, value_parser = whole(1, 16))]
    pub(crate) samples: u32,
    /// Let opposite edges meet without a seam, or say why they cannot.
    #[arg(long)]
    pub(crate) tileable: bool,
    /// Lattice cells, or nodes of a fractal surface, along a side [default: 8].
    #[arg(long, value_parser = whole(1, 65_536))]
    pub(crate) cells: Option<u32>,
    /// Octaves of noise, up to 16 [default: 6].
    #[arg(long, value_parser = whole(1, 16))]
    pub(crate) octaves: Option<u32>,
    /// Frequency of each octave over that of the one before [default: 2 if tileable, else 2.17].
    #[arg(long, value_parser = positive)]
    pub(crate) lacunarity: Option<f32>,
    /// Amplitude of each octave over that of the one before, above 0, at most 1 [default: 0.5].
    #[arg(long, value_parser = share)]
    pub(crate) gain: Option<f32>,
    /// Vertical factor of a fractal surface, its roughness: below 0.447 [default: 0.375].
    #[arg(long, value_parser = share)]
    pub(crate) factor: Option<f32>,
    /// Standard deviation of the heights, in sides of the texture [default: 0.01].
    #[arg(long, value_parser = positive)]
    pub(crate) height: Option<f32>,
    /// Distance up to which the surroundings take light away, in sides of the texture, or of each of its --parts [default: 0.015625].
    #[arg(long, value_parser = share)]
    pub(crate) occlusion: Option<f32>,
    /// Colour, sRGB in hexadecimal [default: b4b0a8].
    #[arg(long, value_name = "RRGGBB", value_parser = colour)]
    pub(crate) tint: Option<u32>,
    /// Colour of low parts, where it is another.
    #[arg(long, value_name = "RRGGBB", value_parser = colour)]
    pub(crate) low_tint: Option<u32>,
    /// Roughness √α of the surface between its bumps [default: 0.6; of a density 0].
    #[arg(long, value_parser = share)]
    pub(crate) roughness: Option<f32>,
    /// Metal: 0 or 1, or between [default: 0].
    #[arg(long, value_parser = fraction)]
    pub(crate) metallic: Option<f32>,
    /// Seed of every random choice.
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u32,
    /// Formats of the maps, with commas between them.
    #[arg(long, value_delimiter = ',', value_parser = one_of(BAKED_FORMATS), default_value = "png")]
    pub(crate) format: Vec<BakedFormat>,
    /// Bake these tiles alone, counted from 1 row by row; a run without it writes the set when all are there.
    #[arg(long, value_name = "N|N-N", value_parser = numbers)]
    pub(crate) tiles: Option<[u32; 2]>,
    /// Cut the texture into so many parts along a side, each of --size texels and a set of its own in a folder of its own, `u1_v1`
    /// the lower left; cells, heights and metres are those of the whole.
    #[arg(long, value_name = "N", value_parser = whole(2, 16_384), conflicts_with = "tiles")]
    pub(crate) parts: Option<u32>,
    /// Bake these parts alone, counted from 1 row by row.
    #[arg(long, value_name = "N|N-N", requires = "parts", value_parser = numbers)]
    pub(crate) part: Option<[u32; 2]>,
    /// Write the tiles, or the parts, as a job for many machines in place of baking them: a template of Open Job Description, .yaml or
    /// .json.
    #[arg(long, value_name = "FILE")]
    pub(crate) job: Option<PathBuf>,
    /// Folder of the set.
    #[arg(long, value_name = "DIR", default_value = "target/asperity/bake")]
    pub(crate) out: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct Bench {
    /// Time our noises beside those of other libraries, in one process, all contenders in turn.
    #[arg(long, group = "page")]
    pub(crate) peers: bool,
    /// Time how cost grows with octaves, samples, texels, lights and tolerance, and draw it.
    #[arg(long, group = "page")]
    pub(crate) growth: bool,
    /// Run only the benches or rows whose name contains NAME; may be given again.
    #[arg(long, value_name = "NAME")]
    pub(crate) only: Vec<String>,
    /// Turns of every contender.
    #[arg(long, value_name = "N", default_value_t = 21, requires = "peers", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(crate) rounds: u32,
    /// Lattice cells between neighbours on a grid.
    #[arg(long, default_value_t = 0.05, requires = "peers", value_parser = positive)]
    pub(crate) step: f32,
    /// Write the table and the chart also into `docs/bench`, where they are checked in.
    #[arg(long, requires = "page", conflicts_with = "only")]
    pub(crate) ship: bool,
    /// Folder of the table, the chart and all times.
    #[arg(long, value_name = "DIR", default_value = "target/asperity/bench", requires = "page")]
    pub(crate) out: PathBuf,
}

/// Languages that shaders are written in.
const DIALECTS: [&str; 8] =
    ["wgsl", "glsl-450", "glsl-es-300", "glsl-es-310", "hlsl", "msl", "spirv", "spirv-no-contraction"];

#[derive(Debug, Args)]
pub(crate) struct Shaders {
    /// Only functions whose names, or those of the parts they need, contain NAME.
    #[arg(long, value_name = "NAME")]
    pub(crate) part: Option<String>,
    /// Write this language only; may be given again.
    #[arg(long, value_parser = PossibleValuesParser::new(DIALECTS), conflicts_with_all = ["check", "adapter"])]
    pub(crate) dialect: Vec<String>,
    /// Say which files are missing or stale, and compare every function with the crate's, interpreted and on each adapter.
    #[arg(long)]
    pub(crate) check: bool,
    /// Count the operations of every function, octave and pixel, and time frames on each adapter, into docs/shaders/costs.md.
    #[arg(long, conflicts_with_all = ["part", "dialect", "check"])]
    pub(crate) costs: bool,
    /// Compare, or time, on adapters whose name contains NAME.
    #[arg(long, value_name = "NAME")]
    pub(crate) adapter: Option<String>,
    /// Folder of the shaders.
    #[arg(long, value_name = "DIR", default_value = "target/asperity/shaders")]
    pub(crate) out: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct Web {
    /// Serve the page on this port of 127.0.0.1, any that is free if none is named, until Ctrl-C.
    #[arg(long, value_name = "PORT", num_args = 0..=1, default_missing_value = "0")]
    pub(crate) serve: Option<u16>,
    /// Folder of the page.
    #[arg(long, value_name = "DIR", default_value = "target/asperity/web")]
    pub(crate) out: PathBuf,
}

/// Options for reading images.
#[derive(Clone, Copy, Debug, PartialEq, Args)]
pub(crate) struct Images {
    /// Measure that an image's grey values are a density over [default: normals].
    #[arg(long, value_parser = one_of(MEASURES))]
    pub(crate) measure: Option<Measure>,
    /// Reconstruction of a density between the pixels of its image [default: constant].
    #[arg(long, value_parser = one_of(RECONSTRUCTIONS))]
    pub(crate) reconstruction: Option<Reconstruction>,
    /// Which way the green channel of a normal map points [default: opengl].
    #[arg(long, value_parser = one_of(TANGENT_SPACES))]
    pub(crate) tangent_space: Option<TangentSpace>,
    /// Content of the blue channel of a normal map [default: z, unless blue is constant].
    #[arg(long, value_parser = one_of(BLUES))]
    pub(crate) blue: Option<Blue>,
}

impl Images {
    /// Values of options that are not given.
    pub(crate) const USUAL: Self =
        Self { measure: None, reconstruction: None, tangent_space: None, blue: None };
}

/// Words that an option takes: each with its help and its meaning.
type Words<T> = [(&'static str, &'static str, T)];

const RECONSTRUCTIONS: &Words<Reconstruction> = &[
    ("constant", "Constant on each pixel", Reconstruction::Constant),
    ("bilinear", "Bilinear between the centres of pixels", Reconstruction::Bilinear),
];

const TANGENT_SPACES: &Words<TangentSpace> =
    &[("opengl", "Up the image", TangentSpace::OpenGl), ("directx", "Down the image", TangentSpace::DirectX)];

const BLUES: &Words<Blue> = &[
    ("z", "The third coordinate", Blue::Read),
    ("unused", "Nothing: the third coordinate is computed from two", Blue::Reconstructed),
];

const MEASURES: &Words<Measure> = &[
    ("normals", "Over (n_x, n_y): the value is D itself, up to a factor", Measure::Normals),
    ("solid-angle", "Over solid angle: the value is D cos θ, up to a factor", Measure::SolidAngle),
];

const SCENES: &Words<Set> = &[
    ("teapot", "The Utah teapot", Set::Teapot),
    ("sphere", "A sphere", Set::Sphere),
    ("plane", "A plane, seen at an angle; of other materials than bumps, to the horizon", Set::Plane),
    ("car", "A smooth car-like body", Set::Car),
    ("room", "The corner of a room", Set::Room),
    ("wall", "A wall, seen along it", Set::Wall),
    ("vase", "A turned vase on a table", Set::Vase),
];

const UPS: &Words<Up> = &[
    ("y", "The convention of glTF and of most other formats", Up::Y),
    ("z", "The convention of files of buildings and maps", Up::Z),
];

const RULES: &Words<LevelOfDetail> = &[
    ("exact", "Keeps the mean at every zoom", LevelOfDetail::Exact),
    ("fractal", "The paper's: every facet is shaded with the whole density", LevelOfDetail::Fractal),
];

const NOISES: &Words<NoiseKind> = &[
    ("gaussian", "Exactly Gaussian value-gradient noise", NoiseKind::Gaussian),
    ("perlin", "Perlin's noise of 2002 through its measured distribution", NoiseKind::Perlin2002),
    ("simplex", "Simplex noise through its measured distribution", NoiseKind::Simplex),
];

const BAKED_NOISES: &Words<BakedNoise> = &[
    ("gaussian", "Exactly Gaussian value-gradient noise", BakedNoise::Gaussian),
    ("perlin", "Perlin's noise of 2002", BakedNoise::Perlin),
    (
        "simplex",
        "Simplex noise; tileable by a slice of space, with a multiple of 3 cells",
        BakedNoise::Simplex,
    ),
    ("value", "Value noise", BakedNoise::Value),
    ("sparse", "Sparse convolution noise", BakedNoise::Sparse),
    ("cellular", "Worley's cellular noise", BakedNoise::Cellular),
];

const BAKED_FORMATS: &Words<BakedFormat> = &[
    ("png", "16 bits a channel, with a glTF material", BakedFormat::Png),
    ("exr", "OpenEXR in tiles, half floats, with all levels", BakedFormat::Exr),
    ("ktx2", "Blocks of graphics cards, with all levels: BC7, BC5, BC4", BakedFormat::Ktx2),
];

/// A parser of the words of a table into what they mean.
fn one_of<T: Copy + Send + Sync>(words: &'static Words<T>) -> impl TypedValueParser<Value = T> {
    let values = words.iter().map(|(word, help, _)| PossibleValue::new(*word).help(*help));
    PossibleValuesParser::new(values).try_map(|said| {
        let meant = words.iter().find(|(word, ..)| *word == said);
        meant.map(|(_, _, meaning)| *meaning).ok_or("an unknown word")
    })
}

/// The noises of `bake`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BakedNoise {
    Gaussian,
    Perlin,
    Simplex,
    Value,
    Sparse,
    Cellular,
}

/// The formats of `bake`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BakedFormat {
    Png,
    Exr,
    Ktx2,
}

/// The fractal surfaces of `bake`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BakedFractal {
    /// The torus surface: periodic, and no product of curves.
    Torus,
}

/// The materials of `render`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Material {
    /// Bumps of the density `--ndf`.
    Bumps,
    /// The carpet of a car.
    Carpet,
    /// Metallic paint with sparkles.
    Paint,
    /// Metallic paint whose flakes are counted.
    Flakes,
    /// Tempered glass: a body that refracts.
    Glass,
    /// Rough glass: a body that refracts to all sides.
    Frosted,
    /// Plastic with blemishes and dents.
    Plastic,
    /// Scratched metal.
    Scratched,
    /// A polished metal.
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
pub(crate) enum Tone {
    /// A curve with a toe and a shoulder, as film has.
    Filmic,
    /// None: cut off at white.
    Plain,
}

/// Background of the subject.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Background {
    /// The light.
    Light,
    /// A colour.
    Colour(u32),
}

fn behind(text: &str) -> Result<Background, &'static str> {
    let given = || colour(text).map(Background::Colour);
    if text == "light" {
        Ok(Background::Light)
    } else {
        given().map_err(|_| "must be `light` or six hexadecimal digits")
    }
}

fn assignment(text: &str) -> Result<(String, String), &'static str> {
    let parts = text.split_once('=').ok_or("must be NAME=VALUE, as in coat_roughness=0.1")?;
    Ok((parts.0.trim().into(), parts.1.trim().into()))
}

/// A parser of whole numbers of a range.
fn whole(least: u32, most: u32) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync {
    move |text| {
        let number = text.parse().ok().filter(|n| (least..=most).contains(n));
        number.ok_or_else(|| format!("must be a whole number from {least} to {most}, written in digits"))
    }
}

fn degrees(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| (0.0..=180.0).contains(x));
    number.ok_or("must be a number of degrees from 0 to 180")
}

fn turned(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| x.abs() <= 36_000.0);
    number.ok_or("must be a number of degrees, at most a hundred turns")
}

/// A number from 1, or a range of them, first and last.
fn numbers(text: &str) -> Result<[u32; 2], &'static str> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    match [first, last].map(str::parse) {
        [Ok(first), Ok(last)] if 1 <= first && first <= last => Ok([first, last]),
        _ => Err("must be a number from 1, or two, as in 13-24"),
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
    positive(text).ok().filter(|x| *x <= 1.0).ok_or("must be a number above 0, at most 1")
}

fn colour(text: &str) -> Result<u32, &'static str> {
    let digits = text.trim_start_matches('#');
    match u32::from_str_radix(digits, 16) {
        Ok(rgb) if digits.len() == 6 => Ok(rgb),
        _ => Err("must be six hexadecimal digits, as in d9a066"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_values_are_usage_errors() {
        for line in [
            "cargo-xtask render --zoom 0",
            "cargo-xtask render --zoom nan",
            "cargo-xtask render --gain 1.5",
            "cargo-xtask render --gain 2",
            "cargo-xtask render --tint f2b18",
            "cargo-xtask render --background sky",
            "cargo-xtask render --set gain",
            "cargo-xtask render --octaves 17",
            "cargo-xtask render --roughness 0.2 --ndf ggx:0.2",
            "cargo-xtask render --crease 30",
            "cargo-xtask render --mesh a.obj --crease 181",
            "cargo-xtask render --scene barn",
            "cargo-xtask render --mesh a.obj --scene plane",
            "cargo-xtask render --up z",
            "cargo-xtask render --mesh a.obj --up x",
            "cargo-xtask gallery --size 3",
            "cargo-xtask gallery --jobs 0",
            "cargo-xtask tables --check --ship",
            "cargo-xtask bench --ship",
            "cargo-xtask bench --peers --ship --only value",
            "cargo-xtask bench --peers --rounds 0",
            "cargo-xtask check",
            "cargo-xtask nothing",
        ] {
            let error = Cli::try_parse_from(line.split(' ')).unwrap_err();
            assert_eq!(error.exit_code(), 2, "{line}");
        }
        let error = Cli::try_parse_from(["cargo-xtask", "render", "--size", "1e3"]).unwrap_err().to_string();
        assert!(error.contains("must be a whole number from 16 to 8192, written in digits"), "{error}");
    }
}
