// Slopes of Gaussian noise in a tangent plane, N(0, I) at every point, and the height of the relief:
// `GaussianFbm::whitened_gradient` and `GaussianFbm::height`.

// The whitened gradient, the fraction of the whole spectrum's variance that it carries, in [0, 1),
// and the weight of the first octave, in [0, 1].
struct GaussianSlopes {
    z: vec2<f32>,
    resolved_variance: f32,
    fade: f32,
}

// The covariance of the gradient of one octave at a position in [0, 1]^3 of a cell: the diagonal, and
// the elements yz, zx, xy.
struct GaussianCovariance {
    diagonal: vec3<f32>,
    other: vec3<f32>,
}

fn gaussian_covariance_3d(t: vec3<f32>, high: vec3<f32>, slope: vec3<f32>) -> GaussianCovariance {
    let v = gaussian_variance(t, high, slope);
    let low = 1.0 - high;
    let rest = 1.0 - t;
    let low_t = low * t;
    let high_rest = high * rest;
    let slopes = slope * slope;
    // Sums over both ends of an axis, with weight w, its derivative w' and the distance d: w w',
    // w w' d, and w w' d^2 + w^2 d.
    let ws = 0.5 * v.dp;
    let ws_d = -slope * (high_rest + low_t);
    let mixed = slope * (high_rest * rest - low_t * t) + (low * low_t - high * high_rest);
    let linear = slopes * (t * t + rest * rest) + 2.0 * ws_d + v.p;
    let p = v.p.yzx * v.p.zxy;
    let q = v.p.yzx * v.q.zxy + v.q.yzx * v.p.zxy;
    return GaussianCovariance(
        2.0 * slopes * (p + 4.0 * q) + 4.0 * (p * linear),
        ws.yzx * ws.zxy * (v.p + 4.0 * v.q) + 4.0 * (v.p * (ws.zxy * mixed.yzx + ws.yzx * mixed.zxy)),
    );
}

// C v.
fn gaussian_covariance_times(c: GaussianCovariance, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        gaussian_slopes_product(vec3<f32>(c.diagonal.x, c.other.zy), v),
        gaussian_slopes_product(vec3<f32>(c.other.z, c.diagonal.y, c.other.x), v),
        gaussian_slopes_product(vec3<f32>(c.other.yx, c.diagonal.z), v),
    );
}

fn gaussian_slopes_product(a: vec3<f32>, b: vec3<f32>) -> f32 {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The inverse root of the covariance in the plane of two tangents times the slopes along them; 0 for
// parallel tangents. A common factor of the tangents has no effect.
fn gaussian_whitened(c: GaussianCovariance, gradient: vec3<f32>, tangent: vec3<f32>, bitangent: vec3<f32>) -> vec2<f32> {
    let both = max(abs(tangent), abs(bitangent));
    // A power of two: tangents are as long as the frequency of their octave.
    let exponent = bitcast<u32>(max(both.x, max(both.y, both.z))) & 0x7f800000u;
    let scale = bitcast<f32>(0x7f000000u - exponent);
    let u = scale * tangent;
    let v = scale * bitangent;
    let cu = gaussian_covariance_times(c, u);
    let uu = gaussian_slopes_product(cu, u);
    let uv = gaussian_slopes_product(cu, v);
    let vv = gaussian_slopes_product(gaussian_covariance_times(c, v), v);
    let square = uu * vv - uv * uv;
    if !(square > 0.0) {
        return vec2<f32>(0.0);
    }
    // The root of a matrix S is (S + d)/tau with d = sqrt(det S) and tau^2 = tr S + 2d.
    let d = sqrt(square);
    let factor = 1.0 / (d * sqrt(uu + vv + 2.0 * d));
    let x = gaussian_slopes_product(gradient, u);
    let y = gaussian_slopes_product(gradient, v);
    return vec2<f32>((vv + d) * x - uv * y, (uu + d) * y - uv * x) * factor;
}

// M v: a direction in an octave's own coordinates.
fn fbm_direction_3d(layer: FbmLayer3d, v: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        gaussian_slopes_product(layer.row_x.xyz, v),
        gaussian_slopes_product(layer.row_y.xyz, v),
        gaussian_slopes_product(layer.row_z.xyz, v),
    );
}

