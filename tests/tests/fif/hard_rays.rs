//! Rays at rough surfaces that are hard to decide, against exact arithmetic: along axes, through
//! nodes, grazing.
//!
//! `HARD_RAYS=100000 cargo test --release -p asperity-tests --test fif hard_rays` tests this many
//! rays, with ten times as many boxes for exact arithmetic.
#![expect(clippy::unwrap_used, reason = "a test that cannot build its surface has failed")]

use std::mem::swap;

use asperity_fif::glam::DVec3;
use asperity_fif::{FixedFif, HeightField, Hit, Intersect, Interval, Ray, Tabulated};
use asperity_tests::random::Random;
use rayon::prelude::*;

use crate::properties::g;

const ALL: Interval = Interval::new(0.0, f64::INFINITY);

/// An interval between multiples of 2⁻¹¹², of magnitude below 32; products are rounded outward.
#[derive(Clone, Copy, Debug)]
struct Exact {
    lo: i128,
    hi: i128,
}

const BITS: i32 = 112;
const ONE: i128 = 1 << BITS;

fn exact(x: f64) -> i128 {
    let scaled = x * 2f64.powi(BITS);
    assert_eq!(scaled.fract(), 0.0, "{x} has more than {BITS} bits");
    scaled as i128
}

fn double(t: i128) -> f64 {
    t as f64 / 2f64.powi(BITS)
}

impl Exact {
    fn point(x: f64) -> Self {
        Self { lo: exact(x), hi: exact(x) }
    }

    fn hull(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    fn intersection(self, other: Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) }
    }

    fn plus(self, other: Self) -> Self {
        Self { lo: self.lo + other.lo, hi: self.hi + other.hi }
    }

    fn half(self) -> Self {
        Self { lo: self.lo >> 1, hi: (self.hi + 1) >> 1 }
    }

    /// Includes a margin of three units for the omitted halves of the factors.
    fn times(self, other: Self) -> Self {
        let product = |a: i128, b: i128| {
            const HALF: i32 = BITS / 2;
            let split = |a: i128| (a.unsigned_abs() >> HALF, a.unsigned_abs() & ((1 << HALF) - 1));
            let ((a1, a0), (b1, b0)) = (split(a), split(b));
            let size = (a1 * b1 + ((a1 * b0 + a0 * b1) >> HALF)) as i128;
            if (a < 0) == (b < 0) { [size, size + 3] } else { [-size - 3, -size] }
        };
        let ends = [(self.lo, other.lo), (self.lo, other.hi), (self.hi, other.lo), (self.hi, other.hi)]
            .map(|(a, b)| if a == 0 || b == 0 { [0, 0] } else { product(a, b) });
        Self { lo: ends.iter().map(|p| p[0]).min().unwrap(), hi: ends.iter().map(|p| p[1]).max().unwrap() }
    }
}

/// An affine system on the knots 0, 1, 2.
#[derive(Clone, Copy, Debug)]
struct Halves {
    y: [f64; 3],
    factors: [f64; 2],
    /// Encloses the deviation of f from its chord.
    deviation: Exact,
}

/// Over a cell, f is the line between its ends plus the product times the deviation.
#[derive(Clone, Copy, Debug)]
struct Cell {
    left: i128,
    width: i128,
    ends: [Exact; 2],
    product: Exact,
}

impl Halves {
    fn new(y: [f64; 3], factors: [f64; 2]) -> Self {
        let rise = y[1] - 0.5 * (y[0] + y[2]);
        let most = exact((rise.abs() / (1.0 - factors[0].abs().max(factors[1].abs()))).ceil());
        let mut flat = Self { y: [0.0, rise, 0.0], factors, deviation: Exact { lo: -most, hi: most } };
        for _ in 0..20 {
            let mut cells = vec![flat.root()];
            for _ in 0..8 {
                cells = cells.iter().flat_map(|cell| [0, 1].map(|j| flat.child(cell, j))).collect();
            }
            flat.deviation = cells.iter().map(|cell| flat.range(cell)).reduce(Exact::hull).unwrap();
        }
        Self { y, ..flat }
    }

    fn axis(&self) -> FixedFif<2, 2> {
        FixedFif::affine(&[0.0, 1.0, 2.0], &self.y, &self.factors).unwrap()
    }

