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
    r2_from([0.5; 2], index)
}

/// Returns the sequence with another start, shifted on the torus.
#[must_use]
pub fn r2_from(start: [f64; 2], index: u32) -> [f64; 2] {
    const G: f64 = 1.324_717_957_244_746;
    let [x, y] = start;
    [(x, 1.0 / G), (y, 1.0 / (G * G))].map(|(from, step)| (from + step * f64::from(index)).fract())
}
