//! The tables of a fractal interpolation function: system, integrals, bounds and values.

use asperity_fif::Fif;
use asperity_render::image::formats::{F64, npy};
use serde_json::{Value, json};

use super::made::Made;
use crate::failure::Failure;
use crate::input::fif_system::{COEFFICIENTS, System};
use asperity_render::{image::Image, image::tone::ember};

/// Number of tabulated values.
const POINTS: usize = 4097;

/// Error tolerance of a value.
const TOLERANCE: f64 = 1e-13;

pub(super) fn tables(system: &System) -> Result<Made, Failure> {
    let f = &system.fif;
    let first: Fif<{ COEFFICIENTS + 1 }> = f.integral(0.0)?;
    let second: Fif<{ COEFFICIENTS + 2 }> = first.integral(0.0)?;
    let curves = [values(f), values(&first), values(&second)];
    let names = ["f", "integral", "second_integral"];
    let files = names
        .iter()
        .zip(&curves)
        .map(|(name, values)| (format!("{name}.npy"), npy(F64, &[POINTS, 2], &values.concat())))
        .collect();
    Ok(Made {
        text: format!(
            "The system with its first and second integral (each a system on the same knots), rigorous bounds of all three, \
             and their values at {POINTS} points."
        ),
        parameters: json!({
            "kind": "fractal interpolation function",
            "points": POINTS,
            "tolerance": TOLERANCE,
            "f": describe(f),
            "integral": describe(&first),
            "second_integral": describe(&second),
        }),
        files,
        picture: picture(&curves),
    })
}

fn values<const C: usize>(f: &Fif<C>) -> Vec<[f64; 2]> {
    let domain = f.domain();
    let at = |i: usize| domain.lo + domain.width() * i as f64 / (POINTS - 1) as f64;
    (0..POINTS).map(at).map(|x| [x, f.evaluate(x, TOLERANCE).value]).collect()
}

fn describe<const C: usize>(f: &Fif<C>) -> Value {
    let range = f.range();
    let mut description = System::parameters(f.pieces());
    description["encloses"] = json!([range.lo, range.hi]);
    description
}

/// Draws every curve as the span of its values per column, scaled to the image and sampled at ten
/// times the column density.
fn picture(curves: &[Vec<[f64; 2]>]) -> Image {
    const SIDE: u32 = 256;
    let mut image = Image::from_fn(SIDE, SIDE, |_, _| ember(0.0));
    for (index, curve) in curves.iter().enumerate() {
        let (low, high) =
            curve.iter().fold((f64::MAX, f64::MIN), |(low, high), &[_, y]| (low.min(y), high.max(y)));
        let row = |y: f64| {
            ((1.0 - (y - low) / (high - low).max(f64::MIN_POSITIVE)) * 0.86 + 0.07) * f64::from(SIDE)
        };
        for pair in curve.windows(2).enumerate() {
            let (i, &[[_, y0], [_, y1]]) = pair else { continue };
            let column = i * SIDE as usize / (POINTS - 1);
            let (top, bottom) = (row(y0.max(y1)) as usize, row(y0.min(y1)) as usize);
            for line in top..=bottom.max(top + 1) {
                if let Some(pixel) = image.pixels.get_mut(line * SIDE as usize + column) {
                    *pixel = ember(0.95 - 0.22 * index as f32);
                }
            }
        }
    }
    image
}
