//! A microfacet BRDF whose distribution of normals is an image: `cargo run --example
//! painted_density [gray.png]`.
#![expect(clippy::print_stdout, reason = "an example prints its result")]

use asperity_shading::environment::low_discrepancy_points;
use asperity_shading::glam::Vec3;
use asperity_shading::ndf_sampling::{Masked, Measure, NdfMap, Reconstruction};
use asperity_shading::{Brdf, CookTorrance};

/// Width, height and texels of an 8-bit image; two painted lobes without a path.
fn image(path: Option<String>) -> Result<([usize; 2], Vec<f32>), Box<dyn std::error::Error>> {
    let Some(path) = path else {
        let lobe = |x: f32, y: f32| f32::exp(-80.0 * (x * x + y * y));
        let texel = |k: usize| {
            let [x, y] = [k % 64, k / 64].map(|i| (i as f32 + 0.5) / 32.0 - 1.0);
            lobe(x - 0.3, y) + lobe(x + 0.3, y)
        };
        return Ok(([64; 2], (0..64 * 64).map(texel).collect()));
    };
    let file = std::io::BufReader::new(std::fs::File::open(path)?);
    let mut reader = png::Decoder::new(file).read_info()?;
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("image too large")?];
    let info = reader.next_frame(&mut bytes)?;
    let step = info.line_size / info.width as usize;
    let texels = bytes.chunks(step).map(|texel| f32::from(texel[0])).collect();
    Ok(([info.width as usize, info.height as usize], texels))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ([width, height], texels) = image(std::env::args().nth(1))?;
    let (measure, kind) = (Measure::ProjectedSolidAngle, Reconstruction::Bilinear);
    let painted = NdfMap::from_texels(width, height, &texels, measure, kind)?;
    let brdf = CookTorrance::new(Masked::new(painted), Vec3::new(0.95, 0.64, 0.54));

    // The mean of the weights is the albedo.
    let wo = Vec3::new(0.6, 0.0, 0.8);
    let weight = |(uc, u, _)| brdf.sample(wo, uc, u).map_or(Vec3::ZERO, |sample| sample.weight());
    let albedo = low_discrepancy_points(4096).map(weight).sum::<Vec3>() / 4096.0;
    println!("albedo: {albedo}");
    assert!(albedo.max_element() <= 1.0 && albedo.min_element() > 0.3);
    Ok(())
}
