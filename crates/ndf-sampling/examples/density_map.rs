//! Normals with the distribution of an image, and their histogram: `cargo run --example density_map
//! [out.png [gray.png]]`.

use std::{env, error::Error, fs::File, io::BufReader};

use asperity_ndf_sampling::glam::Vec2;
use asperity_ndf_sampling::{Blend, BlinnPhong, Ggx, Measure, Ndf, NdfMap, Reconstruction, Rotated};

const SIZE: usize = 256;

fn main() -> Result<(), Box<dyn Error>> {
    let (out, image) = (env::args().nth(1).unwrap_or("target/density_map.png".into()), env::args().nth(2));
    let map = if let Some(path) = image {
        let mut reader = png::Decoder::new(BufReader::new(File::open(path)?)).read_info()?;
        let mut bytes = vec![0; reader.output_buffer_size().ok_or("an image too large")?];
        let info = reader.next_frame(&mut bytes)?;
        let step = info.line_size / info.width as usize;
        let texels: Vec<f32> = bytes.chunks(step).map(|texel| f32::from(texel[0])).collect();
        let [width, height] = [info.width, info.height].map(|n| n as usize);
        NdfMap::from_texels(width, height, &texels, Measure::ProjectedSolidAngle, Reconstruction::Bilinear)?
    } else {
        // Brushed metal on two thirds of the surface, a diffuse lobe on the rest.
        let brushed = Rotated::new(Ggx::new(0.1, 0.5)?, 0.6)?;
        let blend = Blend::new(brushed, BlinnPhong::new(0.0)?, 2.0 / 3.0)?;
        NdfMap::from_fn(SIZE, SIZE, Measure::ProjectedSolidAngle, Reconstruction::Bilinear, |m| blend.d(m))?
    };
    // Each texel receives normals in proportion to its density.
    let mut counts = vec![0_u32; SIZE * SIZE];
    for k in 0..4_000_000_u32 {
        let u = Vec2::from([0.754_877_666, 0.569_840_291].map(|a| (a * f64::from(k)).fract() as f32));
        let m = map.sample(u) * 0.5 + 0.5;
        let [x, y] = [m.x, m.y].map(|c| ((c * SIZE as f32) as usize).min(SIZE - 1));
        counts[y * SIZE + x] += 1;
    }
    let pixels: Vec<u8> = counts.iter().map(|&n| (28.0 * (n as f32).ln_1p()) as u8).collect();
    let mut encoder = png::Encoder::new(File::create(out)?, SIZE as u32, SIZE as u32);
    encoder.set_color(png::ColorType::Grayscale);
    Ok(encoder.write_header()?.write_image_data(&pixels)?)
}
