// A wall of bricks with grooves of mortar: `asperity_shading::Brick`.

struct BrickSample {
    // 1 in a brick, 0 in the mortar; as a mean, the fraction of the pixel.
    brick: f32,
    // The height over the depth of the grooves, in [0, 1], and its derivatives in texture
    // coordinates.
    height: f32,
    slope: vec2<f32>,
    // Column and row.
    cell: vec2<i32>,
}

// A pulse of period 1, or its integral: fractions of the plateau, of the rounded pulse, of its
// slope, and the length.
struct BrickPulse {
    step: f32,
    round: f32,
    slope: f32,
    length: f32,
}

// Narrower boxes are evaluated as points.
const BRICK_LEAST: f32 = 0.0009765625;
// Wider boxes are replaced by the mean.
const BRICK_MOST: f32 = 65536.0;

// The sample of coordinates that are not finite.
fn brick_nowhere() -> BrickSample {
    return BrickSample(0.0, 0.0, vec2<f32>(0.0), vec2<i32>(0));
}

// The fraction of bricks: `Brick::mean`.
fn brick_mean(brick: Brick) -> f32 {
    return (1.0 - 2.0 * brick.margin.x) * (1.0 - 2.0 * brick.margin.y);
}

// The shift of a row, in bricks.
fn brick_shift(row: i32) -> f32 {
    return select(0.5, 0.0, (row & 1) == 0);
}

// Integral coordinates as integers, saturated.
fn brick_saturated(x: vec2<f32>) -> vec2<i32> {
    let within = vec2<i32>(clamp(x, vec2<f32>(-2147483648.0), vec2<f32>(2147483520.0)));
    // One by one, as GLSL ES 3.00 cannot select integer vectors.
    return vec2<i32>(
        select(within.x, 2147483647, x.x >= 2147483648.0),
        select(within.y, 2147483647, x.y >= 2147483648.0),
    );
}

// The brick at a position in a row, where positions beyond the shift belong to the next brick.
fn brick_of(cell: vec2<i32>, shifted: f32) -> vec2<i32> {
    return vec2<i32>(cell.x + select(0, 1, shifted >= 1.0 && cell.x < 2147483647), cell.y);
}

// The pulse at f in [0, 1], with flanks of width m.
fn brick_pulse(m: f32, f: f32) -> BrickPulse {
    let flank = min(f, 1.0 - f);
    if flank >= m {
        return BrickPulse(1.0, 1.0, 0.0, 0.0);
    }
    let x = max(flank / m, 0.0);
    let sign = select(-1.0, 1.0, f < 0.5);
    return BrickPulse(0.0, x * x * (3.0 - 2.0 * x), sign * 6.0 * x * (1.0 - x) / m, 0.0);
}

// The integral of the rising flank up to x of its width.
fn brick_rise(m: f32, x: f32) -> f32 {
    return m * x * x * x * (1.0 - 0.5 * x);
}

// The integral of the pulse from 0 to f in [0, 1].
fn brick_pulse_integral(m: f32, f: f32) -> BrickPulse {
    let step = clamp(f - m, 0.0, 1.0 - 2.0 * m);
    var round = f - 0.5 * m;
    if f < m {
        round = brick_rise(m, f / m);
    } else if !(f <= 1.0 - m) {
        var fall = 0.0;
        if m > 0.0 {
            fall = brick_rise(m, max((1.0 - f) / m, 0.0));
        }
        round = 1.0 - m - fall;
    }
    return BrickPulse(step, round, 0.0, 0.0);
}

// The integral of the periodic pulse from 0 to x.
fn brick_antiderivative(m: f32, x: f32) -> BrickPulse {
    let whole = floor(x);
    let within = brick_pulse_integral(m, x - whole);
    let full = brick_pulse_integral(m, 1.0);
    return BrickPulse(whole * full.step + within.step, whole * full.round + within.round, 0.0, 0.0);
}

fn brick_rate(a: BrickPulse, b: BrickPulse, width: f32) -> BrickPulse {
    return BrickPulse(
        (b.step - a.step) / width, (b.round - a.round) / width, (b.slope - a.slope) / width, (b.length - a.length) / width,
    );
}

