//! Options of `render`.

use std::path::PathBuf;

use asperity_render::{geometry::mesh_file::Up, materials::field::NoiseKind, scenes::Set};
use asperity_shading::LevelOfDetail;
use clap::{Args, ValueEnum};

use crate::cli::value::{
    assignment, color, degrees, field_of_view, numbers, point, positive, share, turned, whole,
};
use crate::input::images::Images;
use crate::input::words::{Words, one_of};
use crate::quality::Quality;

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
    #[arg(long, default_value_t = 1, value_parser = whole(0, u32::MAX))]
    pub seed: u32,
    /// Output file; its extension selects the format: .png, .jpg, .webp or .exr. With --frames, `#`
    /// characters in the name are replaced by the frame number.
    #[arg(long, value_name = "FILE", default_value = "render.png")]
    pub out: PathBuf,
    /// Number of frames: an orbit around the subject, or a zoom with --zoom-to.
    #[arg(long, value_name = "N", value_parser = whole(1, 1_000_000))]
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
