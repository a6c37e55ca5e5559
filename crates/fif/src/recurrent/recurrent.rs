//! Recurrent systems: each map has its own source interval.

use alloc::vec::Vec;
use asperity_core::Interval;

use crate::numeric::polynomial::{UNIT, bernstein, hull, larger, magnitude, restrict, restriction_error};
use crate::system::error::{FifError, check_coefficients, check_data, check_knots, check_length};
use crate::system::fif::value;
use crate::system::map::Piece;

/// Number of sweeps that tighten the ranges.
const SWEEPS: usize = 64;

#[doc = include_str!("../../docs/recurrent-systems.md")]
#[derive(Clone, Debug)]
pub struct RecurrentFif<const C: usize> {
    pub(crate) links: Vec<Link<C>>,
    range: Interval,
    /// Error of one polynomial, at any point of its source.
    pub(crate) noise: f64,
    /// `1/(1 − max|α|)`, and the same for the horizontal factors.
    pub(crate) gain: f64,
    pub(crate) reach: f64,
    pub(crate) means: Means,
}

impl RecurrentFif<2> {
    /// Creates an affine interpolation with vertical scalings `alpha` and the source intervals
    /// `sources`.
    ///
    /// A source `[from, to]` goes from knot `from` to knot `to`, counted from 0.
    ///
    /// # Errors
    /// See [`FifError`].
    pub fn affine(x: &[f64], y: &[f64], alpha: &[f64], sources: &[[usize; 2]]) -> Result<Self, FifError> {
        let maps = check_sources(x, sources)?;
        check_data(maps, y, alpha)?;
        let lines = sources.iter().zip(alpha).zip(y.windows(2)).map(|((&[from, to], alpha), ends)| {
            let [left, right] = *ends else { return [0.0; 2] };
            let rise = right - left - alpha * (value(y, to) - value(y, from));
            let slope = rise / (value(x, to) - value(x, from));
            [left - alpha * value(y, from) - slope * value(x, from), slope]
        });
        let q: Vec<[f64; 2]> = lines.collect();
        Self::new(x, y, alpha, &q, sources)
    }
}

impl<const C: usize> RecurrentFif<C> {
    /// Creates a recurrent system from knots, their ordinates, vertical scalings, polynomials and
    /// sources.
    ///
    /// # Errors
    /// See [`FifError`]; both ends of every map must match the ordinates within
    /// 2⁻⁴⁰.
    pub fn new(
        x: &[f64],
        y: &[f64],
        alpha: &[f64],
        q: &[[f64; C]],
        sources: &[[usize; 2]],
    ) -> Result<Self, FifError> {
        let maps = check_sources(x, sources)?;
        check_data(maps, y, alpha)?;
        check_length("q", maps, q.len())?;
        (1..).zip(q).try_for_each(|(map, q)| check_coefficients(map, q))?;
        let mut links = Vec::with_capacity(maps);
        let (mut noise, mut steepest, mut widest) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (j, ((&[from, to], &alpha), &q)) in sources.iter().zip(alpha).zip(q).enumerate() {
            let source = [value(x, from), value(x, to)];
            let (image, width) = (value(x, j + 1) - value(x, j), source[1] - source[0]);
            if image >= width {
                return Err(FifError::Expansion { map: j + 1, source: width, image });
            }
            let a = image / width;
            let (ends, values) = ([value(x, j), value(x, j + 1)], [value(y, j), value(y, j + 1)]);
            let of = [value(y, from), value(y, to)];
            let piece = Piece::new(alpha, q, source, ends, values, [0.0, a], a).joined(j + 1, source, of)?;
            (steepest, widest) = (steepest.max(alpha.abs()), widest.max(a));
            links.push(Link { piece, from, to, start: source[0], width, range: Interval::ENTIRE });
        }
        let reach = (1.0 / (1.0 - widest)).next_up();
        let gain = (1.0 / (1.0 - steepest)).next_up();
        for link in &links {
            // Horner's rule, at positions in the sources that err by five units for each map of the
            // orbit.
            let slope: f64 = link.piece.local.iter().enumerate().map(|(k, c)| k as f64 * c.abs()).sum();
            let size = C as f64 * magnitude(&link.piece.local, 1.0);
            noise = larger(noise, link.piece.slack + 8.0 * UNIT * (size + reach * slope));
        }
        let range = ranges(&mut links, gain).ok_or(FifError::Unbounded { alpha: steepest })?;
        if !(noise.is_finite() && reach.is_finite() && gain.is_finite()) {
            return Err(FifError::Unbounded { alpha: steepest });
        }
        let means = Means::new(&links, range, gain);
        Ok(Self { links, range, noise, gain, reach, means })
    }

    /// The maps with their image intervals, from left to right.
    #[must_use]
    pub fn pieces(&self) -> impl ExactSizeIterator<Item = &Piece<C>> {
        self.links.iter().map(|link| &link.piece)
    }

    /// The knots, from 0, at the ends of the source of each map.
    #[must_use]
    pub fn sources(&self) -> impl ExactSizeIterator<Item = [usize; 2]> {
        self.links.iter().map(|link| [link.from, link.to])
    }

    /// `[x_0, x_N]`.
    pub fn domain(&self) -> Interval {
        let ends = (self.links.first(), self.links.last());
        let (Some(first), Some(last)) = ends else { return Interval::new(0.0, 0.0) };
        Interval::new(first.piece.x()[0], last.piece.x()[1])
    }