    fn root(&self) -> Cell {
        let ends = [Exact::point(self.y[0]), Exact::point(self.y[2])];
        Cell { left: 0, width: 2 * ONE, ends, product: Exact::point(1.0) }
    }

    fn child(&self, cell: &Cell, j: usize) -> Cell {
        let rise = Exact::point(self.y[1] - 0.5 * (self.y[0] + self.y[2]));
        let middle = cell.ends[0].plus(cell.ends[1]).half().plus(cell.product.times(rise));
        let ends = if j == 0 { [cell.ends[0], middle] } else { [middle, cell.ends[1]] };
        let width = cell.width >> 1;
        let product = cell.product.times(Exact::point(self.factors[j]));
        Cell { left: cell.left + if j == 0 { 0 } else { width }, width, ends, product }
    }

    fn range(&self, cell: &Cell) -> Exact {
        cell.ends[0].hull(cell.ends[1]).plus(cell.product.times(self.deviation))
    }

    /// Returns the enclosure over `[a, b]`, which intersects the cell.
    fn over(&self, cell: &Cell, [a, b]: [i128; 2]) -> Exact {
        let (right, middle) = (cell.left + cell.width, cell.left + (cell.width >> 1));
        if a == b && (a == cell.left || a == right) {
            return cell.ends[usize::from(a == right)];
        }
        let own = self.range(cell);
        if (a <= cell.left && right <= b) || cell.width * 16 <= b - a || cell.width <= 2 {
            return own;
        }
        let part = |j: usize, ends: [i128; 2]| self.over(&self.child(cell, j), ends);
        match (a < middle || b <= middle, b > middle) {
            (true, true) => part(0, [a, middle]).hull(part(1, [middle, b])).intersection(own),
            (true, false) => part(0, [a, b]).intersection(own),
            _ => part(1, [a, b]).intersection(own),
        }
    }
}

/// The exact result for a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Verdict {
    /// The first root lies between these.
    Hit(f64, f64),
    Miss,
    /// Undecided within the box limit.
    Open,
}

/// Traverses cells along x, for a ray with `|d_x| = 1`.
struct Walk {
    axes: [Halves; 2],
    origin: [i128; 3],
    direction: [i128; 3],
    /// g, if the ray has constant y.
    across: Option<Exact>,
    side: i32,
    known_to: i128,
    boxes: u32,
    most: u32,
    found: Option<Verdict>,
}

impl Walk {
    fn at(&self, k: usize, t: i128) -> i128 {
        let product = self.direction[k] * t;
        assert_eq!(product & 1023, 0, "a coordinate has more than {BITS} bits");
        self.origin[k] + (product >> 10)
    }

    fn known(&mut self, side: i32, from: i128, to: i128) -> bool {
        if self.side * side < 0 {
            self.found = Some(Verdict::Hit(double(self.known_to), double(from)));
        }
        (self.side, self.known_to) = (side, to);
        self.found.is_some()
    }

    fn g(&self, ends: [i128; 2]) -> Exact {
        let [a, b] = ends.map(|t| self.at(1, t));
        self.across.unwrap_or_else(|| self.axes[1].over(&self.axes[1].root(), [a.min(b), a.max(b)]))
    }

