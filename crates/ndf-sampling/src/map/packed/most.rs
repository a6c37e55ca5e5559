//! An upper bound of the density of a map over a rectangle.

use crate::map::packed::packed_map::PackedMapRef;

/// Rectangles of more cells than this, and than one in 64 of all, are not searched.
const MOST_CELLS: usize = 4096;

impl PackedMapRef<'_> {
    /// An upper bound of `D` over a rectangle of normals, from the corners of its cells; infinite
    /// for a large one.
    pub(crate) fn most(&self, sides: [[f64; 2]; 2]) -> f32 {
        let (kind, width, height) = (self.layout.kind, self.width(), self.height());
        let cells = |[from, to]: [f64; 2], n: usize| {
            // Normals are rounded.
            let at = |normal: f64| kind.cell((0.5 * (normal + 1.0)).clamp(0.0, 1.0), n);
            at(from - 1e-6)..=at(to + 1e-6)
        };
        let (columns, rows) = (cells(sides[0], width), cells(sides[1], height));
        let count = columns.clone().count() * rows.clone().count();
        if count > MOST_CELLS.max(width * height / 64) {
            return f32::INFINITY;
        }
        let (step, stride) = (kind.sides() - 1, self.layout.texel_stride());
        let mut most = 0.0_f32;
        for column in *columns.start()..=columns.end() + step {
            let texels = self.texels.get(column * stride..(column + 1) * stride).unwrap_or_default();
            let texels = texels.get(*rows.start()..=rows.end() + step).unwrap_or_default();
            most = texels.iter().fold(most, |most, &texel| most.max(texel));
        }
        // Interpolation rounds.
        (most * (1.0 + 4.0 * f32::EPSILON)).min(f32::MAX)
    }
}

#[cfg(test)]
mod tests {
    use crate::{Measure, Ndf, NdfMap, Reconstruction};
    use glam::Vec3;

    #[test]
    fn most_bounds_rectangles() {
        for kind in [Reconstruction::Constant, Reconstruction::Bilinear] {
            let hills = |n: Vec3| ((9.0 * n.x).sin() * (7.0 * n.y + 1.0).cos()).max(0.0) + 0.01;
            let map = NdfMap::from_fn(24, 17, Measure::ProjectedSolidAngle, kind, hills).unwrap();
            let mut attained = 0;
            for (i, j) in (-4..4).flat_map(|i| (-4..4).map(move |j| (f64::from(i) / 6.0, f64::from(j) / 6.0)))
            {
                let (sides, mut seen) = ([[i, i + 1.0 / 6.0], [j, j + 1.0 / 6.0]], 0.0_f32);
                let most = map.view().most(sides);
                for k in 0..400 {
                    let x = (i + f64::from(k % 20) / 114.0) as f32;
                    let y = (j + f64::from(k / 20) / 114.0) as f32;
                    let up = (1.0 - x * x - y * y).max(0.0).sqrt();
                    seen = seen.max(map.d(Vec3::new(x, y, up)));
                }
                assert!(seen <= most, "{i} {j}: {seen} above {most}");
                attained += u32::from(seen > 0.5 * most);
            }
            assert!(attained > 32, "{attained}");
        }
    }
}
