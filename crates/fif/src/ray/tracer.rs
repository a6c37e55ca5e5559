//! A ray against a smooth height field that has tables: its heights, rates and ranges.

use glam::DVec3;

use crate::math::sqrt;
use crate::numeric::interval::Interval;
use crate::ray::ray::Ray;
use crate::surface::height_field::axis_tables::AxisTables;
use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;

/// Constants that all rays against a surface share.
pub(crate) struct Tracer<'a, F: Function, G: Function> {
    pub(crate) surface: &'a HeightField<F, G>,
    pub(crate) x: &'a AxisTables<F::Rows>,
    pub(crate) y: &'a AxisTables<G::Rows>,
    tolerance: f64,
    /// The greatest `|∂h/∂x|` and `|∂h/∂y|`.
    falls: [f64; 2],
    /// `16 ε` of the greatest height.
    pad: f64,
    /// Errors of a height after 0, 1 and 2 steps, and after the finest.
    errors: [f64; 3],
    best: f64,
    /// Steps for values to the rounding error.
    finest: usize,
    /// Steps for the slopes of the hit.
    pub(crate) slope_steps: usize,
}

/// One ray on its way.
pub(crate) struct Path<'a, F: Function, G: Function> {
    pub(crate) tracer: &'a Tracer<'a, F, G>,
    pub(crate) ray: Ray,
    pub(crate) span: Interval,
    /// Along both axes in parts of the domain: where the ray begins and its direction.
    pub(crate) from: [f64; 2],
    pub(crate) way: [f64; 2],
    /// More than the rounding of these.
    late: [f64; 2],
    /// `1/d_z`
    pub(crate) inverse: f64,
    pub(crate) pad: f64,
    /// More than the rounding of the rate at which the ray comes nearer.
    pub(crate) rate_pad: f64,
    /// More than what the rounding of the coordinates does to the height.
    pub(crate) blur: f64,
    /// Errors of `t` that are allowed.
    pub(crate) reach: f64,
}

impl<'a, F: Function, G: Function> Tracer<'a, F, G> {
    /// `None` unless both axes have tables.
    pub(crate) fn new(surface: &'a HeightField<F, G>, tolerance: f64) -> Option<Self> {
        let (x, y) = (surface.x.top()?, surface.y.top()?);
        let (wide, deep) = (x.domain.width(), y.domain.width());
        // Over a cell of the tolerance's size, one slope is as good as another.
        let tolerance = if tolerance > 0.0 { tolerance } else { 0.0 };
        let part = tolerance / if wide > deep { wide } else { deep };
        let (p, q) = (x.jets.cells_within(part), y.jets.cells_within(part));
        let (finest, other) = (x.jets.finest().0, y.jets.finest().0);
        let finest = if finest > other { finest } else { other };
        let product = |f: f64, g: f64| 1.0001 * (x.magnitude * g + y.magnitude * f + f * g);
        Some(Self {
            surface,
            tolerance,
            falls: [x.steepest * y.magnitude, x.magnitude * y.steepest],
            pad: 16.0 * f64::EPSILON * (x.magnitude * y.magnitude),
            errors: [0, 1, 2].map(|steps| product(x.jets.error(steps), y.jets.error(steps))),
            best: product(x.jets.error(finest), y.jets.error(finest)),
            finest,
            slope_steps: if p > q { p } else { q },
            x,
            y,
        })
    }

