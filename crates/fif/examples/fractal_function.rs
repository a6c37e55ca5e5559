//! A fractal function from knots and vertical scalings: value, integral, dimension, a plot, and a
//! ray that hits a surface of it: `cargo run --example fractal_function [path]`.
#![expect(clippy::print_stdout, reason = "an example prints its result")]

use asperity_fif::{Fif, HeightField, Intersect, Ray, glam::DVec3};

/// Side of the plot in pixels.
const SIZE: usize = 512;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (x, y) = ([0.0, 1.0, 2.0, 3.0, 4.0], [0.0, 1.0, 0.0, 1.0, 0.0]);
    let f = Fif::affine(&x, &y, &[0.6, -0.5, 0.6, -0.5])?;
    let integral: Fif<3> = f.integral(0.0)?;

    let (value, area) = (f.evaluate(1.3, 1e-9), f.integral_over(0.0, 4.0));
    println!("f(1.3)    = {value:.9}");
    println!("∫ f dx    = {:.9} ± {:e}", area.value, area.bound);
    println!("dimension = {:.4}", f.dimension().middle());
    assert_eq!(f.evaluate(3.0, 0.0).value, 1.0);
    assert!((integral.evaluate(4.0, 1e-9).value - area.value).abs() < 1e-8);

    // The product of two integrals is a surface with exact normals.
    let surface = HeightField::new(integral.clone(), integral);
    let ray = Ray { origin: DVec3::new(0.5, 0.5, 8.0), direction: DVec3::new(0.4, 0.3, -1.0) };
    let hit = surface.intersect(&ray).ok_or("the ray misses")?;
    println!("hit       = ({:.6}, {:.6}, {:.6}), certain: {}", hit.x, hit.y, hit.height, hit.certain);
    assert!((ray.at(hit.t).z - hit.height).abs() < 1e-9 && hit.normal.is_some());

    // A column of the plot goes from the minimum to the maximum over its interval.
    let (range, step) = (f.range(), 4.0 / SIZE as f64);
    let row = |value: f64| (((range.hi - value) / range.width() * SIZE as f64) as usize).min(SIZE - 1);
    let mut pixels = vec![255_u8; SIZE * SIZE];
    for k in 0..SIZE {
        let over = f.extrema_over(k as f64 * step, (k + 1) as f64 * step, 1e-3).ok_or("outside")?;
        for j in row(over.maximum.middle())..=row(over.minimum.middle()) {
            pixels[j * SIZE + k] = 0;
        }
    }
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/fractal_function.png".into());
    let mut png = png::Encoder::new(std::fs::File::create(&path)?, SIZE as u32, SIZE as u32);
    png.set_color(png::ColorType::Grayscale);
    png.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
