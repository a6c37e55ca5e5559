//! SIMD packets of rays for a smooth height field with tables.
//!
//! The root searches and the hits use the same operations in the same order as for a single ray.

use asperity_core::Interval;
use fearless_simd::{Level, Select, Simd, SimdBase, SimdFloat, SimdMask, dispatch, f64x8, mask64x8};
use glam::{DVec2, DVec3};

use crate::numeric::polynomial::UNIT;
use crate::ray::ray::{Hit, Ray};
use crate::ray::tables::{Path, Tracer};
use crate::surface::height_field::function::Function;
use crate::surface::height_field::jet_table::LANES;

/// Maximum number of evaluations of a packet; rays that need more are searched one by one.
const EVALUATIONS: u32 = 16;

const NUMBERS: [f64; LANES] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// Rays that approach the surface monotonically over an interval, one column each.
///
/// The rows are start and direction in units of the domain, the direction and the starting height
/// of the ray, interval, rate, blur, reach, and 1 if no interval follows.
#[derive(Clone)]
pub(crate) struct Packet {
    rows: [[f64; LANES]; 15],
    /// The index of each ray in its list.
    numbers: [usize; LANES],
    count: usize,
}

/// State of the rays of a packet between one evaluation and the next.
struct Search<I: Simd> {
    t: f64x8<I>,
    /// Number of steps of the next evaluation, and its error bound.
    steps: f64x8<I>,
    bound: f64x8<I>,
    /// The bracket of the root if it is in the interval, and whether it is known not to lie before
    /// or behind.
    lo: f64x8<I>,
    hi: f64x8<I>,
    starts: mask64x8<I>,
    ends: mask64x8<I>,
    /// Rays in progress, rays with a known result, and rays that hit.
    open: mask64x8<I>,
    served: mask64x8<I>,
    hit: mask64x8<I>,
    found: f64x8<I>,
}

impl Packet {
    pub(crate) const EMPTY: Self = Self { rows: [[0.0; LANES]; 15], numbers: [0; LANES], count: 0 };

    #[inline(always)]
    pub(crate) fn is_full(&self) -> bool {
        self.count >= LANES
    }

    /// Adds a ray.
    #[inline(always)]
    pub(crate) fn push<F: Function, G: Function>(
        &mut self,
        number: usize,
        path: &Path<'_, F, G>,
        span: Interval,
        rate: Interval,
        last: bool,
    ) {
        let (lane, d) = (self.count, path.ray.direction);
        let ([x, y], [across, along]) = (path.from, path.direction);
        let column = [
            x,
            y,
            across,
            along,
            d.x,
            d.y,
            d.z,
            path.ray.origin.z,
            span.lo,
            span.hi,
            rate.lo,
            rate.hi,
            path.blur,
            path.reach,
            f64::from(u8::from(last)),
        ];
        if lane < LANES {
            self.numbers[lane] = number;
            for (row, value) in self.rows.iter_mut().zip(column) {
                row[lane] = value;
            }
            self.count += 1;
        }
    }
}

