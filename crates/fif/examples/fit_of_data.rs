//! Fits a fractal function to noisy data with fewer and fewer knots, and prints the error and the
//! roughness.
#![expect(clippy::print_stdout, reason = "an example prints its result")]

use asperity_fif::{box_dimension, fit};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The profile of a mountain: a random walk of 257 heights.
    let mut state = 7_u32;
    let mut height = 0.0;
    let (x, y): (Vec<f64>, Vec<f64>) = (0..=256)
        .map(|k| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            height += f64::from(state >> 8) / f64::from(1 << 24) - 0.5;
            (f64::from(k), height)
        })
        .unzip();
    let dimension = |y: &[f64]| box_dimension(y, y.len()).map_or(f64::NAN, |measured| measured.value);
    println!("box dimension of the data: {:.3}", dimension(&y));
    println!("maps   maximum error  rms error  collage bound  box dimension");
    for spacing in [2, 4, 8, 16, 32] {
        let knots: Vec<usize> = (0..=256).step_by(spacing).collect();
        let fit = fit::affine(&x, &y, &knots)?;
        let values: Vec<f64> = x.iter().map(|&x| fit.system.evaluate(x, 1e-9).value).collect();
        let (maps, rough) = (knots.len() - 1, dimension(&values));
        println!("{maps:4}  {:14.3}  {:9.3}  {:13.3}  {rough:13.3}", fit.error, fit.rms, fit.bound);
    }
    Ok(())
}
