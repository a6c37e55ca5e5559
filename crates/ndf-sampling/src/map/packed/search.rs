//! Rare cases of samples of a packed map: rows that the quantiles miss, and positions beyond the
//! rim.

use crate::map::packed::grid::Grid;
use crate::map::packed::packed_map::PackedMapRef;
use asperity_core::math;

impl PackedMapRef<'_> {
    /// The last row that begins at or below `target` and has weight, and the target clamped to it.
    #[cold]
    #[inline(never)]
    pub(crate) fn search<const SIDES: usize>(
        &self,
        column: u32,
        t: f32,
        target: f32,
        from: u32,
    ) -> (u32, f32) {
        let sum = self.sums::<SIDES>(column, t);
        let rows = self.grid.last_row + 1;
        let [bottom, top] = [sum(0), sum(rows)];
        let reaches =
            |line: u32| if target >= top { sum(line) >= top } else { sum(line) > target.max(bottom) };
        // With growing steps, then by bisection. Line 0 is not past the target, the last line is.
        let (mut low, mut high, mut step) = (0, rows, 2);
        // Not `clamp`, which contains a panic where compilers do not see the order of its bounds.
        let mut line = from.max(1).min(rows);
        if reaches(line) {
            while line > 0 && reaches(line) {
                (high, line, step) = (line, line.saturating_sub(step), 2 * step);
            }
            low = line;
        } else {
            while line < rows && !reaches(line) {
                (low, line, step) = (line, (line + step).min(rows), 2 * step);
            }
            high = line;
        }
        while high - low > 1 {
            let middle = low.midpoint(high);
            if reaches(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        (low, target.min(sum(low + 1).next_down()).max(sum(low)))
    }

    /// Moves `y` to the end of the chord if it is beyond, or to the next position with weight.
    #[cold]
    #[inline(never)]
    pub(crate) fn inside<const SIDES: usize>(&self, column: u32, t: f32, [x, y]: [f32; 2]) -> f32 {
        if x * x + y * y <= 1.0 - 4.0 * f32::EPSILON {
            return y;
        }
        let Grid { density, size, origin, last_row, margin, .. } = self.grid;
        let chord = math::sqrt((1.0 - x * x).max(0.0)) * (1.0 - 4.0 * f32::EPSILON);
        let on_chord = |y: f32| y.max(-chord).min(chord);
        let end = on_chord(y);
        let sum = self.sums::<SIDES>(column, t);
        let has_weight = |row: &u32| sum(*row) < sum(*row + 1);
        let row_at = |y: f32| ((y * density[1] + origin[1]) as u32).min(last_row);
        let mut rows = row_at(-chord)..=row_at(chord);
        let nearest = if y < 0.0 { rows.find(has_weight) } else { rows.rfind(has_weight) };
        match nearest {
            Some(row) if row != row_at(end) => {
                let within = if y < 0.0 { margin } else { 1.0 - margin };
                on_chord((row as f32 - origin[1] + within) * size[1])
            }
            _ => end,
        }
    }

    /// The integral up to each line at the position `t` of a column.
    fn sums<const SIDES: usize>(&self, column: u32, t: f32) -> impl Fn(u32) -> f32 {
        let stride = self.grid.stride as usize;
        let side = |side: usize| self.nodes.get(side * stride..(side + 1) * stride).unwrap_or_default();
        let (left, right) = (side(column as usize), side(column as usize + SIDES - 1));
        move |line| {
            let line = SIDES * line as usize;
            match (left.get(line), right.get(line)) {
                (Some(left), Some(_)) if SIDES == 1 => *left,
                (Some(left), Some(right)) => (1.0 - t) * left + t * right,
                _ => f32::MAX,
            }
        }
    }
}
