//! Growth of cost: the crates' benches named `growth`, as a table with slopes and one chart per crate.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value;

use super::table::table;
use crate::failure::Failure;
use crate::gallery::plot::{Axis, Names, Plot, Stroke};

/// First word of the groups' names; the crate and the quantity follow.
pub(crate) const GROUP: &str = "growth";

/// Times of one call against one quantity.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curve {
    /// The crate's name without its prefix.
    of: String,
    quantity: String,
    name: String,
    /// The quantity and the median of nanoseconds per call, by the quantity.
    points: Vec<[f64; 2]>,
}

impl Curve {
    /// The exponent of the power law that fits best: that of least squares of logarithms.
    fn slope(&self) -> f64 {
        let logs = || self.points.iter().map(|point| point.map(f64::ln));
        let count = self.points.len() as f64;
        let [x, y] = [0, 1].map(|axis| logs().map(|log| log[axis]).sum::<f64>() / count);
        let product: f64 = logs().map(|log| (log[0] - x) * (log[1] - y)).sum();
        product / logs().map(|log| (log[0] - x).powi(2)).sum::<f64>()
    }
}

/// The curves that criterion has left in its folder.
pub(crate) fn read(folder: &Path) -> Result<Vec<Curve>, Failure> {
    let mut curves: BTreeMap<[String; 3], Vec<[f64; 2]>> = BTreeMap::new();
    let pattern = |entry: &std::fs::DirEntry| entry.file_name().to_string_lossy().starts_with(GROUP);
    for group in std::fs::read_dir(folder)?.filter_map(Result::ok).filter(pattern) {
        for place in below(&group.path(), 2)? {
            let of = |name: &str| -> Result<Value, Failure> {
                let path = place.join("new").join(name);
                let text = std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
                Ok(serde_json::from_slice(&text).map_err(|error| format!("{}: {error}", path.display()))?)
            };
            let (bench, estimates) = (of("benchmark.json")?, of("estimates.json")?);
            let word = |key: &str| bench[key].as_str().unwrap_or_default().to_owned();
            let group = word("group_id");
            let mut parts = group.splitn(3, '/').skip(1).map(str::to_owned);
            let (Some(of), Some(quantity)) = (parts.next(), parts.next()) else { continue };
            let (amount, time) = (word("value_str").parse(), estimates["median"]["point_estimate"].as_f64());
            let (Ok(amount), Some(time)) = (amount, time) else {
                return Err(format!("{}: not a time of a number of something", place.display()).into());
            };
            curves.entry([of, quantity, word("function_id")]).or_default().push([amount, time]);
        }
    }
    let curve = |([of, quantity, name], mut points): ([String; 3], Vec<[f64; 2]>)| {
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Curve { of, quantity, name, points }
    };
    Ok(curves.into_iter().map(curve).collect())
}

/// Folders this many levels below one, but criterion's reports.
fn below(folder: &Path, levels: u32) -> Result<Vec<std::path::PathBuf>, Failure> {
    if levels == 0 {
        return Ok(vec![folder.to_owned()]);
    }
    let mut all = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() && path.file_name().is_none_or(|name| name != "report") {
            all.extend(below(&path, levels - 1)?);
        }
    }
    Ok(all)
}

/// The crates that have curves.
pub(crate) fn crates(curves: &[Curve]) -> Vec<&str> {
    let mut all: Vec<&str> = curves.iter().map(|curve| curve.of.as_str()).collect();
    all.dedup();
    all
}

/// The whole page; each crate's chart is beside it, as `growth-<crate>.svg`.
pub(crate) fn markdown(machine: &[String], curves: &[Curve]) -> String {
    let mut text = format!(
        "# What things cost\n\n\
         - What is wanted and what is, row by row, and where the trials stand: [wanted](wanted.md).\n\
         - Beside other libraries: [noise](peers.md), [maps and densities](ndf.md), [rays](rays.md).\n\
         - Alone: [pixels, materials and textures](shading.md), [fractal functions](fif.md); `cargo bench` in any crate for the rest.\n\
         - How cost grows: below, by `cargo xtask bench --growth --ship`. Medians by criterion, one thread. The slope is the exponent \
         of the power of the quantity that the cost follows best: 0 where it costs nothing, 1 where twice as much takes twice as long.\n\n\
         {}\n",
        machine.iter().map(|fact| format!("- {fact}\n")).collect::<String>()
    );
    for name in crates(curves) {
        text += &format!(
            "\n## `asperity-{name}`\n\n![Nanoseconds per call against quantities, both by powers](growth-{name}.svg)\n"
        );
        for group in curves.chunk_by(|a, b| (&a.of, &a.quantity) == (&b.of, &b.quantity)) {
            if group[0].of == name {
                text += &quantity_table(group);
            }
        }
    }
    text
}

