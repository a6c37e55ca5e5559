//! Builds a bake plan from command-line options.

use asperity_render::image::tone::hex;

use crate::bake::plan::{LEAST_TILE, MOST_TEXELS, Part, Plan};
use crate::bake::source::Source;
use crate::bake::sources::{density, finish::Finish, fractal, material::Flat, noise};
use crate::cli::bake::{Bake, BakedFractal};
use crate::cli::noise::NoiseKind;
use crate::cli::render::Material;
use crate::failure::Result;
use crate::input::density::Density;
use crate::render::materials::{Chosen, Parameters};

/// Returns the first and the last requested part, counted from 1. A whole texture has one part.
pub(super) fn parts(wanted: &Bake) -> Result<[u32; 2]> {
    let side = wanted.parts.unwrap_or(1);
    let all = side * side;
    match wanted.part {
        Some([_, last]) if last > all => {
            Err(format!("part {last} is out of range (expected 1 to {all})").into())
        }
        part => Ok(part.unwrap_or([1, all])),
    }
}

/// Returns the plan of one part of the request.
pub(super) fn plan(wanted: &Bake, part: u32) -> Result<Plan> {
    let (size, tile) = (wanted.size, wanted.tile.min(wanted.size));
    for (name, number) in [("--size", size), ("--tile", wanted.tile)] {
        if !number.is_power_of_two() || number < LEAST_TILE {
            return Err(
                format!("`{name}` must be a power of two and at least {LEAST_TILE}, got {number}").into()
            );
        }
    }
    if wanted.samples != 1 && !wanted.samples.is_multiple_of(2) {
        return Err(format!("`--samples` must be 1 or even, got {}", wanted.samples).into());
    }
    let part = Part::numbered(part, wanted.parts.unwrap_or(1));
    if size.checked_mul(part.of).is_none_or(|whole| whole > MOST_TEXELS) {
        return Err(format!(
            "`--parts`: {} × {size} texels along a side are too many (at most {MOST_TEXELS})",
            part.of
        )
        .into());
    }
    let reach = (f64::from(wanted.occlusion.unwrap_or(0.015_625)) * f64::from(size)).round() as u32;
    let source = source(wanted)?;
    Plan { source, part, size, tile, samples: wanted.samples, reach, tileable: wanted.tileable }.checked()
}

fn source(wanted: &Bake) -> Result<Box<dyn Source>> {
    if let Some(chosen) = wanted.material {
        return of_material(wanted, chosen);
    }
    let tint = hex(wanted.tint.unwrap_or(0xb4_b0a8));
    let low = wanted.low_tint.map_or(tint, hex);
    let roughness = wanted.roughness;
    let finish = |usual: f32| Finish {
        colors: [tint, low],
        alpha: roughness.unwrap_or(usual).powi(2),
        metallic: wanted.metallic.unwrap_or(0.0),
    };
    // Tileable octaves have integer periods. Others are rotated against each other.
    let lacunarity = wanted.lacunarity.unwrap_or(if wanted.tileable { 2.0 } else { 2.17 });
    let (cells, octaves) = (wanted.cells.unwrap_or(8), wanted.octaves.unwrap_or(6));
    let (gain, height) = (wanted.gain.unwrap_or(0.5), wanted.height.unwrap_or(0.01));
    let Bake { seed, tileable, .. } = *wanted;
    if let Some(spec) = &wanted.ndf {
        used(
            wanted,
            "bumps of a density",
            &["--cells", "--octaves", "--lacunarity", "--gain", "--metallic"],
        )?;
        let Density { spec, ndf, .. } = Density::parse(spec, wanted.images)?;
        let parameters = density::Parameters { spec, ndf, cells, octaves, lacunarity, gain, seed, tileable };
        return Ok(Box::new(density::Bumps::new(parameters, finish(0.0))?));
    }
    let relief = ["--cells", "--height", "--occlusion", "--low-tint", "--metallic"];
    if let Some(BakedFractal::Periodic) = wanted.fractal {
        used(wanted, "a fractal surface", &[&relief[..], &["--scaling"]].concat())?;
        let scaling = wanted.scaling.unwrap_or(0.375);
        let parameters = fractal::Parameters { nodes: cells, scaling, height, seed };
        return Ok(Box::new(fractal::Fractal::new(parameters, finish(0.6))?));
    }
    used(wanted, "noise", &[&relief[..], &["--octaves", "--lacunarity", "--gain"]].concat())?;
    let kind = wanted.noise.unwrap_or(NoiseKind::Gaussian);
    let parameters = noise::Parameters { kind, cells, octaves, lacunarity, gain, height, seed, tileable };
    Ok(Box::new(noise::Noise::new(parameters, finish(0.6))?))
}

/// Returns an error for options that have no effect on this surface.
fn used(wanted: &Bake, surface: &str, options: &[&str]) -> Result<()> {
    let given = [
        ("--cells", wanted.cells.is_some()),
        ("--octaves", wanted.octaves.is_some()),
        ("--lacunarity", wanted.lacunarity.is_some()),
        ("--gain", wanted.gain.is_some()),
        ("--scaling", wanted.scaling.is_some()),
        ("--height", wanted.height.is_some()),
        ("--occlusion", wanted.occlusion.is_some()),
        ("--low-tint", wanted.low_tint.is_some()),
        ("--metallic", wanted.metallic.is_some()),
    ];
    match given.iter().find(|(option, given)| *given && !options.contains(option)) {
        Some((option, _)) => Err(format!("{option} has no effect on {surface}").into()),
        None => Ok(()),
    }
}

/// Builds a material of `render` as a source.
fn of_material(wanted: &Bake, material: Material) -> Result<Box<dyn Source>> {
    let name = format!("{material:?}").to_lowercase();
    if material == Material::Bumps {
        return Err("`--material bumps` is not supported: use `--ndf`".into());
    }
    let Bake { tint, roughness, seed, .. } = *wanted;
    let parameters = Parameters::chosen(material, &Chosen { tint, roughness, seed, set: &wanted.set })?;
    let values = parameters.values().clone();
    let made = parameters.make(material, 1.0, false)?;
    let relief = made.surface.height_range().is_some();
    used(wanted, &name, if relief { &["--occlusion"] } else { &[] })
        .map_err(|error| format!("{error}; see `asperity render --help-material {name}`"))?;
    if made.body.is_some() {
        return Err(format!(
            "`--material {name}` is not supported: transmissive materials have no base color"
        )
        .into());
    }
    let flat = Flat::new(name, values, made.surface, wanted.side)?;
    Ok(Box::new(flat))
}
