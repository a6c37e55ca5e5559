// Seams of a carpet, lines or a grid with fewer threads: `asperity_shading::material::Seams`.

const SEAMS_NONE: u32 = 0u;
const SEAMS_LINES: u32 = 1u;
const SEAMS_GRID: u32 = 2u;
const SEAMS_PI: f32 = 3.1415927;
// The square of the minimum width of a crease, pi/20.
const SEAMS_LEAST_SQUARED: f32 = 0.024674013;

// An interval of phases around one; an interval without ends is equivalent to all phases.
struct SeamsStretch {
    ends: vec2<f32>,
    is_short: bool,
}

// (cos p, sin p).
fn seams_cos_sin(p: f32) -> vec2<f32> {
    return elementary_cos_sin_turns(p * 0.15915494);
}

// The phase across seams; between two seams if it is not finite.
fn seams_phase(across: vec2<f32>, uv: vec2<f32>) -> f32 {
    let p = dot(across, uv);
    return select(1.5707964, p, math_is_finite(p));
}

// The position in a period.
fn seams_place(p: f32) -> f32 {
    return p - floor(p / SEAMS_PI) * SEAMS_PI;
}

// The integral of |sin| from 0 to p.
fn seams_area(p: f32) -> f32 {
    let whole = floor(p / SEAMS_PI);
    return 2.0 * whole + 1.0 - seams_cos_sin(p - whole * SEAMS_PI).x;
}

// The mean of |sin| over an interval of this width around p, and its derivative by p.
fn seams_mean(p: f32, w: f32) -> vec2<f32> {
    if !(w <= 10000.0) {
        return vec2<f32>(0.63661975, 0.0);
    }
    let place = seams_place(p);
    let low = place - 0.5 * w;
    let high = place + 0.5 * w;
    return vec2<f32>(seams_area(high) - seams_area(low), abs(seams_cos_sin(high).y) - abs(seams_cos_sin(low).y)) / w;
}

fn seams_stretch(p: f32, width: f32) -> SeamsStretch {
    let w = sqrt(width * width + SEAMS_LEAST_SQUARED);
    let place = seams_place(p);
    return SeamsStretch(vec2<f32>(place - 0.5 * w, place + 0.5 * w), w < 10000.0);
}

// The distance of an end to the nearest seam; 0 for a long interval.
fn seams_bend(stretch: SeamsStretch, end: f32) -> f32 {
    let place = seams_place(end);
    return select(0.0, min(place, SEAMS_PI - place), stretch.is_short);
}

fn seams_until(p: f32, theta: f32, between: f32) -> f32 {
    let whole = floor(p / SEAMS_PI);
    return whole * between + clamp(p - whole * SEAMS_PI - theta, 0.0, max(between, 0.0));
}

// The fraction of an interval that is farther than theta from every seam.
fn seams_share(stretch: SeamsStretch, theta: f32) -> f32 {
    let between = SEAMS_PI - 2.0 * theta;
    if !stretch.is_short {
        return between / SEAMS_PI;
    }
    let length = stretch.ends.y - stretch.ends.x;
    return (seams_until(stretch.ends.y, theta, between) - seams_until(stretch.ends.x, theta, between)) / length;
}

// The derivative of the fraction by the phase, whose ends have these distances to seams.
fn seams_moved(stretch: SeamsStretch, bends: vec2<f32>, theta: f32) -> f32 {
    if !stretch.is_short {
        return 0.0;
    }
    return (select(0.0, 1.0, theta < bends.y) - select(0.0, 1.0, theta < bends.x)) / (stretch.ends.y - stretch.ends.x);
}

// The mean of the smaller of two |sin|, and its derivatives by both phases: four Gauss points
// between bends.
fn seams_mean_of_smaller(x: SeamsStretch, y: SeamsStretch) -> vec3<f32> {
    let of_x = vec2<f32>(seams_bend(x, x.ends.x), seams_bend(x, x.ends.y));
    let of_y = vec2<f32>(seams_bend(y, y.ends.x), seams_bend(y, y.ends.y));
    // In order: the smaller and the larger of either, then of both, with a quarter turn as the
    // last.
    let low = vec2<f32>(min(of_x.x, of_x.y), min(of_y.x, of_y.y));
    let high = vec2<f32>(max(of_x.x, of_x.y), max(of_y.x, of_y.y));
    let second = max(low.x, low.y);
    let third = min(high.x, high.y);
    let four = vec4<f32>(min(low.x, low.y), min(second, third), max(second, third), max(high.x, high.y));
    var crease = vec3<f32>(0.0);
    var start = 0.0;
    for (var k = 0u; k < 5u; k++) {
        var end = 1.5707964;
        if k < 4u {
            end = min(select(select(four.x, four.y, k == 1u), select(four.z, four.w, k == 3u), k >= 2u), 1.5707964);
        }
        let length = end - start;
        if !(length > 0.0) {
            continue;
        }
        for (var i = 0u; i < 4u; i++) {
            let outer = i == 0u || i == 3u;
            let from_middle = select(0.16999052, 0.43056816, outer);
            let place = select(0.5 - from_middle, 0.5 + from_middle, i >= 2u);
            let theta = start + place * length;
            let weight = select(0.32607257, 0.17392743, outer) * length * seams_cos_sin(theta).x;
            let of_first = seams_share(x, theta);
            let of_second = seams_share(y, theta);
            crease += weight * vec3<f32>(
                of_first * of_second, seams_moved(x, of_x, theta) * of_second, of_first * seams_moved(y, of_y, theta),
            );
        }
        start = end;
    }
    return crease;
}

// Mean height, from 0 at a seam to 1 between seams, and its derivatives by the phases across both
// sets of seams: `Seams::crease`. uv is multiplied by the frequency, and widths of the pixel are in
// phases.
fn seams_crease(pattern: u32, direction: vec2<f32>, uv: vec2<f32>, widths: vec2<f32>) -> vec3<f32> {
    let p = seams_phase(direction, uv);
    if pattern == SEAMS_LINES {
        let mean = seams_mean(p, sqrt(widths.x * widths.x + SEAMS_LEAST_SQUARED));
        return vec3<f32>(mean, 0.0);
    }
    if pattern == SEAMS_GRID {
        let other = seams_phase(direction_left_2d(direction), uv);
        return seams_mean_of_smaller(seams_stretch(p, widths.x), seams_stretch(other, widths.y));
    }
    return vec3<f32>(1.0, 0.0, 0.0);
}

// The variances of the unresolved slopes along both directions, for a pixel of these widths in
// phases: `Seams::removed_slopes`.
fn seams_removed_slopes(pattern: u32, widths: vec2<f32>) -> vec2<f32> {
    let w = sqrt(widths * widths + vec2<f32>(SEAMS_LEAST_SQUARED)) / SEAMS_PI;
    let left = 1.0 - min(w, vec2<f32>(1.0));
    let square = left * left;
    if pattern == SEAMS_LINES {
        let kept = square.x * (1.05 + (0.6 - 0.65 * left.x) * left.x);
        return vec2<f32>(max(0.5 * (0.932620938 - kept), 0.0), 0.0);
    }
    if pattern == SEAMS_GRID {
        let kept = square * (0.9 + (0.5 * left - 0.4) * left) * (0.76 + 0.24 * square.yx);
        return max(0.35132118 * (0.856041782 - kept), vec2<f32>(0.0));
    }
    return vec2<f32>(0.0);
}
