//! Low-discrepancy points for light samples.

use glam::Vec2;

/// Low-discrepancy `(uc, u, u of the light)`, for
/// [`reflected_radiance`](crate::reflected_radiance).
///
/// The points are evenly distributed in each square and in both together, and the same for every
/// call.
///
/// ```text
/// u: frac(½ + k g⁻ⁱ), i = 1 … 4,   g⁵ = g + 1
/// uc: frac(½ + k φ⁻¹),   φ² = φ + 1
/// ```
///
/// Roberts 2018, *The Unreasonable Effectiveness of Quasirandom Sequences*, in four dimensions and
/// in one. Add a random shift on the torus where neighboring pixels should differ.
///
/// ```
/// let (uc, u, _) = asperity_shading::environment::low_discrepancy_points(1).next().unwrap();
/// assert_eq!((uc, u), (0.5, asperity_shading::glam::Vec2::splat(0.5)));
/// ```
pub fn low_discrepancy_points(count: u32) -> impl Iterator<Item = (f32, Vec2, Vec2)> {
    const G: f64 = 1.167_303_978_261_418_7;
    let steps = [0.618_033_988_749_894_9, 1.0 / G, 1.0 / (G * G), 1.0 / (G * G * G), 1.0 / (G * G * G * G)];
    (0..count).map(move |k| {
        let [uc, a, b, c, d] = steps.map(|step| {
            let x = 0.5 + f64::from(k) * step;
            // Positive, so the cast is the floor; rounding to `f32` may reach 1.
            ((x - x as u64 as f64) as f32).min(1.0 - f32::EPSILON / 2.0)
        });
        (uc, Vec2::new(a, b), Vec2::new(c, d))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn low_discrepancy_points_are_even_in_every_square() {
        const SIDE: usize = 8;
        let mut counts = [[0_i32; SIDE * SIDE]; 2];
        for (_, u, by_light) in low_discrepancy_points(6400) {
            for (point, counts) in [u, by_light].into_iter().zip(&mut counts) {
                assert!((0.0..1.0).contains(&point.x) && (0.0..1.0).contains(&point.y), "{point}");
                let cell = (point * SIDE as f32).floor();
                counts[cell.y as usize * SIDE + cell.x as usize] += 1;
            }
        }
        // Random points would be off by 30.
        assert!(counts.as_flattened().iter().all(|count| (count - 100).abs() <= 12), "{counts:?}");
    }
}