// One octave at a point: the noise before normalization, the position in its cell, and weights and
// slopes of the axes; not known if a coordinate is not finite.
struct GaussianOctave3d {
    sum: Sample3d,
    place: vec3<f32>,
    weights: vec3<f32>,
    slopes: vec3<f32>,
    known: bool,
}

fn gaussian_octave_3d(layer: FbmLayer3d, p: vec3<f32>) -> GaussianOctave3d {
    let at = cell_place_3d(fbm_point_3d(layer, p));
    if !at.known {
        let zero = vec3<f32>(0.0);
        return GaussianOctave3d(Sample3d(0.0, zero), zero, zero, zero, false);
    }
    let w = fade_quintic(vec4<f32>(at.place, 0.0)).xyz;
    let slope = fade_quintic_slope(vec4<f32>(at.place, 0.0)).xyz;
    let key = bitcast<u32>(layer.cell_and_key.w);
    let sum = gaussian_sum_in_cell_3d(layer.cell_and_key.xyz + at.cell, at.place, w, slope, key);
    return GaussianOctave3d(sum, at.place, w, slope, true);
}

// The whitened gradient of the first octaves of a sum in the plane of two tangents:
// `GaussianFbm::whitened_gradient_with_octaves`. For an anchored sum `p` is the difference to the
// anchor.
fn gaussian_slopes_3d(p: vec3<f32>, tangent: vec3<f32>, bitangent: vec3<f32>, octaves: f32, sum: u32) -> GaussianSlopes {
    let spectrum = fbm_spectrum_3d(sum);
    let whole = fbm_lone_whole(octaves, spectrum);
    let divisor = fbm_divisor(octaves, 0.0, spectrum);
    var z = vec2<f32>(0.0);
    var amplitude = 1.0;
    for (var i = 0u; i < 16u; i++) {
        let weight = min(whole - f32(i), 1.0);
        if !(weight > 0.0) {
            break;
        }
        let layer = fbm_layer_3d(sum, i);
        let octave = gaussian_octave_3d(layer, p);
        if octave.known {
            let covariance = gaussian_covariance_3d(octave.place, octave.weights, octave.slopes);
            let u = fbm_direction_3d(layer, tangent);
            let v = fbm_direction_3d(layer, bitangent);
            z += (weight * amplitude) * gaussian_whitened(covariance, octave.sum.gradient, u, v);
        }
        amplitude *= spectrum.gain;
    }
    return GaussianSlopes(
        z * divisor.factor,
        fbm_resolved_variance(octaves, divisor.squares, spectrum),
        fbm_fade(octaves, spectrum),
    );
}

// The height of the first octaves of a sum with its gradient: `GaussianFbm::height_with_octaves`.
fn gaussian_height_3d(p: vec3<f32>, octaves: f32, sum: u32) -> Sample3d {
    let spectrum = fbm_spectrum_3d(sum);
    let whole = fbm_lone_whole(octaves, spectrum);
    var value = 0.0;
    var gradient = vec3<f32>(0.0);
    var amplitude = 1.0;
    var frequency = 1.0;
    for (var i = 0u; i < 16u; i++) {
        let weight = min(whole - f32(i), 1.0);
        if !(weight > 0.0) {
            break;
        }
        let layer = fbm_layer_3d(sum, i);
        let octave = gaussian_octave_3d(layer, p);
        if octave.known {
            let factor = weight * amplitude / frequency;
            value += factor * octave.sum.value;
            gradient += factor * fbm_pull_back_3d(layer, octave.sum.gradient);
        }
        amplitude *= spectrum.gain;
        frequency *= spectrum.lacunarity;
    }
    // The reciprocal deviation of a slope over all positions.
    let factor = fbm_divisor(octaves, 0.0, spectrum).factor * 0.45973615;
    return Sample3d(value * factor, gradient * factor);
}
