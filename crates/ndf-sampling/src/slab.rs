//! A piece of the marginal on which it has one formula, and its exact inverse.

use crate::disk::{half_area, half_chord};

/// What a sample leaves on either side of it in a curved piece.
///
/// Where the piece's marginal vanishes at an end, as at the two ends of the disk, the conditional's support would otherwise
/// shrink to a point, and `u₂` could not be found again. With it the support keeps a length of about 10⁻⁸.
const LEAST_MASS: f64 = 1e-13;

/// A piece of x on which `m(x) = flat + curved · c(x)`, `c` half the chord.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slab {
    /// Where it begins.
    pub(crate) x: f64,
    /// `M` there.
    pub(crate) cumulative: f64,
    /// The part of `m` that does not depend on x.
    pub(crate) flat: f64,
    /// What `m` grows with the half chord: the density at its two ends together.
    pub(crate) curved: f64,
}

impl Slab {
    /// `∫ m` from `from` to `to`, both in this piece.
    pub(crate) fn mass(self, from: f64, to: f64) -> f64 {
        let curved = if self.curved > 0.0 { self.curved * half_area(from, to) } else { 0.0 };
        (self.flat * (to - from) + curved).max(0.0)
    }

    /// `M⁻¹(u)` for `u` between this piece's beginning and that of the next.
    pub(crate) fn inverse(self, u: f64, next: Self) -> f64 {
        let (mut low, mut high) = (self.x, next.x.next_down());
        let all = next.cumulative - self.cumulative;
        let mass = u - self.cumulative;
        if self.curved > 0.0 {
            let least = LEAST_MASS.min(0.5 * all);
            let mass = mass.clamp(least, all - least);
            let mut x = self.x + (next.x - self.x) * (mass / all);
            // Newton's steps, halving where they leave the bracket: m may vanish at an end.
            for _ in 0..64 {
                let excess = self.mass(self.x, x) - mass;
                if excess > 0.0 {
                    high = x;
                } else {
                    low = x;
                }
                let correction = excess / (self.flat + self.curved * half_chord(x));
                // Where rounding of the mass or of x is all that is left, a next step would only wander.
                if excess.abs() <= 8.0 * f64::EPSILON * mass || correction.abs() <= f64::EPSILON * x {
                    break;
                }
                let newton = x - correction;
                x = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            }
            x
        } else {
            (self.x + (next.x - self.x) * (mass / all)).max(low).min(high)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_of_a_curved_piece_is_exact() {
        // The uniform disk: m = 2 c(x)/(π/4), from one end of the disk to the other.
        let curved = 8.0 / core::f64::consts::PI;
        let slab = Slab { x: 0.0, cumulative: 0.0, flat: 0.0, curved };
        let next = Slab { x: 1.0, cumulative: 1.0, flat: 0.0, curved: 0.0 };
        for k in 0..=1000 {
            let u = f64::from(k) / 1001.0;
            let x = slab.inverse(u, next);
            assert!((slab.mass(0.0, x) - u).abs() < 2e-15 + LEAST_MASS * f64::from(k == 0), "u = {u}: {x}");
        }
    }

    #[test]
    fn inverse_of_a_flat_piece_stays_inside() {
        let slab = Slab { x: 0.25, cumulative: 0.5, flat: 1.0, curved: 0.0 };
        let next = Slab { x: 0.5, cumulative: 0.75, ..slab };
        assert_eq!(slab.inverse(0.5, next), 0.25);
        assert_eq!(slab.inverse(0.625, next), 0.375);
        assert_eq!(slab.inverse(0.75, next), 0.5_f64.next_down());
    }
}
