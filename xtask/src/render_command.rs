//! `cargo xtask render`: one picture of one object with chosen parameters.

use std::sync::atomic::AtomicBool;

use asperity_shading::LevelOfDetail;

use crate::{
    cli::{Noise, Render, Rule, Scene},
    densities::{Density, NORMAL_MAP},
    figure::Failure,
    image::hex,
    output::Output,
    progress,
    scene::{
        field::NoiseKind,
        material::Facets,
        mesh::TracedMesh,
        mesh_file,
        render::Sampling,
        request::{Bumps, RenderRequest, Subject},
        shape::Shape,
    },
};

/// Draws what was asked for and tells where it lies.
pub(crate) fn render(wanted: &Render, interrupted: &AtomicBool) -> Result<(), Failure> {
    let spec = match &wanted.normal_map {
        Some(file) => format!("{NORMAL_MAP}{}", file.display()),
        None => wanted.ndf.clone(),
    };
    let density = Density::parse(&spec, wanted.images)?;
    let path = std::path::absolute(&wanted.out)?;
    let name = path.file_name().map(|name| name.to_string_lossy());
    let (Some(folder), Some(name), false) = (path.parent(), name, path.is_dir()) else {
        return Err(format!("`{}` is a folder; name a file in it", wanted.out.display()).into());
    };
    let mesh = match &wanted.mesh {
        Some(file) => {
            let named = |error| Failure::from(format!("mesh `{}`: {error}", file.display()));
            Some(TracedMesh::new(mesh_file::open(file, wanted.up).map_err(named)?))
        }
        None => None,
    };
    let output = Output::new(folder)?;
    let subject = match wanted.scene {
        Scene::Teapot => Subject::Teapot,
        Scene::Sphere => Subject::Sphere,
        Scene::Plane => Subject::Plane,
    };
    let kind = match wanted.noise {
        Noise::Gaussian => NoiseKind::Gaussian,
        Noise::Perlin => NoiseKind::Perlin2002,
        Noise::Simplex => NoiseKind::Simplex,
    };
    let rule = match wanted.rule {
        Rule::Exact => LevelOfDetail::Exact,
        Rule::Fractal => LevelOfDetail::Fractal,
    };
    let sampling = Sampling {
        width: wanted.size,
        height: wanted.size,
        samples_per_pixel: wanted.spp,
        seed: wanted.seed,
    };
    let mut request = match &mesh {
        Some(mesh) => RenderRequest::of_mesh(mesh, density.ndf(), sampling),
        None => RenderRequest::new(subject, density.ndf(), sampling),
    };
    request.facets = Facets::Consistent(rule);
    request.zoom = wanted.zoom;
    request.bumps = Bumps {
        kind,
        octaves: wanted.octaves,
        frequency: wanted.frequency.unwrap_or(request.bumps.frequency),
        gain: wanted.gain.unwrap_or(request.bumps.gain),
    };
    request.tint = hex(wanted.tint);
    request.exposure = wanted.exposure;
    let bar = progress::bar("render");
    let shape = mesh.map_or_else(|| RenderRequest::shape(subject), Shape::Mesh);
    let image = request.draw(&shape, &bar, interrupted);
    bar.finish_and_clear();
    output.write(&name, &image?.png()?)?;
    progress::say(&format!("the picture: {}", path.display()));
    Ok(())
}
