//! `asperity noise`: writes a noise on a grid of the plane.

use std::sync::atomic::AtomicBool;

use asperity_noise::{CellularOutput, FbmSpectrum, Field, Grid, Metric, Warp};
use asperity_render::image::formats::{F32, exr, npy};
use glam::Vec2;
use png::{BitDepth, ColorType, Encoder};
use rayon::prelude::*;

use crate::cli::noise::{Noise, NoiseKind, Sum};
use crate::failure::{Interrupted, Result};
use crate::fields::{Chosen, Octaves, tile_error};
use crate::output::Output;
use crate::progress;

/// Rows computed at once; points depend on it, not on the number of threads.
const SLAB: usize = 16;

/// The most values and components of gradients: 8 GiB.
const MOST_NUMBERS: u64 = 1 << 31;

/// Values and gradients, `channels` numbers for each sample, row by row.
struct Samples {
    channels: usize,
    numbers: Vec<f32>,
}

/// Formats of the output.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
    Npy,
}

/// Writes the file and prints its path.
pub(crate) fn noise(wanted: &Noise, interrupted: &AtomicBool) -> Result<()> {
    let format = format(wanted)?;
    let [width, height] = wanted.size;
    let count = u64::from(width) * u64::from(height);
    let most = MOST_NUMBERS / if wanted.gradient { 3 } else { 1 };
    if count > most {
        return Err(format!("`--size`: {count} samples are too many (at most {most})").into());
    }
    let (folder, name) = crate::output::split(&wanted.out)?;
    let output = Output::new(folder)?;
    let samples = samples(wanted, interrupted)?;
    let (low, high) = extent(&samples);
    if low == high && count > 1 {
        progress::note(
            "all samples are equal; noise is 0 at the points of its lattice and far from the origin",
        );
    }
    match format {
        Format::Png => {
            let range = wanted.range.unwrap_or([low, high]);
            output.stream(&name, |file| picture(file, [width, height], &samples.numbers, range))?;
        }
        Format::Exr => output.write(&name, &layers(&samples, [width, height])?)?,
        Format::Npy => {
            let mut shape = vec![height as usize, width as usize];
            if wanted.gradient {
                shape.push(samples.channels);
            }
            output.write(&name, &npy(F32, &shape, &samples.numbers))?;
        }
    }
    progress::say(&format!(
        "noise written to {} ({width} × {height}, values {low:.4} to {high:.4})",
        output.place(&name)
    ));
    Ok(())
}

/// Returns the format of the output file if it holds what is wanted.
fn format(wanted: &Noise) -> Result<Format> {
    let name = wanted.out.display();
    let extension =
        wanted.out.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase);
    let format = match extension.as_deref() {
        Some("png") => Format::Png,
        Some("exr") => Format::Exr,
        Some("npy") => Format::Npy,
        _ => {
            return Err(
                format!("noise `{name}`: unsupported file extension (expected .png, .exr or .npy)").into()
            );
        }
    };
    let refused = [
        (wanted.gradient && format == Format::Png, "--gradient needs .exr or .npy"),
        (wanted.range.is_some() && format != Format::Png, "--range has no effect on floats"),
        (
            (wanted.output.is_some() || wanted.metric.is_some()) && wanted.kind != NoiseKind::Cellular,
            "--output and --metric need `--kind cellular`",
        ),
        (wanted.warp.is_some() && wanted.kind == NoiseKind::White, "--warp needs a continuous kind"),
    ];
    match refused.into_iter().find(|(is, _)| *is) {
        Some((_, reason)) => Err(format!("noise `{name}`: {reason}").into()),
        None => Ok(format),
    }
}

fn samples(wanted: &Noise, interrupted: &AtomicBool) -> Result<Samples> {
    let spectrum = FbmSpectrum::new(wanted.lacunarity, wanted.gain, wanted.octaves)?;
    let periods = if wanted.tileable { Some(periods(wanted.size, wanted.cells)?) } else { None };
    let field = |seed, sum| {
        let octaves = Octaves {
            kind: wanted.kind,
            output: wanted.output.unwrap_or(CellularOutput::F1),
            metric: wanted.metric.unwrap_or(Metric::Euclidean),
            sum,
            spectrum: (wanted.octaves > 1).then_some(spectrum),
            seed,
        };
        octaves.field(periods).map_err(|error| match wanted.tileable {
            true => tile_error(&error),
            false => error,
        })
    };
    let chosen = field(wanted.seed, wanted.sum)?;
    let field: Chosen = match wanted.warp {
        Some(by) => {
            // Fields of other seeds displace the points.
            let [x, y] = [1, 2].map(|i| field(wanted.seed.wrapping_add(i), Sum::Fbm));
            Box::new(Warp::new(chosen, [x?, y?], by)?)
        }
        None => chosen,
    };
    let step = f64::from(wanted.cells) / f64::from(wanted.size[0]);
    filled(&*field, wanted.size, step, wanted.gradient, interrupted)
}

/// Returns the lattice cells along both sides, which must be whole.
fn periods([width, height]: [u32; 2], cells: u32) -> Result<[u32; 2]> {
    let product = u64::from(cells) * u64::from(height);
    match u32::try_from(product / u64::from(width)) {
        Ok(down @ 1..) if product.is_multiple_of(width.into()) => Ok([cells, down]),
        _ => Err(format!(
            "`--tileable`: {cells} cells along {width} samples are {} along {height} (must be an integer)",
            product as f64 / f64::from(width)
        )
        .into()),
    }
}