    /// Returns whether the traversal ends within a cell, from `a` to `b`.
    fn visit(&mut self, cell: &Cell, a: i128, b: i128, depth: u32) -> bool {
        self.boxes += 1;
        let f = self.axes[0];
        let parts = [0, 1].map(|j| f.child(cell, j));
        let height = f.range(&parts[0]).hull(f.range(&parts[1])).intersection(f.range(cell));
        let height = height.times(self.g([a, b]));
        let z = [self.at(2, a), self.at(2, b)];
        if z[0].min(z[1]) > height.hi || z[0].max(z[1]) < height.lo {
            return self.known(if z[0] > height.hi { 1 } else { -1 }, a, b);
        }
        let forward = self.direction[0] > 0;
        for (t, first) in [(a, true), (b, false)] {
            let end = usize::from(first != forward);
            if self.at(0, t) != cell.left + if end == 1 { cell.width } else { 0 } || depth < 12 {
                continue;
            }
            let (height, z) = (cell.ends[end].times(self.g([t, t])), self.at(2, t));
            if height.lo <= z && z <= height.hi {
                self.found = Some(Verdict::Hit(double(self.known_to), double(t)));
                return true;
            }
            if self.known(if z > height.hi { 1 } else { -1 }, t, t) {
                return true;
            }
        }
        // Along the axis a cell needs no position, and can be arbitrarily small.
        let level = self.direction[1] == 0 && self.direction[2] == 0;
        if depth == if level { 190 } else { 100 } || self.boxes > self.most {
            self.found = Some(Verdict::Open);
            return true;
        }
        let middle = cell.left + (cell.width >> 1);
        let t = if forward { middle - self.origin[0] } else { self.origin[0] - middle };
        [[a, b.min(t)], [a.max(t), b]].into_iter().enumerate().any(|(j, [a, b])| {
            let j = if forward { j } else { 1 - j };
            (a < b || level) && self.visit(&parts[j], a, b, depth + 1)
        })
    }
}

fn verdict(halves: Halves, ray: &Ray, boxes: u32) -> Verdict {
    let (mut origin, mut direction) = (ray.origin.to_array(), ray.direction.to_array());
    if direction[0].abs() != 1.0 {
        // Both axes use the same function.
        let ([x, y, _], [u, v, _]) = (&mut origin, &mut direction);
        swap(x, y);
        swap(u, v);
    }
    assert_eq!(direction[0].abs(), 1.0);
    let origin = origin.map(exact);
    let direction = direction.map(|d| exact(d) >> (BITS - 10));
    let enter = if direction[0] > 0 { -origin[0] } else { origin[0] - 2 * ONE };
    let mut walk = Walk {
        axes: [halves; 2],
        origin,
        direction,
        across: None,
        side: 0,
        known_to: 0,
        boxes: 0,
        most: boxes,
        found: None,
    };
    if direction[1] == 0 {
        walk.across = Some(walk.g([0, 0]));
    }
    walk.visit(&halves.root(), enter.max(0), enter + 2 * ONE, 0);
    walk.found.unwrap_or(Verdict::Miss)
}

/// A ray along an axis, level or inclined, or oblique, toward a node of a dyadic grid, at its
/// height or slightly off.
fn hard_ray(random: &mut Random, surface: &impl Intersect) -> Ray {
    let mut below = |n: u32| (random.uniform() * f64::from(n)) as u32;
    let unit = 2f64.powi(-4 - below(14) as i32);
    let cells = 2.0 / unit;
    let mut node = || (1.0 + f64::from(below(cells as u32 - 1))) * unit;
    let (x, y) = (node(), node());
    let slope = |n: u32| (f64::from(n) - 1024.0) / 1024.0;
    let (along, back) = (below(2) == 0, below(2) == 0);
    let forward = if back { -1.0 } else { 1.0 };
    let from = if back { 2.0 - x } else { x };
    let (mut dy, dz) = match below(4) {
        0 | 1 => (0.0, 0.0),
        2 => (0.0, slope(below(2049))),
        _ => (slope(below(2049)), slope(below(2049))),
    };
    // Within the domain everywhere.
    while dy.abs() * from.max(2.0 - from) > y.min(2.0 - y) {
        dy = (dy * 512.0).trunc() / 1024.0;
    }
    let start = from + if dy == 0.0 { 1.0 } else { 0.0 };
    let (x, y, dx, dy) = (x - forward * start, y - dy * start, forward, dy);
    let [at, to] = [[x, y], [dx, dy]].map(|[a, b]| if along { [a, b] } else { [b, a] });
    let meet = [at[0] + start * to[0], at[1] + start * to[1]];
    let height = surface.evaluate(meet[0], meet[1], 0.0).value;
    let off = match below(9) {
        0 => 0.0,
        n => (if n % 2 == 0 { 1.0 } else { -1.0 }) * 2f64.powi([-40, -34, -20, -10][(n as usize - 1) / 2]),
    };
    let z = ((height + off) * 2f64.powi(46)).round() / 2f64.powi(46);
    Ray { origin: DVec3::new(at[0], at[1], z - dz * start), direction: DVec3::new(to[0], to[1], dz) }
}