    /// The ray ready to go; `None` for rays with components that are zero, extreme, or no numbers.
    #[inline(always)]
    pub(crate) fn path(&'a self, ray: &Ray, t: Interval) -> Option<Path<'a, F, G>> {
        let (o, d) = (ray.origin, ray.direction);
        let inverse = DVec3::new(1.0 / d.x, 1.0 / d.y, 1.0 / d.z);
        let (magnitude, speed) = (o.abs(), d.abs());
        let sizes = (inverse.x.abs() + inverse.y.abs()) + (speed.x + speed.y + speed.z);
        let sane = sizes + (magnitude.x + magnitude.y + magnitude.z) < 1e100;
        if !sane {
            return None;
        }
        let (x, y) = (self.x, self.y);
        let pads = [
            16.0 * f64::EPSILON * magnitude.x + x.pad,
            16.0 * f64::EPSILON * magnitude.y + y.pad,
            16.0 * f64::EPSILON * magnitude.z + self.pad,
        ];
        // No number as the end leaves nothing.
        let end = if t.hi >= 0.0 { t.hi } else { f64::NEG_INFINITY };
        let mut span = Interval::new(if t.lo > 0.0 { t.lo } else { 0.0 }, end);
        for (side, o, inverse, pad) in
            [(x.domain, o.x, inverse.x, pads[0]), (y.domain, o.y, inverse.y, pads[1])]
        {
            let (a, b) = ((side.lo - pad - o) * inverse, (side.hi + pad - o) * inverse);
            span = span.intersection(if a < b { Interval::new(a, b) } else { Interval::new(b, a) });
        }
        let blur = self.falls[0] * pads[0] + self.falls[1] * pads[1];
        let rate = speed.z + speed.x * self.falls[0] + speed.y * self.falls[1];
        Some(Path {
            tracer: self,
            ray: *ray,
            span,
            from: [(o.x - x.domain.lo) * x.per_width, (o.y - y.domain.lo) * y.per_width],
            way: [d.x * x.per_width, d.y * y.per_width],
            late: [pads[0] * x.per_width, pads[1] * y.per_width],
            inverse: inverse.z,
            pad: pads[2],
            rate_pad: 16.0 * f64::EPSILON * rate,
            blur: pads[2] + blur,
            reach: if self.tolerance > 0.0 {
                self.tolerance / sqrt(d.x * d.x + d.y * d.y + d.z * d.z)
            } else {
                0.0
            },
        })
    }

    #[inline]
    pub(crate) fn finest(&self) -> usize {
        self.finest
    }

    /// Bound of the error of a height but for the ray's own rounding.
    #[inline]
    pub(crate) fn error(&self, steps: usize) -> f64 {
        self.errors.get(steps).copied().unwrap_or(self.best)
    }

    /// Position of a ray at `t`, clamped to the domain.
    #[inline(always)]
    pub(crate) fn place(&self, ray: &Ray, t: f64) -> [f64; 2] {
        let within = |x: f64, domain: Interval| {
            let x = if x > domain.lo { x } else { domain.lo };
            if x < domain.hi { x } else { domain.hi }
        };
        let (o, d) = (ray.origin, ray.direction);
        [within(o.x + t * d.x, self.x.domain), within(o.y + t * d.y, self.y.domain)]
    }

    /// More steps than these, if there are any that gain.
    #[inline]
    pub(crate) fn better(&self, steps: usize) -> usize {
        if steps == 1 && self.finest > 2 { 2 } else { self.finest }
    }
}

impl<F: Function, G: Function> Path<'_, F, G> {
    /// The parts of the domains from the beginning of a stretch to its end, in order.
    #[inline(always)]
    fn parts(&self, axis: usize, span: Interval) -> [f64; 2] {
        let (from, way, late) = (self.from[axis], self.way[axis], self.late[axis]);
        let (a, b) = (from + span.lo * way, from + span.hi * way);
        if way > 0.0 { [a - late, b + late] } else { [b - late, a + late] }
    }

    /// Ranges of values and slopes along both axes over a stretch, from the tables.
    #[inline(always)]
    pub(crate) fn ranges(&self, span: Interval) -> [[Interval; 2]; 2] {
        [self.tracer.x.over(self.parts(0, span)), self.tracer.y.over(self.parts(1, span))]
    }

    /// Narrower ones below the cells of the tables.
    #[inline]
    pub(crate) fn finer(&self, span: Interval) -> Option<[[Interval; 2]; 2]> {
        let (x, y) = (self.tracer.x, self.tracer.y);
        let (along_x, along_y) = (self.parts(0, span), self.parts(1, span));
        let short = |[a, b]: [f64; 2], cells: f64| (b - a) * cells <= 1.0;
        if !(short(along_x, x.cells) && short(along_y, y.cells)) {
            return None;
        }
        Some([x.finer(along_x)?, y.finer(along_y)?])
    }

    /// Value and slope of both axes where the ray meets the surface, the slopes over cells of the tolerance's size.
    #[inline(always)]
    pub(crate) fn jets(&self, t: f64) -> [[f64; 2]; 2] {
        self.above(t, self.tracer.slope_steps).0
    }

    /// Bound of the error of a height.
    #[inline]
    pub(crate) fn error(&self, steps: usize) -> f64 {
        self.tracer.error(steps) + self.blur
    }

    /// The jets at `t`, the height of the ray above the surface, and how it changes.
    #[inline(always)]
    pub(crate) fn above(&self, t: f64, steps: usize) -> ([[f64; 2]; 2], f64, f64) {
        let (o, d) = (self.ray.origin, self.ray.direction);
        let (x, y) = (self.from[0] + t * self.way[0], self.from[1] + t * self.way[1]);
        let (f, g) = (&self.tracer.x.jets, &self.tracer.y.jets);
        // The numbers of steps that tolerances ask for, as constants: half the time of a loop.
        let (f, g) = match steps {
            1 => (f.jet(x, 1), g.jet(y, 1)),
            2 => (f.jet(x, 2), g.jet(y, 2)),
            _ => (f.jet(x, steps), g.jet(y, steps)),
        };
        let z = o.z + t * d.z;
        ([f, g], z - f[0] * g[0], d.z - d.x * f[1] * g[0] - d.y * f[0] * g[1])
    }
}