    /// A rigorous enclosure of `f` over its domain.
    ///
    /// The ranges over the images, `B_j ← hull of α_j B_i + q_j(X_i)` for the images `i` in the
    /// source of `j`, starting from a box that contains all, with outward rounding.
    pub fn range(&self) -> Interval {
        self.range
    }

    /// Rigorous enclosures of `f` over the images of the maps, from left to right.
    #[must_use]
    pub fn ranges(&self) -> impl ExactSizeIterator<Item = Interval> {
        self.links.iter().map(|link| link.range)
    }
}

/// The number of maps.
fn check_sources(x: &[f64], sources: &[[usize; 2]]) -> Result<usize, FifError> {
    let maps = check_knots(x)?;
    check_length("sources", maps, sources.len())?;
    let wrong = sources.iter().enumerate().find(|(_, [from, to])| from >= to || *to > maps);
    match wrong {
        Some((j, &[from, to])) => Err(FifError::Source { map: j + 1, from, to, last: maps }),
        None => Ok(maps),
    }
}

/// Ranges over all images, and their hull.
fn ranges<const C: usize>(links: &mut [Link<C>], gain: f64) -> Option<Interval> {
    let largest = links
        .iter()
        .fold(0.0_f64, |most, link| most.max(magnitude(&link.piece.local, 1.0) + link.piece.slack));
    let radius = 1.001 * largest * gain + f64::MIN_POSITIVE;
    if !radius.is_finite() {
        return None;
    }
    let mut boxes: Vec<Interval> = links.iter().map(|_| Interval::new(-radius, radius)).collect();
    let parts: Vec<Vec<Interval>> = links.iter().map(|link| polynomial_ranges(link, links)).collect();
    for _ in 0..SWEEPS {
        let next: Vec<Interval> = links
            .iter()
            .zip(&parts)
            .zip(&boxes)
            .map(|((link, parts), &now)| {
                let sources = boxes.iter().skip(link.from).zip(parts);
                let hull = sources.fold(Interval::EMPTY, |hull, (&source, &part)| {
                    hull.hull(source.scaled(link.piece.map().alpha).sum(part))
                });
                hull.intersection(now)
            })
            .collect();
        let width = |all: &[Interval]| all.iter().map(|b| b.width()).sum::<f64>();
        let gained = width(&next) < 0.999 * width(&boxes);
        boxes = next;
        if !gained {
            break;
        }
    }
    for (link, range) in links.iter_mut().zip(&boxes) {
        link.range = *range;
    }
    Some(boxes.iter().fold(Interval::EMPTY, |hull, b| hull.hull(*b)))
}

/// Enclosures of the polynomial of a map over the images in its source.
fn polynomial_ranges<const C: usize>(link: &Link<C>, links: &[Link<C>]) -> Vec<Interval> {
    let all = bernstein(&link.piece.local);
    let largest = hull(&all).magnitude();
    let slope = 2.0 * C as f64 * largest;
    let within = links.get(link.from..link.to).unwrap_or_default();
    let part = |inner: &Link<C>| {
        let [l, r] = inner.piece.x().map(|x| ((x - link.start) / link.width).clamp(0.0, 1.0));
        // The ends err by four units.
        let error = restriction_error::<C>(l, r) * largest + 8.0 * UNIT * slope;
        hull(&restrict(&all, l, r)).inflated(error + link.piece.slack)
    };
    within.iter().map(part).collect()
}

/// A map with its source.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link<const C: usize> {
    pub(crate) piece: Piece<C>,
    /// The knots of the source.
    pub(crate) from: usize,
    pub(crate) to: usize,
    /// Left end and width of the source.
    pub(crate) start: f64,
    pub(crate) width: f64,
    /// An enclosure of `f` over the image.
    pub(crate) range: Interval,
}

impl<const C: usize> Link<C> {
    /// The width of the image.
    pub(crate) fn image(&self) -> f64 {
        self.piece.x()[1] - self.piece.x()[0]
    }
}

/// Number of sweeps that solve for the means.
const MEAN_SWEEPS: usize = 65_536;

/// Integrals from the left end to every knot.
#[derive(Clone, Debug)]
pub(crate) struct Means {
    pub(crate) integrals: Vec<f64>,
    /// Error bound of a mean over images.
    pub(crate) error: f64,
    /// The width of the domain divided by the width of the narrowest source.
    pub(crate) spread: f64,
}

impl Means {
    /// Solves `m_j = α_j (mean over the source) + mean of q_j`, a contraction by `max|α|` in the
    /// maximum error.
    pub(crate) fn new<const C: usize>(links: &[Link<C>], range: Interval, gain: f64) -> Self {
        let parts: Vec<f64> = links.iter().map(|link| primitive(&link.piece.local, 1.0)).collect();
        let mut means: Vec<f64> = links.iter().map(|link| link.range.middle()).collect();
        let mut integrals = sums(links, &means);
        let (mut moved, mut left) = (f64::INFINITY, MEAN_SWEEPS);
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
        // One more sweep changes no mean by more; roundings of a mean and of the integral of the
        // polynomial.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overflowing_polynomials_are_an_error() {
        // x³ over [0, 10²⁰⁰] has coefficients of ∞ and of 0 · ∞; the second polynomial is finite.
        let (x, cubic) = ([0.0, 1e200, 2e200], [0.0, 0.0, 0.0, 1.0]);
        let error =
            RecurrentFif::new(&x, &[0.0; 3], &[0.1; 2], &[cubic, [0.0; 4]], &[[0, 2], [0, 2]]).unwrap_err();
        assert!(matches!(error, FifError::Unbounded { .. }), "{error}");
    }
}