impl<F: Function, G: Function> Tracer<'_, F, G> {
    /// Empties a packet: stores the hit of each ray, or passes the ray to `one_by_one` if SIMD does
    /// not apply.
    ///
    /// In two functions, because the combined stack frame exceeds a megabyte in unoptimized builds.
    pub(crate) fn finish(
        &self,
        level: Level,
        packet: &mut Packet,
        rays: &[Ray],
        hits: &mut [Option<Hit>],
        one_by_one: &dyn Fn(&Ray) -> Option<Hit>,
    ) {
        if packet.count > 0 {
            dispatch!(level, simd => {
                let search = simd.vectorize(
                    #[inline(always)]
                    || self.search(simd, packet),
                );
                simd.vectorize(
                    #[inline(always)]
                    || self.hits(simd, packet, &search, rays, hits, one_by_one),
                );
            });
            packet.count = 0;
        }
    }

    /// The hits that a search has found.
    #[inline(always)]
    fn hits<I: Simd>(
        &self,
        simd: I,
        packet: &Packet,
        search: &Search<I>,
        rays: &[Ray],
        hits: &mut [Option<Hit>],
        one_by_one: &dyn Fn(&Ray) -> Option<Hit>,
    ) {
        let steps = self.slope_steps;
        let ([f, g], _, _) =
            self.above_all(simd, packet, search.found, f64x8::splat(simd, steps as f64), steps);
        let gradient = [f[1] * g[0], f[0] * g[1]];
        let square = gradient[0] * gradient[0] + gradient[1] * gradient[1] + 1.0;
        let scale = f64x8::splat(simd, 1.0) / square.sqrt();
        let short = square.simd_lt(f64x8::splat(simd, f64::MAX));
        let height = f[0] * g[0];
        let (served, met) = ((search.served & short).to_bitmask(), search.hit.to_bitmask());
        for lane in 0..packet.count.min(LANES) {
            let number = packet.numbers[lane];
            let (Some(ray), Some(place)) = (rays.get(number), hits.get_mut(number)) else { continue };
            *place = if served >> lane & 1 == 0 {
                one_by_one(ray)
            } else if met >> lane & 1 == 0 {
                None
            } else {
                let (t, scale) = (search.found[lane], scale[lane]);
                let gradient = DVec2::new(gradient[0][lane], gradient[1][lane]);
                let [x, y] = self.place(ray, t);
                let normal = DVec3::new(-gradient.x * scale, -gradient.y * scale, scale);
                let height = height[lane];
                Some(Hit { t, x, y, height, gradient: Some(gradient), normal: Some(normal), certain: true })
            };
        }
    }

    /// [`Path::above`] of all rays, with at most `most` steps.
    #[inline(always)]
    fn above_all<I: Simd>(
        &self,
        simd: I,
        packet: &Packet,
        t: f64x8<I>,
        steps: f64x8<I>,
        most: usize,
    ) -> ([[f64x8<I>; 2]; 2], f64x8<I>, f64x8<I>) {
        let row = |k: usize| f64x8::from_slice(simd, &packet.rows[k]);
        let (x, y) = (row(0) + t * row(2), row(1) + t * row(3));
        let (f, g) = (self.x.jets.in_lanes(x, steps, most), self.y.jets.in_lanes(y, steps, most));
        let (dx, dy, dz) = (row(4), row(5), row(6));
        let z = row(7) + t * dz;
        ([f, g], z - f[0] * g[0], dz - dx * f[1] * g[0] - dy * f[0] * g[1])
    }

    /// [`Search::finish`](crate::ray::tables::Search::finish) of all rays; others are searched one
    /// by one.
    #[inline(always)]
    fn search<I: Simd>(&self, simd: I, packet: &Packet) -> Search<I> {
        let row = |k: usize| f64x8::from_slice(simd, &packet.rows[k]);
        let splat = |x: f64| f64x8::splat(simd, x);
        let ([zero, one, two], [first, last]) = ([0.0, 1.0, 2.0].map(splat), [row(8), row(9)]);
        let (rate_lo, rate_hi) = (row(10), row(11));
        let nearer = rate_lo.simd_gt(zero);
        let sign = nearer.select(one, -one);
        let (least, largest) = (nearer.select(rate_lo, -rate_hi), nearer.select(rate_hi, -rate_lo));
        let slack = (first.abs() + last.abs()) * (4.0 * UNIT);
        let reach = row(13) + slack;
        let (slow, fast) = (one / least, one / largest);
        let spread = (slow - fast) * 1.0001;
        let (second, finest) = (splat(self.better(1) as f64), splat(self.finest() as f64));
        let errors = [splat(self.error(1)), splat(self.error(2)), splat(self.error(self.finest()))];
        let (none, alone) = (zero.simd_gt(one), row(14).simd_gt(zero));
        let mut s = Search {
            t: first * 0.5 + last * 0.5,
            steps: one,
            bound: errors[0] + row(12),
            lo: first,
            hi: last,
            starts: none,
            ends: none,
            open: f64x8::from_slice(simd, &NUMBERS).simd_lt(splat(packet.count as f64)),
            served: none,
            hit: none,
            found: first,
        };
        for evaluated in 1..=EVALUATIONS {
            let most = if (s.open & s.steps.simd_gt(two)).any_true() {
                self.finest()
            } else {
                1 + usize::from((s.open & s.steps.simd_gt(one)).any_true())
            };
            let (_, value, slope) = match most {
                1 => self.above_all(simd, packet, s.t, s.steps, 1),
                _ => self.above_all(simd, packet, s.t, s.steps, most),
            };
            let (value, slope) = (sign * value, sign * slope);
            let slope = slope.simd_lt(least).select(least, slope);
            let slope = slope.simd_gt(largest).select(largest, slope);
            let next = s.t - value / slope;
            let size = value.abs();
            let (near, within) =
                ((size * spread + s.bound * slow * 1.0001).simd_le(row(13)), size.simd_le(s.bound));
            let settled = near | (within & s.steps.simd_ge(finest));
            let margin = near.select(reach, s.bound * 2.0 * slow + slack);
            let inside =
                (s.starts | (next - margin).simd_ge(first)) & (s.ends | (next + margin).simd_le(last));
            let hit = s.open & settled & inside;
            (s.found, s.hit) = (hit.select(next, s.found), s.hit | hit);
            let more = s.steps.simd_eq(one).select(second, finest);
            let steps = size.simd_le(s.bound * 4.0).select(more, s.steps);
            let positive = value.simd_gt(zero);
            let (behind, before) = (positive & !within, !(positive | within));
            (s.hi, s.ends) = (behind.select(s.t, s.hi), s.ends | behind);
            (s.lo, s.starts) = (before.select(s.t, s.lo), s.starts | before);
            let between = next.simd_gt(s.lo) & next.simd_lt(s.hi);
            let (end, known) = (positive.select(s.lo, s.hi), (positive & s.starts) | (!positive & s.ends));
            let past = !(within | between | known);
            let far = s.t.simd_eq(end) | ((size - s.bound) * fast).simd_gt((s.t - end).abs() + slack);
            let miss = s.open & past & far & !settled;
            s.served |= hit | (miss & alone);
            let straight = if evaluated.is_multiple_of(8) { none } else { between };
            let next = straight.select(next, past.select(end, s.lo * 0.5 + s.hi * 0.5));
            let stuck = s.steps.simd_eq(steps) & (next.simd_eq(s.t) | (s.hi - s.lo).simd_le(slack));
            s.open &= !(settled | miss | stuck);
            if !s.open.any_true() {
                break;
            }
            let error = steps.simd_eq(one).select(errors[0], steps.simd_eq(two).select(errors[1], errors[2]));
            (s.t, s.steps, s.bound) = (next, steps, error + row(12));
        }
        s
    }
}
