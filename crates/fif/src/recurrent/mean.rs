//! Means over the images of a recurrent system.

use alloc::vec::Vec;

use crate::numeric::interval::Interval;
use crate::numeric::polynomial::{UNIT, magnitude};
use crate::recurrent::link::Link;

/// Sweeps that solve for the means.
const SWEEPS: usize = 65_536;

/// Integrals from the left end to every knot.
#[derive(Clone, Debug)]
pub(crate) struct Means {
    pub(crate) integrals: Vec<f64>,
    /// Bound of the error of a mean over images.
    pub(crate) error: f64,
    /// The width of the domain over that of the narrowest source.
    pub(crate) spread: f64,
}

impl Means {
    /// Solves `m_j = α_j (mean over the source) + mean of q_j`, a contraction by `max|α|` in the largest error.
    pub(crate) fn new<const C: usize>(links: &[Link<C>], range: Interval, gain: f64) -> Self {
        let parts: Vec<f64> = links.iter().map(|link| primitive(&link.piece.local, 1.0)).collect();
        let mut means: Vec<f64> = links.iter().map(|link| link.range.middle()).collect();
        let mut integrals = sums(links, &means);
        let (mut moved, mut left) = (f64::INFINITY, SWEEPS);
        let scale = range.magnitude() + f64::MIN_POSITIVE;
        while left > 0 && moved > 4.0 * UNIT * scale {
            moved = 0.0_f64;
            for ((mean, link), part) in means.iter_mut().zip(links).zip(&parts) {
                let next = link.piece.map().alpha * mean_over(&integrals, link) + part;
                moved = moved.max((next - *mean).abs());
                *mean = next;
            }
            integrals = sums(links, &means);
            left -= 1;
        }
        // One more sweep moves no mean by more; roundings of a mean and of the polynomial's integral.
        let maps = links.len() as f64;
        let slack = links.iter().fold(0.0_f64, |most, link| {
            most.max(link.piece.slack + 4.0 * C as f64 * UNIT * magnitude(&link.piece.local, 1.0))
        });
        let whole: f64 = links.iter().map(Link::image).sum();
        let spread = links.iter().fold(0.0_f64, |most, link| most.max(whole / link.width));
        let rounding = UNIT * (4.0 * maps * spread + 16.0) * scale + slack;
        Self { integrals, error: 1.01 * gain * (moved + rounding), spread }
    }
}

/// Integrals up to each knot.
fn sums<const C: usize>(links: &[Link<C>], means: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut all = Vec::with_capacity(links.len() + 1);
    all.push(sum);
    for (link, mean) in links.iter().zip(means) {
        sum += link.image() * mean;
        all.push(sum);
    }
    all
}

fn mean_over<const C: usize>(integrals: &[f64], link: &Link<C>) -> f64 {
    let at = |knot: usize| integrals.get(knot).copied().unwrap_or(0.0);
    (at(link.to) - at(link.from)) / link.width
}

/// `∫ Σ c_k uᵏ` over `[0, s]`.
pub(crate) fn primitive<const C: usize>(c: &[f64; C], s: f64) -> f64 {
    let mut sum = 0.0;
    for (k, c) in c.iter().enumerate().rev() {
        sum = sum * s + c / (k + 1) as f64;
    }
    sum * s
}
