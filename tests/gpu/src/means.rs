//! The mean radiance over a surface with the exact rule on an adapter, relative to the density, and
//! with visible normals, relative to the BRDF from afar: single scattering of a dielectric, every
//! bounce of metal and glass.

use asperity_shader_tests::case::packed;
use asperity_shading::ndf_sampling::{Ggx, Ndf};
use asperity_shading::noise::gpu::FbmUniform3d;
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::reflectance::{EnergyCompensated, GgxAlbedo, GlassAlbedo};
use asperity_shading::{Brdf, CookTorrance, Dielectric, Fresnel, Schlick};
use asperity_wgsl::{Binding, Bindings, Part, compose, noise, shading};
use glam::Vec3;

use crate::compute::Kernel;
use crate::device::{self, Gpu};

static MEANS: Part = Part::new(
    "means",
    include_str!("means.wgsl"),
    &[
        &noise::GAUSSIAN_SLOPES_3D,
        &shading::LEVEL_OF_DETAIL,
        &shading::reflectance::COOK_TORRANCE_GGX,
        &shading::reflectance::SCHLICK,
        &shading::reflectance::GGX_ALBEDO,
        &shading::reflectance::GLASS_ALBEDO,
        &shading::reflectance::DIELECTRIC,
    ],
)
.with_bindings(&[Binding::Uniform { name: "means_job", of: "MeansJob" }]);

const POINTS: u32 = 1 << 21;
/// Values of each point.
const VALUES: usize = 14;
const OCTAVES: [f32; 5] = [0.5, 1.0, 1.5, 2.0, 3.0];
const ALPHA: [f32; 2] = [0.2, 0.4];
/// Reflectance of the metal at normal incidence.
const METAL: f32 = 0.9;
/// Relative index of the glass.
const ETA: f32 = 1.5;
/// The angles of view and light with the normal, in degrees, opposite each other.
const ANGLES: [[f32; 2]; 3] = [[0.0, 25.0], [60.0, 50.0], [80.0, 65.0]];

/// Prints means relative to the far field for five zooms, five half vectors and three views, the latter for single
/// scattering and for every bounce of metal and glass. Fails if one deviates by more than 1 % and four standard errors.
pub(crate) fn run(adapter: Option<&str>) -> Result<(), String> {
    let ggx = Ggx::new(ALPHA[0], ALPHA[1]).map_err(|error| error.to_string())?;
    let halves = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.2], [0.15, 0.25], [-0.2, 0.1]]
        .map(|[x, y]: [f32; 2]| Vec3::new(x, y, 1.0).normalize());
    let schlick = |f0| Schlick::new(f0).map_err(|error| error.to_string());
    let index = Dielectric::new(ETA).map_err(|error| error.to_string())?;
    let dielectric = CookTorrance::new(ggx, schlick(0.04)?);
    let metal = EnergyCompensated::metal(ggx, schlick(METAL)?);
    let glass = EnergyCompensated::glass(ggx, index);
    let pairs = ANGLES.map(|[view, light]| {
        [(view, 0.5_f32), (light, 3.5)].map(|(angle, turn)| {
            let (sin, cos) = angle.to_radians().sin_cos();
            Vec3::new(sin * turn.cos(), sin * turn.sin(), cos)
        })
    });
    let densities = halves.map(|h| ggx.d(h));
    let far =
        [&dielectric as &dyn Brdf, &metal, &glass].map(|brdf| pairs.map(|[wo, wi]| brdf.eval(wo, wi).x));
    let mut off = 0;
    for gpu in device::open(adapter)? {
        println!(
            "\n{}\n\n| octaves | mean over density at five half vectors, over the BRDF seen at 0°, 60° and 80° | the same with every bounce of metal and glass | max. deviation | max. standard error |\n|---|---|---|---|---|",
            gpu.name
        );
        for octaves in OCTAVES {
            let radiances = radiances(&gpu, &halves, &pairs, octaves)?;
            let mut row = String::new();
            let [mut deviation, mut largest] = [0.0_f64; 2];
            for (k, &far) in densities.iter().chain(far.as_flattened()).enumerate() {
                let of = || radiances.iter().skip(k).step_by(VALUES).map(|&x| f64::from(x));
                let (count, far) = (f64::from(POINTS), f64::from(far));
                let mean = of().sum::<f64>() / count;
                let variance = of().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count;
                let (ratio, error) = (mean / far, (variance / count).sqrt() / far);
                deviation = deviation.max((ratio - 1.0).abs());
                largest = largest.max(error);
                off += usize::from((ratio - 1.0).abs() > 0.01_f64.max(4.0 * error));
                row += &format!("{} {ratio:.4}", if k == 8 { " |" } else { "" });
            }
            println!("| {octaves} |{row} | {deviation:.4} | {largest:.4} |");
        }
    }
    if off == 0 { Ok(()) } else { Err(format!("{off} means deviate by more than 1 %")) }
}

fn radiances(
    gpu: &Gpu,
    halves: &[Vec3; 5],
    pairs: &[[Vec3; 2]; 3],
    octaves: f32,
) -> Result<Vec<f32>, String> {
    let spectrum = FbmSpectrum::new(2.17, 0.5, 10).map_err(|error| error.to_string())?;
    let sum = GaussianFbm::<Vec3>::new(GaussianNoise::new(7), spectrum);
    let directions = halves.iter().copied().chain([0, 1].into_iter().flat_map(|k| pairs.map(|pair| pair[k])));
    let job = directions.flat_map(|w| [w.x, w.y, w.z, 0.0]).chain(ALPHA).chain([octaves, 4096.0]);
    let mean = Schlick::new(METAL).map_err(|error| error.to_string())?.mean_reflectance_rgb().x;
    let job = job.chain([METAL, mean, ETA, 0.0]);
    let words = [
        ("gaussian_level", GaussianNoise::gpu_levels().map(f32::to_bits).collect()),
        ("fbm_uniform_3d", packed(&FbmUniform3d::array(&[sum.gpu()]))),
        ("ggx_albedo_number", GgxAlbedo::table().map(f32::to_bits).collect()),
        ("glass_albedo_number", GlassAlbedo::table().map(f32::to_bits).collect()),
        ("means_job", job.map(f32::to_bits).collect()),
    ];
    let wgsl = compose(&[&MEANS], Bindings::Textures { group: 0 });
    let kernel = Kernel::new(gpu, "means", &[&MEANS], &wgsl, "means_point")?;
    let count = POINTS as usize * VALUES;
    let words = kernel.run(gpu, &words, &[POINTS], count, [65536 / 64, POINTS / 65536])?;
    Ok(words.into_iter().map(f32::from_bits).collect())
}
