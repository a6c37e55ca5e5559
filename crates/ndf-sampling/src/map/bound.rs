//! The largest density of a map over a rectangle.

use crate::map::cdf::Cdf;

/// Rectangles of more cells than this, and than one in 64 of all, are not looked through.
const MOST_CELLS: usize = 4096;

impl Cdf {
    /// At least the largest `D` over a rectangle of normals, by the values at the corners of its cells; infinite for a large one.
    pub(crate) fn most(&self, sides: [[f64; 2]; 2]) -> f32 {
        let kind = self.reconstruction();
        let cells = |[from, to]: [f64; 2], n: usize| {
            // Normals are rounded.
            let at = |normal: f64| kind.cell((0.5 * (normal + 1.0)).clamp(0.0, 1.0), n);
            at(from - 1e-6)..=at(to + 1e-6)
        };
        let (columns, rows) = (cells(sides[0], self.width()), cells(sides[1], self.height()));
        let count = columns.clone().count() * rows.clone().count();
        if count > MOST_CELLS.max(self.width() * self.height() / 64) {
            return f32::INFINITY;
        }
        let mut most = 0.0_f64;
        for column in columns {
            let strip = self.columns.strip(column);
            for corner in rows.clone().flat_map(|row| strip.corners(row)).flatten() {
                most = most.max(corner);
            }
        }
        ((0.25 * self.scale * most) as f32).next_up().min(f32::MAX)
    }
}

#[cfg(test)]
mod tests {
    use crate::{Measure, Ndf, NdfMap, Reconstruction};
    use glam::Vec3;

    #[test]
    fn no_normal_of_a_rectangle_is_above_its_bound() {
        for kind in [Reconstruction::Constant, Reconstruction::Bilinear] {
            let hills = |n: Vec3| ((9.0 * n.x).sin() * (7.0 * n.y + 1.0).cos()).max(0.0) + 0.01;
            let map = NdfMap::from_fn(24, 17, Measure::Normals, kind, hills).unwrap();
            let mut attained = 0;
            for (i, j) in (-4..4).flat_map(|i| (-4..4).map(move |j| (f64::from(i) / 6.0, f64::from(j) / 6.0)))
            {
                let (sides, mut seen) = ([[i, i + 1.0 / 6.0], [j, j + 1.0 / 6.0]], 0.0_f32);
                let most = map.cdf().most(sides);
                for k in 0..400 {
                    let x = (i + f64::from(k % 20) / 114.0) as f32;
                    let y = (j + f64::from(k / 20) / 114.0) as f32;
                    let up = (1.0 - x * x - y * y).max(0.0).sqrt();
                    seen = seen.max(map.density(Vec3::new(x, y, up)));
                }
                assert!(seen <= most, "{i} {j}: {seen} above {most}");
                attained += u32::from(seen > 0.5 * most);
            }
            assert!(attained > 32, "{attained}");
        }
    }
}
