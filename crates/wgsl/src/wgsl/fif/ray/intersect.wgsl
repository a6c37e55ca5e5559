// Intersection of rays with a height field: `asperity_fif::Intersect::intersect_within`, in f32.
//
// An interval of the ray is bounded by the ranges of heights and slopes of the cells under it. The
// parts above and below all heights are cut off. If the ray approaches or leaves the surface over
// the whole interval, it has at most one root, which Newton steps find. Otherwise the interval is
// halved, and the part too close to its start for a root is skipped.

struct HeightFieldHit {
    // 0: no hit. 1: the first hit. 2: the ray grazes the surface here within rounding, or the limit
    // of intervals was reached.
    kind: u32,
    // The ray's parameter.
    t: f32,
    // The point of the domain below it.
    p: vec2<f32>,
    height: f32,
    gradient: vec2<f32>,
}

// A ray and its rounding errors.
struct HeightFieldRay {
    origin: vec3<f32>,
    direction: vec3<f32>,
    // More than the rounding of its coordinates and of the rate at which it approaches.
    pad: vec3<f32>,
    rate_pad: f32,
    // Bound of the error of its height above the surface.
    error: f32,
}

// An interval of the ray, and the rates over it.
struct HeightFieldStretch {
    span: vec2<f32>,
    rate: vec2<f32>,
}

const HEIGHT_FIELD_STRETCHES: u32 = 256u;
const HEIGHT_FIELD_STEPS: u32 = 24u;
// 2^-22, four roundings.
const HEIGHT_FIELD_ROUNDING: f32 = 2.3841858e-7;

// Whether |x| < 1e18.
fn height_field_is_sane(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7fffffffu) < 0x5d5e0b6bu;
}

// Ranges of values (x, y) and slopes (z, w) from a to b.
fn fif_ranges_over(ranges: FifRanges, a: f32, b: f32) -> vec4<f32> {
    let cells = f32(ranges.cells);
    let per_width = cells / (ranges.high - ranges.low);
    let most = cells - 1.0;
    let first = u32(clamp(floor((a - ranges.low) * per_width), 0.0, most));
    let last = max(first, u32(clamp(floor((b - ranges.low) * per_width), 0.0, most)));
    // The number of the run's leading bit, from a float's exponent, as GLSL ES 3.00 has no function
    // for it.
    let row = (bitcast<u32>(f32(last - first + 1u)) >> 23u) - 127u;
    let start = row * ranges.cells;
    let i = ranges.first + 4u * (start + first);
    let j = ranges.first + 4u * (start + last + 1u - (1u << row));
    // The lower ends are negated.
    return vec4<f32>(
        -max(fif_ranges(i), fif_ranges(j)),
        max(fif_ranges(i + 1u), fif_ranges(j + 1u)),
        -max(fif_ranges(i + 2u), fif_ranges(j + 2u)),
        max(fif_ranges(i + 3u), fif_ranges(j + 3u)),
    );
}

// The product of two intervals.
fn fif_ranges_product(a: vec2<f32>, b: vec2<f32>) -> vec2<f32> {
    let p = vec4<f32>(a.x * b.x, a.x * b.y, a.y * b.x, a.y * b.y);
    return vec2<f32>(min(min(p.x, p.y), min(p.z, p.w)), max(max(p.x, p.y), max(p.z, p.w)));
}

// An interval times a number.
fn fif_ranges_scaled(a: vec2<f32>, s: f32) -> vec2<f32> {
    return vec2<f32>(min(a.x * s, a.y * s), max(a.x * s, a.y * s));
}

// The part of an interval in which o + t d is between two bounds; empty if it ends before it
// begins.
fn height_field_cut(span: vec2<f32>, o: f32, d: f32, low: f32, high: f32) -> vec2<f32> {
    if d == 0.0 {
        if o < low || o > high {
            return vec2<f32>(1.0, 0.0);
        }
        return span;
    }
    let a = (low - o) / d;
    let b = (high - o) / d;
    return vec2<f32>(max(span.x, min(a, b)), min(span.y, max(a, b)));
}

// The interval without the parts above and below all heights, and the rates at which the ray
// approaches over it.
fn height_field_narrowed(ranges: HeightFieldRanges, ray: HeightFieldRay, span: vec2<f32>) -> HeightFieldStretch {
    let a = ray.origin.xy + span.x * ray.direction.xy;
    let b = ray.origin.xy + span.y * ray.direction.xy;
    let low = min(a, b) - ray.pad.xy;
    let high = max(a, b) + ray.pad.xy;
    let f = fif_ranges_over(ranges.x, low.x, high.x);
    let g = fif_ranges_over(ranges.y, low.y, high.y);
    let h = fif_ranges_product(f.xy, g.xy);
    let u = fif_ranges_scaled(fif_ranges_product(f.zw, g.xy), ray.direction.x);
    let v = fif_ranges_scaled(fif_ranges_product(f.xy, g.zw), ray.direction.y);
    return HeightFieldStretch(
        height_field_cut(span, ray.origin.z, ray.direction.z, h.x - ray.pad.z, h.y + ray.pad.z),
        vec2<f32>(
            ray.direction.z - u.y - v.y - ray.rate_pad,
            ray.direction.z - u.x - v.x + ray.rate_pad,
        ),
    );
}

// The ray's height above the surface at t, and its derivative.
fn height_field_above(field: HeightField, ray: HeightFieldRay, t: f32) -> vec2<f32> {
    let p = ray.origin + t * ray.direction;
    let jet = height_field_jet(field, p.xy);
    return vec2<f32>(p.z - jet.height, ray.direction.z - dot(ray.direction.xy, jet.gradient));
}