/// Evaluates the field at the centers of the texels, slab by slab.
fn filled(
    field: &(dyn Field<Vec2> + Send + Sync),
    [width, height]: [u32; 2],
    step: f64,
    gradient: bool,
    interrupted: &AtomicBool,
) -> Result<Samples> {
    let [width, height] = [width as usize, height as usize];
    let channels = if gradient { 3 } else { 1 };
    let (mut numbers, count) = (Vec::new(), width * height * channels);
    let space = numbers.try_reserve_exact(count);
    space.map_err(|_| format!("`--size`: not enough memory for {count} numbers"))?;
    numbers.resize(count, 0.0);
    let bar = progress::bar("noise");
    bar.set_length(height as u64);
    let center = |index: usize| ((index as f64 + 0.5) * step) as f32;
    let slabs: Vec<_> = numbers.chunks_mut(SLAB * width * channels).enumerate().collect();
    slabs.into_par_iter().try_for_each(|(slab, numbers)| -> Result<()> {
        Interrupted::check(interrupted)?;
        let rows = numbers.len() / (width * channels);
        let origin = Vec2::new(center(0), center(slab * SLAB));
        let grid = Grid { origin, step: Vec2::splat(step as f32), size: [width, rows] };
        if gradient {
            let [mut values, mut x, mut y] = [(); 3].map(|()| vec![0.0; width * rows]);
            field.grid_samples(&grid, &mut values, [&mut x, &mut y])?;
            for (index, numbers) in numbers.chunks_exact_mut(channels).enumerate() {
                numbers.copy_from_slice(&[values[index], x[index], y[index]]);
            }
        } else {
            field.grid_values(&grid, numbers)?;
        }
        bar.inc(rows as u64);
        Ok(())
    })?;
    bar.finish_and_clear();
    Ok(Samples { channels, numbers })
}

/// Returns the minimum and the maximum of the values.
fn extent(samples: &Samples) -> (f32, f32) {
    let values = samples.numbers.iter().step_by(samples.channels);
    values.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &value| (low.min(value), high.max(value)))
}

/// Writes 16-bit gray, black at the low end of the range and white at the high end.
fn picture(
    file: &mut impl std::io::Write,
    [width, height]: [u32; 2],
    values: &[f32],
    [low, high]: [f32; 2],
) -> Result<()> {
    let scale = 65_535.0 / (f64::from(high) - f64::from(low)).max(f64::MIN_POSITIVE);
    let gray = |&value: &f32| ((f64::from(value) - f64::from(low)) * scale).round() as u16;
    let mut encoder = Encoder::new(file, width, height);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_depth(BitDepth::Sixteen);
    let bytes: Vec<u8> = values.iter().flat_map(|value| gray(value).to_be_bytes()).collect();
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&bytes)?;
    writer.finish()?;
    Ok(())
}

/// Returns an OpenEXR file with the channels Y, dx and dy.
fn layers(samples: &Samples, [width, height]: [u32; 2]) -> Result<Vec<u8>> {
    let channel = |at: usize| samples.numbers.iter().skip(at).step_by(samples.channels).copied().collect();
    let channels = ["Y", "dx", "dy"].into_iter().take(samples.channels).enumerate();
    exr(width as usize, height as usize, channels.map(|(at, name)| (name, channel(at))))
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::cli::{Cli, Command};

    fn of(line: &str) -> Noise {
        let cli = Cli::try_parse_from(["asperity", "noise"].into_iter().chain(line.split(' '))).unwrap();
        let Command::Noise(noise) = cli.command else { unreachable!() };
        noise
    }

    #[test]
    fn samples_are_values_and_gradients_at_the_centers() {
        let noise = of("--kind simplex --octaves 1 --cells 3 --size 24x40 --seed 7 --gradient --out a.npy");
        let samples = samples(&noise, &AtomicBool::new(false)).unwrap();
        let field = asperity_noise::Simplex::new(7);
        for (row, column) in [(0_usize, 0_usize), (3, 5), (15, 23), (16, 0), (39, 23)] {
            let center = [column, row].map(|index| (index as f32 + 0.5) / 8.0);
            let expected = field.sample(Vec2::from(center));
            let at = 3 * (row * 24 + column);
            let [value, x, y] = [0, 1, 2].map(|channel| samples.numbers[at + channel]);
            let error =
                (value - expected.value).abs().max((Vec2::new(x, y) - expected.gradient).abs().max_element());
            assert!(error < 1e-5, "{row}, {column}: {error}");
        }
    }

    #[test]
    fn tileable_noise_continues_on_the_other_side() {
        const SIDE: usize = 96;
        // The largest step between neighbors in a row, and the largest from the end to the start of a row.
        let steps = |line: &str| {
            let numbers = samples(&of(line), &AtomicBool::new(false)).unwrap().numbers;
            let rows = || numbers.chunks_exact(SIDE);
            let inside = rows().flat_map(|row| row.windows(2).map(|pair| (pair[1] - pair[0]).abs()));
            let across = rows().map(|row| (row[0] - row[SIDE - 1]).abs());
            [inside.fold(0.0, f32::max), across.fold(0.0, f32::max)]
        };
        for kind in ["gaussian", "perlin", "simplex", "value", "sparse", "cellular"] {
            {
                let line = format!("--kind {kind} --cells 3 --octaves 1 --size 96 --out a.npy");
                let ([inside, across], [_, open]) = (steps(&format!("{line} --tileable")), steps(&line));
                assert!(
                    across < 1.1 * inside && open > 2.0 * inside,
                    "{kind}: {across} and {open}, inside {inside}"
                );
            }
        }
    }

    #[test]
    fn pictures_span_the_range() {
        let mut file = Vec::new();
        picture(&mut file, [3, 1], &[-1.0, 0.0, 2.0], [-1.0, 1.0]).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut gray = [0; 6];
        reader.next_frame(&mut gray).unwrap();
        assert_eq!(gray, [0, 0, 0x80, 0, 0xff, 0xff]);
    }
}
