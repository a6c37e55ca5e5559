//! The plan that a command line asks for.

use asperity_render::image::tone::hex;

use crate::bake::plan::{LEAST_TILE, Plan};
use crate::bake::source::Source;
use crate::bake::sources::{density, finish::Finish, fractal, material::Flat, noise};
use crate::cli::{Bake, BakedFractal, BakedNoise, Material};
use crate::failure::Result;
use crate::input::density::Density;
use crate::render::materials::{Chosen, Parameters};

/// The plan of a command line.
pub(super) fn plan(wanted: &Bake) -> Result<Plan> {
    let (size, tile) = (wanted.size, wanted.tile.min(wanted.size));
    for (name, number) in [("--size", size), ("--tile", wanted.tile)] {
        if !number.is_power_of_two() || number < LEAST_TILE {
            return Err(format!("`{name}` must be a power of two from {LEAST_TILE} on, got {number}").into());
        }
    }
    if wanted.samples != 1 && !wanted.samples.is_multiple_of(2) {
        return Err(format!("`--samples` must be 1 or even, got {}", wanted.samples).into());
    }
    let reach = (f64::from(wanted.occlusion) * f64::from(size)).round() as u32;
    let source = source(wanted)?;
    Plan { source, size, tile, samples: wanted.samples, reach, tileable: wanted.tileable }.checked()
}

fn source(wanted: &Bake) -> Result<Box<dyn Source>> {
    if let Some(chosen) = wanted.material {
        return of_material(wanted, chosen);
    }
    let tint = hex(wanted.tint.unwrap_or(0xb4_b0a8));
    let low = wanted.low_tint.map_or(tint, hex);
    let roughness = wanted.roughness;
    let finish = |usual: f32| Finish {
        colours: [tint, low],
        alpha: roughness.unwrap_or(usual).powi(2),
        metallic: wanted.metallic,
    };
    // Octaves that tile have whole periods; those that need not are turned against one another.
    let lacunarity = wanted.lacunarity.unwrap_or(if wanted.tileable { 2.0 } else { 2.17 });
    let Bake { cells, octaves, gain, height, seed, tileable, .. } = *wanted;
    if let Some(spec) = &wanted.ndf {
        if wanted.low_tint.is_some() {
            return Err("`--low-tint` is of heights, and bumps of a density have none".into());
        }
        let Density { spec, ndf, .. } = Density::parse(spec, wanted.images)?;
        let parameters = density::Parameters { spec, ndf, cells, octaves, lacunarity, gain, seed, tileable };
        return Ok(Box::new(density::Bumps::new(parameters, finish(0.0))?));
    }
    if let Some(BakedFractal::Torus) = wanted.fractal {
        let parameters = fractal::Parameters { nodes: cells, factor: wanted.factor, height, seed };
        return Ok(Box::new(fractal::Fractal::new(parameters, finish(0.6))?));
    }
    let kind = wanted.noise.unwrap_or(BakedNoise::Gaussian);
    let parameters = noise::Parameters { kind, cells, octaves, lacunarity, gain, height, seed, tileable };
    Ok(Box::new(noise::Noise::new(parameters, finish(0.6))?))
}

/// A material of `render`.
fn of_material(wanted: &Bake, material: Material) -> Result<Box<dyn Source>> {
    let name = format!("{material:?}").to_lowercase();
    if material == Material::Bumps {
        return Err("bumps are baked by `--ndf`".into());
    }
    let idle = [("--low-tint", wanted.low_tint.is_some()), ("--lacunarity", wanted.lacunarity.is_some())];
    if let Some((option, _)) = idle.iter().find(|(_, given)| *given) {
        return Err(format!(
            "{option} would change nothing of {name}; see `cargo xtask render --help-material {name}`"
        )
        .into());
    }
    let Bake { tint, roughness, seed, .. } = *wanted;
    let parameters = Parameters::chosen(material, &Chosen { tint, roughness, seed, set: &wanted.set })?;
    let values = parameters.values().clone();
    let made = parameters.make(material, 1.0, false)?;
    if made.body.is_some() {
        return Err(format!("{name} is no surface that has a base colour: light goes through it").into());
    }
    let flat = Flat::new(name, values, made.surface, wanted.side)?;
    Ok(Box::new(flat))
}