/// Counts certain hits, hits, proven misses, misses, undecided.
fn judged(halves: Halves, surface: &(dyn Intersect + Sync), rays: &[Ray], boxes: u32) -> [usize; 5] {
    let judge = |ray: &Ray| {
        let hit: Option<Hit> = surface.intersect(ray);
        // A miss is proven. A hit is not necessarily.
        assert!(surface.occluded(ray, ALL) || hit.is_none(), "{ray:?}");
        match (verdict(halves, ray, boxes), hit) {
            (Verdict::Hit(lo, hi), Some(hit)) => {
                let within = lo - 1e-11 <= hit.t && hit.t <= hi + 1e-11;
                assert!(within || !hit.certain, "{ray:?}: {hit:?} not in [{lo}, {hi}]");
                [usize::from(hit.certain), 1, 0, 0, 0]
            }
            (verdict @ Verdict::Hit(..), None) => panic!("{ray:?} is missed: {verdict:?}"),
            (Verdict::Miss, hit) => {
                assert!(hit.is_none_or(|hit| !hit.certain), "{ray:?}: {hit:?} is invented");
                [0, 0, usize::from(hit.is_none()), 1, 0]
            }
            (Verdict::Open, _) => [0, 0, 0, 0, 1],
        }
    };
    let sum = |a: [usize; 5], b: [usize; 5]| [0, 1, 2, 3, 4].map(|k| a[k] + b[k]);
    rays.par_iter().map(judge).reduce(|| [0; 5], sum)
}

fn systems() -> [(Halves, usize); 3] {
    [
        (Halves::new([0.0, 1.0, 0.0], [0.5, 0.5]), 45),
        (Halves::new([0.25, 0.875, -0.5], [-0.75, 0.625]), 53),
        (Halves::new([0.0, 1.0, 0.0], [17.0 / 20.0, -17.0 / 20.0]), 2),
    ]
}

#[test]
fn hard_rays_are_neither_missed_nor_invented() {
    let count = std::env::var("HARD_RAYS").ok().and_then(|count| count.parse().ok()).unwrap_or(2000_usize);
    let boxes = if count > 10_000 { 200_000 } else { 20_000 };
    for (halves, share) in systems() {
        let axis = halves.axis();
        let surface = HeightField::new(axis.view(), axis.view());
        let mut random = Random(7);
        let rays: Vec<Ray> = (0..count * share / 100).map(|_| hard_ray(&mut random, &surface)).collect();
        for form in [&surface, &surface.clone().tabulated()] {
            let seen @ [certain, hits, none, misses, open] = judged(halves, form, &rays, boxes);
            println!("{:?}: {seen:?}", halves.factors);
            if halves.factors[0].abs() < 0.8 {
                assert!(open <= rays.len() / 20 && none == misses && certain * 100 >= 95 * hits, "{seen:?}");
            }
        }
        // With squares and intervals nothing is missed either, but more hits are uncertain.
        let squares = Tabulated::with_levels(&surface, 5);
        judged(halves, &squares, &rays[..rays.len().min(10)], boxes);
    }
}

#[test]
fn spikes_narrower_than_a_billionth_are_hit() {
    let surface = HeightField::new(g(), g());
    let table = surface.clone().tabulated();
    let squares = Tabulated::with_levels(&surface, 7);
    for (origin, direction, [lo, hi]) in [
        (
            [3.0, 0.157_226_562_5, 1.750_976_562_5],
            [-1.0, 0.0, 0.0],
            [2.129_032_255_283_164, 2.129_032_258_426_377_6],
        ),
        (
            [0.414_062_5, -1.0, 1.994_140_625],
            [0.0, 1.0, 0.0],
            [1.212_506_157_910_866, 1.212_506_961_875_078_6],
        ),
    ] {
        let ray = Ray { origin: DVec3::from_array(origin), direction: DVec3::from_array(direction) };
        for form in [&surface as &dyn Intersect, &table, &squares] {
            let hit = form.intersect(&ray).unwrap();
            assert!(form.occluded(&ray, ALL) && (!hit.certain || (lo <= hit.t && hit.t <= hi)), "{hit:?}");
        }
        assert!(surface.intersect(&ray).unwrap().certain && table.intersect(&ray).unwrap().certain);
    }
}