// The mean of the periodic pulse over a box of this width around x.
fn brick_pulse_over(m: f32, x: f32, width: f32) -> BrickPulse {
    if width < BRICK_LEAST {
        return brick_pulse(m, x - floor(x));
    }
    let left = x - 0.5 * width;
    let right = x + 0.5 * width;
    var mean = brick_rate(brick_antiderivative(m, left), brick_antiderivative(m, right), width);
    mean.slope = (brick_pulse(m, right - floor(right)).round - brick_pulse(m, left - floor(left)).round) / width;
    return mean;
}

// The integral of the pulse over every other row, from 0 to t.
fn brick_rows_antiderivative(m: f32, t: f32) -> BrickPulse {
    let pair = floor(0.5 * t);
    let within = t - 2.0 * pair;
    let full = brick_pulse_integral(m, 1.0);
    let part = brick_pulse_integral(m, min(within, 1.0));
    var slope = 0.0;
    if within < 1.0 {
        slope = brick_pulse(m, within).round;
    }
    return BrickPulse(pair * full.step + part.step, pair * full.round + part.round, slope, pair + min(within, 1.0));
}

// The means over a box around t of the even rows (parity 0) or the odd rows (1).
fn brick_rows_over(m: f32, t: f32, width: f32, parity: f32) -> BrickPulse {
    let low = t - 0.5 * width;
    let high = t + 0.5 * width;
    return brick_rate(brick_rows_antiderivative(m, low - parity), brick_rows_antiderivative(m, high - parity), width);
}

// The wall at a point: `Brick::sample`.
fn brick_sample(brick: Brick, uv: vec2<f32>) -> BrickSample {
    let p = uv / brick.cell;
    if !direction_is_finite(vec3<f32>(p, 0.0)) {
        return brick_nowhere();
    }
    let corner = floor(p);
    let cell = brick_saturated(corner);
    let shifted = (p.x - corner.x) + brick_shift(cell.y);
    let across = brick_pulse(brick.margin.x, shifted - floor(shifted));
    let up = brick_pulse(brick.margin.y, p.y - corner.y);
    return BrickSample(
        across.step * up.step,
        across.round * up.round,
        vec2<f32>(across.slope * up.round, across.round * up.slope) / brick.cell,
        brick_of(cell, shifted),
    );
}

// Widths of a box in bricks.
fn brick_box(brick: Brick, widths: vec2<f32>) -> vec2<f32> {
    let box = abs(widths / brick.cell);
    return vec2<f32>(select(BRICK_MOST, box.x, box.x <= BRICK_MOST), select(BRICK_MOST, box.y, box.y <= BRICK_MOST));
}

// The mean of the wall over a box with these sides in texture coordinates: `Brick::filtered`.
fn brick_filtered(brick: Brick, uv: vec2<f32>, widths: vec2<f32>) -> BrickSample {
    let p = uv / brick.cell;
    if !direction_is_finite(vec3<f32>(p, 0.0)) {
        return brick_nowhere();
    }
    let corner = floor(p);
    let cell = brick_saturated(corner);
    let box = brick_box(brick, widths);
    let s = p.x - corner.x;
    // Rows are counted from the even row at or below, so that positions stay small.
    let t = (p.y - corner.y) + select(1.0, 0.0, (cell.y & 1) == 0);
    var sample = BrickSample(0.0, 0.0, vec2<f32>(0.0), brick_of(cell, s + brick_shift(cell.y)));
    for (var parity = 0u; parity < 2u; parity++) {
        var row = BrickPulse(0.0, 0.0, 0.0, 0.0);
        if !(box.y < BRICK_LEAST) {
            row = brick_rows_over(brick.margin.y, t, box.y, f32(parity));
        } else if (t < 1.0) == (parity == 0u) {
            row = brick_pulse(brick.margin.y, t - floor(t));
        }
        let across = brick_pulse_over(brick.margin.x, s + 0.5 * f32(parity), box.x);
        sample.brick += across.step * row.step;
        sample.height += across.round * row.round;
        sample.slope += vec2<f32>(across.slope * row.round, across.round * row.slope) / brick.cell;
    }
    // Sums of fractions, rounded.
    sample.brick = math_clamped(sample.brick, 1.0);
    sample.height = math_clamped(sample.height, 1.0);
    return sample;
}