// The only root in an interval over which the ray only approaches or only leaves: a parameter
// beyond it, and 1; or 0 without a root.
fn height_field_root(field: HeightField, ray: HeightFieldRay, stretch: HeightFieldStretch) -> vec2<f32> {
    var low = stretch.span.x;
    var high = stretch.span.y;
    // The height above the surface times this sign increases.
    let sign = select(-1.0, 1.0, stretch.rate.x > 0.0);
    let least = max(min(abs(stretch.rate.x), abs(stretch.rate.y)), 1e-30);
    let most = max(abs(stretch.rate.x), abs(stretch.rate.y));
    let begin = sign * height_field_above(field, ray, low).x;
    let finish = sign * height_field_above(field, ray, high).x;
    if begin > ray.error || finish < -ray.error {
        return vec2<f32>(0.0, 0.0);
    }
    var t = low;
    if finish - begin > 0.0 {
        t = clamp(low + (high - low) * (-begin / (finish - begin)), low, high);
    }
    for (var k = 0u; k < HEIGHT_FIELD_STEPS; k++) {
        let above = sign * height_field_above(field, ray, t);
        if above.x > 0.0 {
            high = t;
        } else {
            low = t;
        }
        var next = t - above.x / clamp(above.y, least, most);
        if !(next > low && next < high) {
            next = clamp(next, low, high);
            if abs(above.x) > ray.error {
                next = 0.5 * low + 0.5 * high;
            }
        }
        let step = abs(next - t);
        t = next;
        if step <= 1.1920929e-7 * abs(t) {
            break;
        }
    }
    return vec2<f32>(t, 1.0);
}

// The hit at t.
fn height_field_hit(field: HeightField, ranges: HeightFieldRanges, ray: HeightFieldRay, t: f32, kind: u32) -> HeightFieldHit {
    let p = clamp(
        ray.origin.xy + t * ray.direction.xy,
        vec2<f32>(ranges.x.low, ranges.y.low),
        vec2<f32>(ranges.x.high, ranges.y.high),
    );
    let jet = height_field_jet(field, p);
    return HeightFieldHit(kind, t, p, jet.height, jet.gradient);
}

// The first point of a ray on the surface with t between `reach.x` and `reach.y`. No hit for a zero
// direction, a component of 1e18 or more, and NaN.
fn height_field_intersect(
    field: HeightField,
    ranges: HeightFieldRanges,
    origin: vec3<f32>,
    direction: vec3<f32>,
    reach: vec2<f32>,
) -> HeightFieldHit {
    let none = HeightFieldHit(0u, 0.0, vec2<f32>(0.0, 0.0), 0.0, vec2<f32>(0.0, 0.0));
    let sane = height_field_is_sane(origin.x) && height_field_is_sane(origin.y) && height_field_is_sane(origin.z)
        && height_field_is_sane(direction.x) && height_field_is_sane(direction.y) && height_field_is_sane(direction.z);
    let speed = abs(direction);
    if !sane || !(speed.x + speed.y + speed.z > 0.0) {
        return none;
    }
    let heights = ranges.x.magnitude * ranges.y.magnitude;
    let falls = vec2<f32>(ranges.x.steepest * ranges.y.magnitude, ranges.x.magnitude * ranges.y.steepest);
    let pad = HEIGHT_FIELD_ROUNDING * (abs(origin) + vec3<f32>(ranges.x.reach, ranges.y.reach, heights));
    let blur = dot(falls, pad.xy) + pad.z;
    let off = ranges.x.magnitude * ranges.y.bound + ranges.y.magnitude * ranges.x.bound;
    let rates = speed.z + dot(speed.xy, falls);
    let ray = HeightFieldRay(origin, direction, pad, 16.0 * HEIGHT_FIELD_ROUNDING * rates, off + blur);
    var span = vec2<f32>(max(reach.x, 0.0), min(reach.y, 3e38));
    span = height_field_cut(span, origin.x, direction.x, ranges.x.low - pad.x, ranges.x.high + pad.x);
    span = height_field_cut(span, origin.y, direction.y, ranges.y.low - pad.y, ranges.y.high + pad.y);
    span = height_field_cut(span, origin.z, direction.z, -heights - pad.z, heights + pad.z);
    if !(span.x <= span.y) {
        return none;
    }
    let end = span.y;
    var t = span.x;
    var length = end - t;
    for (var k = 0u; k < HEIGHT_FIELD_STRETCHES; k++) {
        let stop = select(t + length, end, !(t + length < end));
        var stretch = height_field_narrowed(ranges, ray, vec2<f32>(t, stop));
        var free = !(stretch.span.x <= stretch.span.y);
        if !free && (stretch.rate.x > 0.0 || stretch.rate.y < 0.0) {
            let root = height_field_root(field, ray, stretch);
            if root.y > 0.0 {
                return height_field_hit(field, ranges, ray, root.x, 1u);
            }
            free = true;
        }
        if !free {
            // The ray may approach and leave again; there is no root as close as this.
            let above = height_field_above(field, ray, stretch.span.x).x;
            let clear = 0.999 * (abs(above) - ray.error);
            if !(clear > 0.0) {
                return height_field_hit(field, ranges, ray, stretch.span.x, 2u);
            }
            let rate = select(stretch.rate.y, -stretch.rate.x, above > 0.0);
            free = rate * (stretch.span.y - stretch.span.x) <= clear;
            if !free {
                let next = stretch.span.x + clear / rate;
                if !(next > t) {
                    return height_field_hit(field, ranges, ray, stretch.span.x, 2u);
                }
                t = next;
                length = 0.5 * (stretch.span.y - stretch.span.x);
            }
        }
        if free {
            if stop >= end {
                return none;
            }
            t = stop;
            length = length + length;
        }
    }
    return height_field_hit(field, ranges, ray, t, 2u);
}
