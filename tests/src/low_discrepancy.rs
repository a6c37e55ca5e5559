//! Low-discrepancy sequences: points that fill the square evenly.

/// Returns point `index` of Roberts's R₂ sequence, in [0, 1)².
///
/// ```text
/// frac(½ + index · (1/g, 1/g²)),   g³ = g + 1
/// ```
///
/// Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences".
#[must_use]
pub fn r2(index: u32) -> [f64; 2] {
    const G: f64 = 1.324_717_957_244_746;
    [1.0 / G, 1.0 / (G * G)].map(|step| (0.5 + step * f64::from(index)).fract())
}
