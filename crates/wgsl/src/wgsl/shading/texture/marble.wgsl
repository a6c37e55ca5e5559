// Blue marble, a color spline over a sum of noise: `asperity_shading::Marble`.

// The sum as resolved by a pixel, the variance of the rest, and the variance of the sum within the
// pixel.
struct MarbleSum {
    sum: f32,
    removed: f32,
    within: f32,
}

// Coefficients of a piece of the spline, its index, and the position in it.
struct MarblePiece {
    constant: vec3<f32>,
    linear: vec3<f32>,
    square: vec3<f32>,
    cube: vec3<f32>,
    index: u32,
    place: f32,
}

// Colors; each piece has four. Selected by bits, as HLSL compilers reject a computed list, and with
// thirteen cases at every call other compilers took minutes.
fn marble_knot(i: u32) -> vec3<f32> {
    var color = vec3<f32>(0.25, 0.25, 0.35);
    color = select(color, vec3<f32>(0.1, 0.1, 0.3), ((0x1cu >> i) & 1u) == 1u);
    color = select(color, vec3<f32>(0.05, 0.05, 0.26), ((0x180u >> i) & 1u) == 1u);
    return select(color, vec3<f32>(0.03, 0.03, 0.2), ((0x1600u >> i) & 1u) == 1u);
}

// Integrals of the pieces before each.
fn marble_before(i: u32) -> vec3<f32> {
    switch i {
        case 0u: { return vec3<f32>(0.0, 0.0, 0.0); }
        case 1u: { return vec3<f32>(0.175, 0.175, 0.325); }
        case 2u: { return vec3<f32>(0.26875, 0.26875, 0.6229167); }
        case 3u: { return vec3<f32>(0.3625, 0.3625, 0.92083335); }
        case 4u: { return vec3<f32>(0.5375, 0.5375, 1.2458334); }
        case 5u: { return vec3<f32>(0.8020834, 0.8020834, 1.6016667); }
        case 6u: { return vec3<f32>(0.95208335, 0.95208335, 1.9066668); }
        case 7u: { return vec3<f32>(0.99458337, 0.99458337, 2.1654167); }
        case 8u: { return vec3<f32>(1.0345833, 1.0345833, 2.3954167); }
        default: { return vec3<f32>(1.0545833, 1.0545833, 2.5866668); }
    }
}

fn marble_piece(x: f32) -> MarblePiece {
    let along = math_clamped(x, 1.0) * 10.0;
    let index = min(u32(along), 9u);
    let a = marble_knot(index);
    let b = marble_knot(index + 1u);
    let c = marble_knot(index + 2u);
    let d = marble_knot(index + 3u);
    let square = a - 2.5 * b + 2.0 * c - 0.5 * d;
    return MarblePiece(b, 0.5 * (c - a), square, 1.5 * (b - c) + 0.5 * (d - a), index, along - f32(index));
}

// The spline at x in [0, 1], constant beyond its ends.
fn marble_spline(x: f32) -> vec3<f32> {
    let piece = marble_piece(x);
    let t = piece.place;
    return piece.constant + t * (piece.linear + t * (piece.square + t * piece.cube));
}

// An end of an interval of the spline, and the integral from 0 to it.
struct MarbleEnd {
    x: f32,
    area: vec3<f32>,
}

fn marble_end(x: f32) -> MarbleEnd {
    let piece = marble_piece(x);
    let t = piece.place;
    let color = piece.constant + t * (piece.linear + t * (piece.square + t * piece.cube));
    let within = t * (piece.constant + t * (piece.linear / 2.0 + t * (piece.square / 3.0 + t * piece.cube / 4.0)));
    let beyond = max(x - 1.0, 0.0) + min(x, 0.0);
    return MarbleEnd(x, (marble_before(piece.index) + within) / 10.0 + color * beyond);
}

// The mean of the spline between two positions.
fn marble_mean(start: MarbleEnd, end: MarbleEnd) -> vec3<f32> {
    let width = end.x - start.x;
    // Below this width the difference of areas has fewer digits than the polynomial in the middle.
    if width > 0.01 {
        return (end.area - start.area) / width;
    }
    return marble_spline(0.5 * (start.x + end.x));
}

// The sum of octaves of noise, filtered over a pixel of this width; unfiltered for a width of 0.
fn marble_sum(marble: Marble, p: vec3<f32>, width: f32) -> MarbleSum {
    var resolved = MarbleSum(0.0, 0.0, 0.0);
    var frequency = 1.0;
    for (var i = 0u; i < 4u; i++) {
        let kept = 1.0 - frequency_clamp_filtered_fraction(0.5 * width, marble.scale * frequency);
        let whole = (marble.deviation / frequency) * (marble.deviation / frequency);
        if kept > 0.0 {
            let key = select(
                select(marble.keys.x, marble.keys.y, i == 1u), select(marble.keys.z, marble.keys.w, i == 3u), i >= 2u,
            );
            let octave = perlin_noise_3d(p * (marble.scale * frequency), key);
            resolved.sum += kept / frequency * octave.value;
            // A surface intersects two of three directions of space. A line varies without bound,
            // noise by its variance.
            let rate = min(kept * marble.scale * width, 1e15);
            let line = dot(octave.gradient, octave.gradient) * rate * rate / 18.0;
            if line > 0.0 {
                resolved.within += line * whole / (line + whole);
            }
        }
        resolved.removed += (1.0 - kept * kept) * whole;
        frequency *= 2.17;
    }
    return resolved;
}

// The distribution function at part k of sixteen, from 1.
fn marble_cdf(marble: Marble, k: u32) -> f32 {
    let index = (k - 1u) >> 2u;
    var row = marble.cdf[0];
    if index == 1u {
        row = marble.cdf[1];
    } else if index == 2u {
        row = marble.cdf[2];
    } else if index == 3u {
        row = marble.cdf[3];
    }
    let column = (k - 1u) & 3u;
    return select(select(row.x, row.y, column == 1u), select(row.z, row.w, column == 3u), column >= 2u);
}

// The color filtered over a pixel of this width: `Marble::color`. All in one loop, since functions
// are compiled at every call.
fn marble_color(marble: Marble, p: vec3<f32>, footprint: f32) -> vec3<f32> {
    let resolved = marble_sum(marble, p, footprint);
    // The sixteen parts of the distribution of the unresolved sum. If everything is resolved, the
    // parts of an interval, whose variance is a twelfth of its square.
    let is_interval = resolved.removed == 0.0;
    let parts = select(16u, 1u, is_interval);
    let deviation = sqrt(select(resolved.removed + resolved.within, 3.0 * resolved.within, is_interval));
    var mean = vec3<f32>(0.0);
    var below = 0.0;
    var start = MarbleEnd(0.0, vec3<f32>(0.0));
    for (var k = 0u; k <= parts; k++) {
        let at = select(8.0 * f32(k) / 16.0 - 4.0, 2.0 * f32(k) - 1.0, is_interval);
        let end = marble_end(2.0 * (resolved.sum + deviation * at) + 0.75);
        if k > 0u {
            let above = select(marble_cdf(marble, k), 1.0, is_interval);
            mean += (above - below) * marble_mean(start, end);
            below = above;
        }
        start = end;
    }
    return mean;
}
