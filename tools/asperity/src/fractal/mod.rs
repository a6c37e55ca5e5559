//! `asperity fractal`: a fractal interpolation function as plot, values or surface.

mod curve;
mod plot;
mod surface;

use std::fmt::Write;
use std::sync::atomic::AtomicBool;

use asperity_fif::{Fif, Map};
use asperity_render::image::formats::{F64, npy};
use rayon::prelude::*;

use crate::cli::fractal::Fractal;
use crate::failure::{Interrupted, Result};
use crate::fractal::curve::Curve;
use crate::input::fif_system::{COEFFICIENTS, System};
use crate::output::{Output, split};
use crate::progress;

/// Error tolerance of a value, as a part of the range.
const TOLERANCE: f64 = 1e-13;

/// Formats of the output.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Plot,
    Csv,
    Npy,
    Surface,
}

/// Writes the file, and prints extrema, dimension and integral of the function.
pub(crate) fn fractal(wanted: &Fractal, interrupted: &AtomicBool) -> Result<()> {
    let name = wanted.out.display();
    let extension =
        wanted.out.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase);
    let (format, what) = match extension.as_deref() {
        Some("svg") => (Format::Plot, "plot"),
        Some("csv") => (Format::Csv, "values"),
        Some("npy") => (Format::Npy, "values"),
        Some("obj") => (Format::Surface, "surface"),
        _ => {
            return Err(format!(
                "function `{name}`: unsupported file extension (expected .svg, .csv, .npy or .obj)"
            )
            .into());
        }
    };
    let samples = wanted.samples.unwrap_or(if format == Format::Surface { 257 } else { 2049 }) as usize;
    if format == Format::Surface && samples > surface::MOST {
        return Err(
            format!("`--samples` must be at most {} for a surface, got {samples}", surface::MOST).into()
        );
    }
    let (folder, name) = split(&wanted.out)?;
    let system = system(wanted)?;
    let curve = match wanted.integral {
        0 => drawn(&system.fif, None::<&Fif<COEFFICIENTS>>, wanted, samples, interrupted)?,
        times => {
            let first: Fif<{ COEFFICIENTS + 1 }> = system.fif.integral(0.0)?;
            if times == 1 {
                drawn(&first, Some(&system.fif), wanted, samples, interrupted)?
            } else {
                let second: Fif<{ COEFFICIENTS + 2 }> = first.integral(0.0)?;
                drawn(&second, Some(&first), wanted, samples, interrupted)?
            }
        }
    };
    let output = Output::new(folder)?;
    match format {
        Format::Plot => output.write(&name, plot::svg(&curve).as_bytes())?,
        Format::Csv => {
            let lines = curve.points.iter().map(|[x, y]| format!("{x},{y}\n"));
            output.write(&name, ("x,f\n".to_owned() + &lines.collect::<String>()).as_bytes())?;
        }
        Format::Npy => output.write(&name, &npy(F64, &[samples, 2], &curve.points.concat()))?,
        Format::Surface => output.stream(&name, |file| surface::write(&curve, file))?,
    }
    progress::say(&format!(
        "{what} written to {} ({samples} samples, errors at most {:.0e})",
        output.place(&name),
        curve.error
    ));
    Ok(())
}

/// Returns the chosen function.
fn system(wanted: &Fractal) -> Result<System> {
    if let Some(file) = &wanted.system {
        return System::read(file);
    }
    let takagi = [[0.0, 0.0], [0.5, 0.5], [1.0, 0.0]];
    let knots = wanted.knots.as_deref().unwrap_or(&takagi);
    let (x, y): (Vec<f64>, Vec<f64>) = knots.iter().map(|&[x, y]| (x, y)).unzip();
    let maps = x.len().saturating_sub(1);
    let scaling = match wanted.scaling.as_deref() {
        None => vec![0.5; maps],
        Some(&[scaling]) => vec![scaling; maps],
        Some(each) => each.to_vec(),
    };
    let affine = Fif::<2>::affine(&x, &y, &scaling).map_err(|error| {
        error
            .to_string()
            .replace("`x`", "`--knots`")
            .replace("`y`", "`--knots`")
            .replace("`alpha`", "`--scaling`")
    })?;
    let q: Vec<[f64; COEFFICIENTS]> = affine.pieces().iter().map(|piece| padded(piece.map())).collect();
    let name =
        if wanted.knots.is_none() && wanted.scaling.is_none() { "of Takagi" } else { "through the knots" };
    Ok(System::of(name, Fif::with_ordinates(&x, &y, &scaling, &q)?))
}

fn padded(map: &Map<2>) -> [f64; COEFFICIENTS] {
    let mut q = [0.0; COEFFICIENTS];
    q[..2].copy_from_slice(&map.q);
    q
}

/// Returns a number with ten digits, without −0.
fn short(value: f64) -> String {
    let size = value.abs();
    if size < f64::MIN_POSITIVE {
        "0".into()
    } else if (1e-3..1e6).contains(&size) {
        format!("{value:.9}")
    } else {
        format!("{value:.9e}")
    }
}

