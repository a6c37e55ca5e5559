//! The command line of `asperity`.

pub mod bake;
pub mod filter;
pub mod fractal;
pub mod noise;
pub mod render;
pub mod shader;
mod value;

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, CommandFactory, Error, FromArgMatches, Parser, Subcommand};

use crate::cli::bake::Bake;
use crate::cli::fractal::Fractal;
use crate::cli::noise::Noise;
use crate::cli::render::Render;
use crate::cli::shader::Shader;
use crate::input::images::Images;

/// Render meshes, bake textures, and export tables of noise, normal distributions and fractal
/// functions.
#[derive(Debug, Parser)]
#[command(name = "asperity", version)]
#[command(after_help = "`asperity COMMAND --help` lists options and examples.")]
pub struct Cli {
    /// The command.
    #[command(subcommand)]
    pub command: Command,
    /// Number of threads [default: all cores].
    #[arg(long, global = true, value_name = "N", value_parser = value::whole(1, 1024))]
    pub jobs: Option<u32>,
}

impl Cli {
    /// Parses the words of a command line. A negative number is a value, which the parser of the
    /// option refuses with the range.
    ///
    /// # Errors
    ///
    /// If an argument is invalid, or if help is wanted.
    pub fn of_words(words: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> Result<Self, Error> {
        fn signed(command: clap::Command) -> clap::Command {
            let signed_values = |argument: clap::Arg| match argument.get_action().takes_values() {
                true => argument.allow_negative_numbers(true),
                false => argument,
            };
            command.mut_args(signed_values).mut_subcommands(signed)
        }
        Self::from_arg_matches(&signed(Self::command()).try_get_matches_from(words)?)
    }
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
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
    /// Write a noise to a PNG, OpenEXR or NumPy file.
    #[command(after_help = "Examples:
  asperity noise
  asperity noise --kind gaussian --octaves 1 --cells 16 --size 1024 --out bumps.exr --gradient
  asperity noise --kind cellular --output f2-f1 --octaves 1 --tileable --out cracks.png
  asperity noise --sum ridged --warp 0.5 --size 2048x1024 --out mountains.png

Several octaves have variance 1, one octave has the values of its kind. Samples are at the centers of the texels. The first row of a file has the smallest y. An .npy file has the shape (height, width);
with --gradient a last axis holds value, ∂/∂x and ∂/∂y per lattice cell.")]
    Noise(Noise),
    /// Plot a fractal interpolation function; write its values, or its surface as a mesh.
    #[command(after_help = "Examples:
  asperity fractal
  asperity fractal --knots \"0,0 1,1 2,-0.5 3,0\" --scaling 0.6,-0.4,0.5 --out ridge.svg
  asperity fractal --system takagi.json --integral 1 --over 0,0.5 --out integral.csv
  asperity fractal --knots \"0,0 1,2 2,0\" --scaling 0.4 --integral 1 --out hill.obj

Prints the domain, bounds of minimum, maximum and box dimension, and integral and mean with bounds of their errors. The y axis of a mesh
points up. An integral is smooth, so its surface has normals.")]
    Fractal(Fractal),
    /// Write functions for shaders in WGSL, WESL, GLSL, HLSL, Metal's language or SPIR-V.
    #[command(after_help = "Examples:
  asperity shader
  asperity shader kinds/perlin
  asperity shader fbm_2d/simplex --language glsl-es-300 --out noise.glsl
  asperity shader carpet --language hlsl --out carpet.hlsl
  asperity shader glint --language naga-oil

Without parts, lists them with their functions. A part includes the functions that it calls. GLSL has neither version nor main: include it in your shader.")]
    Shader(Shader),
    /// Export tables of noise CDFs, NDFs, normals and fractal interpolation functions.
    #[command(after_help = "Examples:
  asperity tables
  asperity tables --ndf ggx:0.1,0.5 --ndf painted.png --measure solid-angle
  asperity tables --normal-map bricks.png --tangent-space directx
  asperity tables --fif system.json --out my-tables
  asperity tables --check")]
    Tables(Tables),
    /// Check normalization, sampling and inverse of an NDF, and print a report.
    #[command(after_help = "Examples:
  asperity check-ndf --ndf ggx:0.1,0.5
  asperity check-ndf --ndf painted.png --measure solid-angle --seed 7")]
    CheckNdf(CheckNdf),
    /// Print the completions of a shell.
    #[cfg(feature = "program")]
    #[command(after_help = "Example:
  asperity completions bash > ~/.local/share/bash-completion/completions/asperity")]
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page.
    #[cfg(feature = "program")]
    #[command(after_help = "Example:
  asperity man > ~/.local/share/man/man1/asperity.1")]
    Man,
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
    #[arg(long, default_value_t = 0, value_parser = value::whole(0, u32::MAX))]
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
    #[arg(long, value_name = "DIR", default_value = "tables")]
    pub out: PathBuf,
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
