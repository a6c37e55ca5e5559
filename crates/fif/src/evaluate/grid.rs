//! Values at all nodes of a uniform grid by the functional equation: one polynomial per node, no
//! address.

use crate::numeric::polynomial::{UNIT, horner};
use crate::system::error::FifError;
use crate::system::fif::{Spacing, System};
use crate::system::map::Piece;

impl<S: AsRef<[Piece<C>]>, const C: usize> System<S, C> {
    /// Evaluates `f(x_0 + (x_N − x_0) i/n)` for `i = 0, …, n`.
    ///
    /// `n + 1` is the length of `out`, and `n` a power of the number of maps. Returns the error
    /// bound of all values.
    ///
    /// ```text
    /// f((j + t)/N) = α_j f(t) + q_j(t),   t in units of the domain: N nodes of each of the grid before
    /// ```
    ///
    /// Nothing is truncated, so the bound is that of rounding alone; knots are exact. Takes 1.6 ns
    /// (affine) to 2.2 ns (quadratic) per node. The nodes are those of the grid itself, which need
    /// not be doubles. On knots that are not binary fractions, [`System::evaluate`] at the rounded
    /// node is the value at a nearby point.
    ///
    /// Cochran, Lewis, Hart 2000, eq. 3–9.
    ///
    /// ```
    /// let f = asperity_fif::cochran_2000::f()?;
    /// let mut nodes = [0.0; 9];
    /// let bound = f.grid(&mut nodes)?;
    /// assert_eq!(nodes, [0.0, 0.75, 1.0, 1.25, 1.0, 1.25, 1.0, 0.75, 0.0]);
    /// assert!(bound < 1e-13);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FifError`]. Nothing is written in this case.
    pub fn grid(&self, out: &mut [f64]) -> Result<f64, FifError> {
        if self.spacing() == Spacing::Nonuniform {
            return Err(FifError::UnequalKnots);
        }
        let (maps, found) = (self.pieces().len(), out.len());
        let cells = found.saturating_sub(1);
        let mut count = 1;
        while count < cells {
            count = count.saturating_mul(maps);
        }
        if count != cells {
            return Err(FifError::GridLength { maps, got: found });
        }
        let [first, last] = self.end_values();
        if let Some(start) = out.first_mut() {
            *start = first;
        }
        let mut count = 1;
        while count < cells {
            self.refine(out, count);
            count *= maps;
        }
        if let Some(end) = out.last_mut() {
            *end = last;
        }
        Ok(1.01 * self.gain * (self.noise + 4.0 * UNIT * self.range().magnitude()))
    }

    /// Refines from the first `count` nodes, without the last one, to `N` times as many.
    fn refine(&self, out: &mut [f64], count: usize) {
        let per = 1.0 / count as f64;
        let (before, after) = out.split_at_mut_checked(count).unwrap_or_default();
        // The nodes of the first piece replace those from which all are computed.
        for (piece, nodes) in self.pieces().iter().skip(1).zip(after.chunks_exact_mut(count)) {
            let alpha = piece.map().alpha;
            fill(piece, per, nodes, before.iter().map(|y| alpha * y));
        }
        if let Some(piece) = self.pieces().first() {
            let alpha = piece.map().alpha;
            for y in before.iter_mut() {
                *y *= alpha;
            }
            raise(piece, per, before);
        }
    }
}

/// The nodes of one piece: the scaled nodes of the whole, plus its polynomial.
#[inline(always)]
fn fill<const C: usize>(piece: &Piece<C>, per: f64, nodes: &mut [f64], scaled: impl Iterator<Item = f64>) {
    for (node, y) in nodes.iter_mut().zip(scaled) {
        *node = y;
    }
    raise(piece, per, nodes);
}

/// Adds the polynomial of the piece at `0, per, 2 per, …`; the first node is the knot itself.
#[inline(always)]
fn raise<const C: usize>(piece: &Piece<C>, per: f64, nodes: &mut [f64]) {
    const BLOCK: usize = 256;
    for (block, part) in nodes.chunks_mut(BLOCK).enumerate() {
        // Small counters, which SIMD converts.
        let start = (block * BLOCK) as f64;
        for (i, node) in (0_i32..).zip(part) {
            let s = (start + f64::from(i)) * per;
            *node += horner(&piece.local, s);
        }
    }
    if let Some(knot) = nodes.first_mut() {
        *knot = piece.y()[0];
    }
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use crate::{Fif, cochran_2000};
    use alloc::string::ToString;

    #[test]
    fn grid_equals_evaluate_at_the_nodes() {
        let g = cochran_2000::g_hat().unwrap();
        let mut nodes = [0.0; 1025];
        let bound = g.grid(&mut nodes).unwrap();
        for (i, node) in nodes.iter().enumerate() {
            let want = g.evaluate(i as f64 / 512.0, 0.0);
            assert!((node - want.value).abs() <= bound + want.bound, "node {i}: {node} {want:?}");
        }
        let fifths: [f64; 6] = core::array::from_fn(|j| j as f64);
        let f = Fif::affine(&fifths, &[0.5, 1.0, -1.0, 2.0, 0.0, 0.25], &[0.8, -0.9, 0.2, 0.7, 0.1]).unwrap();
        let mut nodes = [0.0; 3126];
        let bound = f.grid(&mut nodes).unwrap();
        for (i, node) in nodes.iter().enumerate() {
            let digits = [625, 125, 25, 5, 1].into_iter().map(|unit| i.min(3124) / unit % 5);
            let tail = core::iter::repeat(if i == 3125 { 4 } else { 0 });
            let want = f.value_at_address(digits.chain(tail), 0.0).unwrap();
            assert!((node - want.value).abs() <= bound + want.bound, "node {i}: {node} {want:?}");
        }
        assert!(bound < 3e-13, "{bound:e}");
    }

    #[test]
    fn grid_rejects_other_numbers_of_nodes() {
        let f = cochran_2000::f().unwrap();
        for len in [0, 1, 4, 6] {
            let mut nodes = alloc::vec![7.0; len];
            let message = alloc::format!("`out` must have one element more than a power of 2, got {len}");
            assert_eq!(f.grid(&mut nodes).unwrap_err().to_string(), message);
            assert!(nodes.iter().all(|&y| y == 7.0));
        }
        let mut ends = [7.0; 2];
        assert!(f.grid(&mut ends).is_ok() && ends == [0.0; 2]);
        let uneven = Fif::affine(&[0.0, 0.4, 2.0], &[0.0; 3], &[0.4, 0.5]).unwrap();
        assert_eq!(
            uneven.grid(&mut [0.0; 3]).unwrap_err().to_string(),
            "`x` must be equally spaced, got unequal knots"
        );
    }
}
