//! Derivatives of any order by the table of composites.

use crate::numeric::interval::Bounded;
use crate::table::jet::rows::Jets;

impl<const C: usize> Jets<C> {
    /// `f, f′, …, f^(M−1)` at `x`, NaN beyond those that are continuous; `None` as [`Jets::sum`].
    pub(crate) fn derivatives<const M: usize>(&self, x: f64) -> Option<[Bounded; M]> {
        let mut out = [Bounded::NAN; M];
        let (t, mut rest) = self.place(x)?;
        let mut weights = [1.0; M];
        let (mut scale, mut factorial) = (1.0, 1.0);
        for (m, weight) in weights.iter_mut().enumerate() {
            factorial *= if m > 0 { m as f64 } else { 1.0 };
            *weight = scale * factorial;
            scale *= self.scales.radix;
        }
        let tail = weights;
        for (m, (out, order)) in out.iter_mut().zip(&self.orders).enumerate() {
            let value = match m {
                0 => self.chord.at(t),
                1 => self.chord.rise,
                _ => 0.0,
            };
            *out = Bounded { value, bound: order.bound };
        }
        let most = self.orders.iter().take(M).fold(0, |most, order| most.max(order.terms));
        for k in 0..most {
            let Some((row, _, z)) = self.next(&mut rest) else { break };
            let mut taylor = row.c;
            let mut scale = row.a;
            let sums = out.iter_mut().zip(&mut weights).zip(&tail).zip(&self.orders).enumerate();
            for (m, (((out, weight), unit), order)) in sums {
                // Horner's rule divides by z: what remains is the next coefficient of the expansion there.
                let mut p = 0.0;
                for c in taylor.iter_mut().skip(m).rev() {
                    p = p * z + *c;
                    *c = p;
                }
                if k < order.terms {
                    out.value += *weight * p;
                    *weight *= scale;
                }
                if k + 1 == order.terms {
                    out.value += *weight / unit * if rest == 0 { order.tail[1] } else { order.tail[0] };
                }
                scale *= self.scales.radix;
            }
        }
        let mut unit = 1.0;
        for out in &mut out {
            out.value *= unit;
            unit *= self.per_width;
        }
        Some(out)
    }
}