/// Prints range, dimension and integral of a function, and samples it.
fn drawn<const C: usize, const D: usize>(
    f: &Fif<C>,
    slope: Option<&Fif<D>>,
    wanted: &Fractal,
    samples: usize,
    interrupted: &AtomicBool,
) -> Result<Curve> {
    let domain = f.domain();
    let [l, r] = wanted.over.unwrap_or([domain.lo, domain.hi]);
    if l < domain.lo || r > domain.hi {
        return Err(format!("`--over` must be within [{}, {}], got [{l}, {r}]", domain.lo, domain.hi).into());
    }
    let (range, dimension) = (f.range(), f.dimension());
    let extrema = f.extrema(1e-9 * (range.hi - range.lo));
    let mut said = format!("domain     [{}, {}], {} maps\n", domain.lo, domain.hi, f.pieces().len());
    let _ = writeln!(said, "minimum    {} to {}", short(extrema.minimum.lo), short(extrema.minimum.hi));
    let _ = writeln!(said, "maximum    {} to {}", short(extrema.maximum.lo), short(extrema.maximum.hi));
    let _ = writeln!(said, "dimension  {:.9} to {:.9}", dimension.lo, dimension.hi);
    let integral = f.integral_over(l, r);
    let _ = writeln!(said, "integral   {} ± {:.0e} over [{l}, {r}]", short(integral.value), integral.bound);
    if l < r {
        let mean = f.mean(l, r);
        let _ = writeln!(said, "mean       {} ± {:.0e}", short(mean.value), mean.bound);
    }
    said.lines().for_each(progress::say);
    let at = |i: usize| domain.lo + (domain.hi - domain.lo) * (i as f64 / (samples - 1) as f64);
    let tolerance = |range: asperity_fif::Interval| TOLERANCE * range.lo.abs().max(range.hi.abs());
    let least = tolerance(range);
    let values = (0..samples).into_par_iter().map(|i| {
        Interrupted::check(interrupted)?;
        Ok((at(i), f.evaluate(at(i), least)))
    });
    let values: Vec<_> = values.collect::<Result<_, Interrupted>>()?;
    let slopes = slope.map(|f| {
        let least = tolerance(f.range());
        (0..samples).into_par_iter().map(|i| f.evaluate(at(i), least).value).collect()
    });
    let knot = |x: f64| [x, f.evaluate(x, least).value];
    // The left ends of the pieces: a map takes the domain to its piece.
    let ends = f.pieces().iter().map(|piece| knot(piece.map().a * domain.lo + piece.map().b));
    Ok(Curve {
        knots: ends.chain([knot(domain.hi)]).collect(),
        points: values.iter().map(|&(x, y)| [x, y.value]).collect(),
        slopes,
        error: values.iter().map(|(_, y)| y.bound).fold(0.0, f64::max),
    })
}

#[cfg(test)]
mod tests {
    use std::fs;

    use clap::Parser;

    use super::*;
    use crate::cli::{Cli, Command};

    fn written(line: &str, name: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join(name);
        let words = ["asperity", "fractal", "--out", out.to_str().unwrap()];
        let cli =
            Cli::try_parse_from(words.into_iter().chain(line.split(' ').filter(|word| !word.is_empty())));
        let Command::Fractal(wanted) = cli.unwrap().command else { unreachable!() };
        fractal(&wanted, &AtomicBool::new(false)).unwrap();
        fs::read_to_string(out).unwrap()
    }

    #[test]
    fn default_values_are_those_of_takagi() {
        let csv = written("--samples 9", "f.csv");
        // T(k/8) = Σ 2⁻ⁿ |2ⁿ x − round(2ⁿ x)|.
        let takagi = |x: f64| {
            (0..60)
                .map(move |n| 2.0_f64.powi(-n) * (2.0_f64.powi(n) * x - (2.0_f64.powi(n) * x).round()).abs())
        };
        for (k, line) in csv.lines().skip(1).enumerate() {
            let (x, y) = line.split_once(',').unwrap();
            let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
            assert!(x == k as f64 / 8.0 && (y - takagi(x).sum::<f64>()).abs() < 1e-12, "{line}");
        }
        assert_eq!(csv.lines().count(), 10);
    }

    #[test]
    fn normals_of_a_surface_are_those_of_its_heights() {
        let obj = written("--integral 1 --samples 65", "f.obj");
        let numbers = |mark: &str| -> Vec<[f64; 3]> {
            let lines = obj.lines().filter_map(|line| line.strip_prefix(mark));
            lines
                .map(|line| {
                    line.split(' ').map(|x| x.parse().unwrap()).collect::<Vec<_>>().try_into().unwrap()
                })
                .collect()
        };
        let (points, normals) = (numbers("v "), numbers("vn "));
        assert_eq!((points.len(), normals.len()), (65 * 65, 65 * 65));
        for (row, column) in [(20, 31), (32, 32), (40, 7)] {
            let at = row * 65 + column;
            // Both ends of a central difference are on the surface.
            let apart = |step: usize| [0, 1, 2].map(|axis| points[at + step][axis] - points[at - step][axis]);
            let n = normals[at];
            for across in [apart(1), apart(65)] {
                let dot: f64 = (0..3).map(|axis| n[axis] * across[axis]).sum();
                assert!(dot.abs() < 1e-3, "{row}, {column}: {dot}");
            }
        }
    }

    #[test]
    fn plots_show_curve_and_knots() {
        let svg = written("--samples 100", "f.svg");
        assert_eq!(svg.matches("<circle").count(), 3);
        assert!(svg.contains(">0.4<") && svg.trim_end().ends_with("</svg>"), "{svg}");
    }
}
