//! Prints box dimensions and Hölder exponents for several vertical scalings and a recurrent system.
#![expect(clippy::print_stdout, reason = "an example prints its result")]

use asperity_fif::{FixedFif, RecurrentFif};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("factor  dimension  exponent");
    let (x, y) = ([0.0, 1.0, 2.0, 3.0, 4.0], [0.0, 1.0, 0.0, 1.0, 0.0]);
    for factor in [0.1, 0.25, 0.4, 0.55, 0.7, 0.85] {
        let f = FixedFif::<4, 2>::affine(&x, &y, &[factor; 4])?;
        println!("{factor:6}  {:9.4}  {:8.4}", f.dimension().middle(), 2.0 - f.dimension().middle());
    }
    // The left half copies itself with a small scaling, the right half with a large one.
    let f = RecurrentFif::affine(&x, &y, &[0.1, 0.1, 0.8, -0.8], &[[0, 2], [0, 2], [2, 4], [2, 4]])?;
    for (name, from) in [("smooth", 0.0), ("rough", 2.0)] {
        let at = |k: u32| f.evaluate(from + f64::from(k) / 512.0, 1e-9).value;
        let length: f64 = (1..=1024).map(|k| (at(k) - at(k - 1)).hypot(1.0 / 512.0)).sum();
        println!("{name} half of a recurrent function: length of 1024 steps {length:.1}");
    }
    Ok(())
}