/// A line for each curve of one quantity, with its slope.
fn quantity_table(curves: &[Curve]) -> String {
    let mut amounts: Vec<f64> = curves.iter().flat_map(|curve| &curve.points).map(|point| point[0]).collect();
    amounts.sort_by(f64::total_cmp);
    amounts.dedup();
    let head = [format!("nanoseconds, by {}", curves[0].quantity)];
    let head = head.into_iter().chain(amounts.iter().map(|&n| amount(n))).chain(["slope".to_owned()]);
    let mut lines = vec![head.collect::<Vec<_>>()];
    lines.extend(curves.iter().map(|curve| {
        let times = amounts.iter().map(|&n| {
            let found = curve.points.iter().find(|point| point[0] == n);
            found.map_or_else(String::new, |point| digits(point[1]))
        });
        let slope = format!("{:.2}", curve.slope());
        [curve.name.clone()].into_iter().chain(times).chain([slope]).collect()
    }));
    format!("\n{}", table(&lines))
}

/// Three digits, or as many as it has before the point.
fn digits(time: f64) -> String {
    let decimals = [10.0, 100.0].into_iter().filter(|&limit| time < limit).count();
    format!("{time:.decimals$}")
}

/// A count as one, or as a power of ten where it has many digits.
fn amount(n: f64) -> String {
    if n < 1e7 { n.to_string() } else { format!("{n:e}").replace("1e", "10^") }
}

/// One crate's curves on logarithmic scales, as a picture that stands alone.
pub(crate) fn svg(name: &str, curves: &[Curve]) -> Result<String, Failure> {
    let curves: Vec<_> = curves.iter().filter(|curve| curve.of == name).collect();
    let range = |axis: usize| {
        let all = || curves.iter().flat_map(|curve| &curve.points).map(move |point| point[axis]);
        [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)]
    };
    let [from, to] = range(0);
    let [low, high] = range(1).map(f64::log10);
    let mut quantities: Vec<_> = curves.iter().map(|curve| curve.quantity.as_str()).collect();
    quantities.dedup();
    let decades: Vec<_> = (0..=15).map(|k| (10_f64.powi(k), label(k))).collect();
    let ticks: Vec<_> = decades.iter().map(|(value, text)| (*value, text.as_str())).collect();
    let within = |[least, most]: [f64; 2]| -> Vec<_> {
        ticks.iter().copied().filter(|tick| (least..=most).contains(&tick.0)).collect()
    };
    let x = Axis::log2(&quantities.join("; "), [from, to]).with_ticks(&within([from, to]));
    let y_range = [10_f64.powf(low.floor()), 10_f64.powf(high.ceil())];
    let y = Axis::log2("nanoseconds per call", y_range).with_ticks(&within(y_range));
    let mut plot = Plot::new([900.0, 480.0], x, y, Names::Above);
    for (series, curve) in (1..).zip(&curves) {
        let stroke = if series > 4 { Stroke::dashed(series - 4) } else { Stroke::solid(series) };
        let of = if quantities.len() > 1 { format!(", by {}", curve.quantity) } else { String::new() };
        plot = plot.curve(format!("{}{of}: {:.2}", curve.name, curve.slope()), curve.points.clone(), stroke);
    }
    plot.svg(&format!("How the cost of asperity-{name} grows"))
}

/// A power of ten in few letters.
fn label(k: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    if k < 4 {
        return 10_i32.pow(k.unsigned_abs()).to_string();
    }
    let digits = k.to_string().bytes().map(|digit| DIGITS[usize::from(digit - b'0')]).collect::<String>();
    format!("10{digits}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn left(folder: &Path, value: &str, time: f64) {
        let place = folder.join("growth_noise_octaves/a sum").join(value).join("new");
        std::fs::create_dir_all(&place).unwrap();
        let bench = serde_json::json!({
            "group_id": "growth/noise/octaves", "function_id": "a sum", "value_str": value
        });
        std::fs::write(place.join("benchmark.json"), bench.to_string()).unwrap();
        let estimates = serde_json::json!({ "median": { "point_estimate": time } });
        std::fs::write(place.join("estimates.json"), estimates.to_string()).unwrap();
    }

    #[test]
    fn what_criterion_leaves_becomes_a_page() {
        let scratch = tempfile::tempdir().unwrap();
        for (value, time) in [("4", 160.0), ("1", 10.0), ("16", 2560.0)] {
            left(scratch.path(), value, time);
        }
        std::fs::create_dir_all(scratch.path().join("growth_noise_octaves/report")).unwrap();
        std::fs::create_dir_all(scratch.path().join("other/report")).unwrap();
        let curves = read(scratch.path()).unwrap();
        assert_eq!(curves[0].points, [[1.0, 10.0], [4.0, 160.0], [16.0, 2560.0]]);
        let text = markdown(&["Processor: one".to_owned()], &curves);
        assert!(text.contains("- Processor: one") && text.contains("growth-noise.svg"), "{text}");
        let line = text.lines().find(|line| line.contains("a sum")).unwrap();
        assert!(line.contains(" 2560 ") && line.trim_end().ends_with("2.00 |"), "{text}");
        let svg = svg("noise", &curves).unwrap();
        assert!(svg.contains("a sum: 2.00") && svg.contains("prefers-color-scheme: dark"), "{svg}");
        left(scratch.path(), "many", 1.0);
        assert!(read(scratch.path()).unwrap_err().to_string().contains("many"));
    }
}
