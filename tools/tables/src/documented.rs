//! Tables of statistics in crate pages and guide, compared with what the code returns.

use std::{fs, path::Path};

use asperity_noise::{
    Noise, Perlin, PerlinClassic, Simplex, SparseConvolution, ValueCatmullRom, ValueGradient, ValueNoise,
    WhiteNoise,
};

/// Standard deviation and excess kurtosis of one octave in 2-D and 3-D.
fn statistics(noise: &impl Noise) -> [f32; 4] {
    let (plane, space) = (noise.statistics(2), noise.statistics(3));
    [plane.standard_deviation, plane.excess_kurtosis, space.standard_deviation, space.excess_kurtosis]
}

/// A number as the pages print it.
fn printed(x: f32, digits: usize) -> String {
    format!("{x:.digits$}").replace('-', "−")
}

/// Returns a page as one line of words, without doc comment markers.
fn page(path: &str) -> String {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let text = fs::read_to_string(root.join(path)).expect("a page");
    text.lines().map(|line| line.trim_start_matches(['/', '!', ' '])).collect::<Vec<_>>().join("\n")
}

#[test]
fn statistics_tables_of_the_docs_match_the_code() {
    let [crate_page, guide, kurtotic] = [
        "crates/noise/src/lib.rs",
        "docs/guide/noise.md",
        "crates/ndf-sampling/src/noise_distribution/kurtotic_noise.rs",
    ]
    .map(page);
    let simplex = [Simplex::new(0), Simplex::new(0).with_classic_radius()].map(|noise| statistics(&noise));
    let sparse = statistics(&SparseConvolution::new(0));
    let rows = [
        ("white", "", "", statistics(&WhiteNoise::new(0))),
        ("value, quintic", "`ValueNoise`", "value", statistics(&ValueNoise::new(0))),
        ("value, Catmull–Rom", "", "", statistics(&ValueCatmullRom::new(0))),
        ("Perlin 1985", "", "Perlin 1985", statistics(&PerlinClassic::new(0))),
        ("Perlin 2002", "`Perlin`", "Perlin 2002", statistics(&Perlin::new(0))),
        ("value-gradient, equal weights", "", "value-gradient", statistics(&ValueGradient::new(0))),
        ("simplex, r² = 0.5", "`Simplex`", "", simplex[0]),
        ("simplex, r² = 0.6", "", "", simplex[1]),
        ("sparse, one impulse", "`SparseConvolution`, one impulse a cell", "sparse convolution", sparse),
    ];
    let mut wrong = Vec::new();
    let mut must = |page: &str, row: String| {
        if !page.contains(&row) {
            wrong.push(row);
        }
    };
    // Eight octaves of gain ½ have Σ a⁴/(Σ a²)² = 0.6 of the kurtosis of one.
    let summed = |[.., kurtosis]: [f32; 4]| printed(0.6 * kurtosis, 2);
    for (in_crate, in_guide, in_kurtotic, of) in rows {
        let [plane, space] = [[of[0], of[1]], [of[2], of[3]]]
            .map(|[deviation, kurtosis]| format!("{} | {}", printed(deviation, 3), printed(kurtosis, 2)));
        must(&crate_page, format!("| {in_crate} | {plane} | {space} |"));
        if !in_guide.is_empty() {
            must(&guide, format!("| {in_guide} | {space} |"));
        }
        if !in_kurtotic.is_empty() {
            must(&kurtotic, format!("| {in_kurtotic} | {} |", summed(of)));
        }
    }
    must(&kurtotic, format!("| simplex, r² = 0.5; 0.6 | {}; {} |", summed(simplex[0]), summed(simplex[1])));
    assert!(wrong.is_empty(), "these rows are missing:\n{}", wrong.join("\n"));
}
