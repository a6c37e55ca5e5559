// Simplex noise, `asperity_noise::Simplex`: gradient noise on the simplicial lattice. Values are
// clamped to [-1, 1].
//
// `simplex_*` have kernels of r^2 = 1/2, which are continuous. `simplex_classic_*` have the customary
// r^2 = 0.6, which is discontinuous at the faces of simplices, like
// `asperity_noise::Simplex::with_classic_radius`. Corners are lanes. From |x| + |y| + ... = 2^22 on the noise is
// 0.

// In two, three and four dimensions.
const SIMPLEX_SKEW: vec3<f32> = vec3<f32>(0.3660254, 0.33333334, 0.309017);
const SIMPLEX_UNSKEW: vec3<f32> = vec3<f32>(0.21132487, 0.16666667, 0.1381966);
// The inverses of the maximum sums.
const SIMPLEX_SCALE: vec3<f32> = vec3<f32>(70.73889, 76.8806, 62.777576);
const SIMPLEX_WIDE_SCALE: vec3<f32> = vec3<f32>(24.693579, 32.69582, 27.225628);
// Kernels are 0 up to here.
const SIMPLEX_GAP: f32 = 0.0009765625;
const SIMPLEX_REACH: f32 = 4194304.0;
const SIMPLEX_REACH_BITS: u32 = 0x4a800000u;

// Whether a point is within reach. Compares bits first, as compilers may assume that no number is
// infinite.
fn simplex_is_within(p: vec4<f32>) -> bool {
    if cell_magnitude_bits(p) >= SIMPLEX_REACH_BITS {
        return false;
    }
    let x = abs(p);
    return ((x.x + x.y) + x.z) + x.w < SIMPLEX_REACH;
}

// r^2 - |d|^2 above the gap.
fn simplex_beyond_gap(t: vec4<f32>) -> vec4<f32> {
    return select(vec4<f32>(0.0), t, t > vec4<f32>(SIMPLEX_GAP));
}

fn simplex_kernel(t: vec4<f32>) -> vec4<f32> {
    let square = t * t;
    return square * square;
}

// 8 t^3 s, the factor of the offset in a term's gradient.
fn simplex_pull(t: vec4<f32>, s: vec4<f32>) -> vec4<f32> {
    return 8.0 * (t * t * t) * s;
}

// Positions of four corners along an axis, one step ahead where `ahead`.
fn simplex_corners(first: f32, ahead: vec4<bool>) -> vec4<f32> {
    return select(vec4<f32>(first), vec4<f32>(first + 1.0), ahead);
}

// The terms of the corners along an axis, one by one, as GLSL ES 3.00 cannot select integer
// vectors.
fn simplex_terms(low: u32, high: u32, ahead: vec4<bool>) -> vec4<u32> {
    return vec4<u32>(
        select(low, high, ahead.x), select(low, high, ahead.y), select(low, high, ahead.z), select(low, high, ahead.w),
    );
}

// The sum at p, with cells of the skewed lattice relative to `cell`.
fn simplex_sum_2d(cell: vec2<i32>, p: vec2<f32>, radius_squared: f32, scale: f32, key: u32) -> Sample2d {
    if !simplex_is_within(vec4<f32>(p, 0.0, 0.0)) {
        return Sample2d(0.0, vec2<f32>(0.0));
    }
    let first = floor(p + (p.y + p.x) * SIMPLEX_SKEW.x);
    let low = p - first;
    let x_first = low.y < low.x;
    let ahead_x = vec4<bool>(false, x_first, true, true);
    let ahead_y = vec4<bool>(false, !x_first, true, true);

    let ends = integer_hash_ends_2d(cell + vec2<i32>(first));
    let x_terms = simplex_terms(ends.low.x, ends.high.x, ahead_x) + key;
    let words = integer_hash_upper_words(x_terms ^ simplex_terms(ends.low.y, ends.high.y, ahead_y));
    let g = edge_directions_2d(words, scale);

    let back = ((first.x + first.y) + vec4<f32>(0.0, 1.0, 2.0, 2.0)) * SIMPLEX_UNSKEW.x;
    let dx = p.x - (simplex_corners(first.x, ahead_x) - back);
    let dy = p.y - (simplex_corners(first.y, ahead_y) - back);
    let t = simplex_beyond_gap((radius_squared - dy * dy) - dx * dx);
    let s = g.y * dy + g.x * dx;
    let kernel = simplex_kernel(t);
    let pull = simplex_pull(t, s);
    let value = kernel * s;
    let x = g.x * kernel - dx * pull;
    let y = g.y * kernel - dy * pull;
    return Sample2d(clamp((value.x + value.y) + value.z, -1.0, 1.0), vec2<f32>((x.x + x.y) + x.z, (y.x + y.y) + y.z));
}

fn simplex_added(v: vec4<f32>) -> f32 {
    return ((v.x + v.y) + v.z) + v.w;
}

// The corners of the simplex around a point: the offsets from them, and their terms of the hash
// along x and along the other axes.
struct SimplexCorners3d {
    dx: vec4<f32>,
    dy: vec4<f32>,
    dz: vec4<f32>,
    x_terms: vec4<u32>,
    terms: vec4<u32>,
}

fn simplex_corners_3d(cell: vec3<i32>, p: vec3<f32>) -> SimplexCorners3d {
    let first = floor(p + ((p.z + p.y) + p.x) * SIMPLEX_SKEW.y);
    let low = p - first;
    // Comparisons of the axes along which the point is farther.
    let xy = low.y < low.x;
    let xz = low.z < low.x;
    let yz = low.z < low.y;
    let ahead_x = vec4<bool>(false, xy && xz, xy || xz, true);
    let ahead_y = vec4<bool>(false, !xy && yz, !xy || yz, true);
    let ahead_z = vec4<bool>(false, !xz && !yz, !xz || !yz, true);

    let ends = integer_hash_ends_3d(cell + vec3<i32>(first));
    let back = (((first.x + first.y) + first.z) + vec4<f32>(0.0, 1.0, 2.0, 3.0)) * SIMPLEX_UNSKEW.y;
    return SimplexCorners3d(
        p.x - (simplex_corners(first.x, ahead_x) - back),
        p.y - (simplex_corners(first.y, ahead_y) - back),
        p.z - (simplex_corners(first.z, ahead_z) - back),
        simplex_terms(ends.low.x, ends.high.x, ahead_x),
        simplex_terms(ends.low.y, ends.high.y, ahead_y) ^ simplex_terms(ends.low.z, ends.high.z, ahead_z),
    );
}

// The sum over the corners with gradients g times one scale each, before clamping.
fn simplex_corner_sum_3d(at: SimplexCorners3d, g: EdgeDirections3d, scale: vec4<f32>, radius_squared: f32) -> Sample3d {
    let gx = g.x * scale;
    let gy = g.y * scale;
    let gz = g.z * scale;
    let t = simplex_beyond_gap(((radius_squared - at.dy * at.dy) - at.dz * at.dz) - at.dx * at.dx);
    let s = (gy * at.dy + gz * at.dz) + gx * at.dx;
    let kernel = simplex_kernel(t);
    let pull = simplex_pull(t, s);
    return Sample3d(
        simplex_added(kernel * s),
        vec3<f32>(
            simplex_added(gx * kernel - at.dx * pull),
            simplex_added(gy * kernel - at.dy * pull),
            simplex_added(gz * kernel - at.dz * pull),
        ),
    );
}

fn simplex_sum_3d(cell: vec3<i32>, p: vec3<f32>, radius_squared: f32, scale: f32, key: u32) -> Sample3d {
    if !simplex_is_within(vec4<f32>(p, 0.0)) {
        return Sample3d(0.0, vec3<f32>(0.0));
    }
    let at = simplex_corners_3d(cell, p);
    let g = edge_directions_3d(integer_hash_upper_words((at.x_terms + key) ^ at.terms));
    let sum = simplex_corner_sum_3d(at, g, vec4<f32>(scale), radius_squared);
    return Sample3d(clamp(sum.value, -1.0, 1.0), sum.gradient);
}

// The terms of four corners, values and gradients.
struct SimplexTerms4d {
    value: vec4<f32>,
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
    w: vec4<f32>,
}

// From the offsets to the corners along each axis.
fn simplex_terms_4d(
    dx: vec4<f32>,
    dy: vec4<f32>,
    dz: vec4<f32>,
    dw: vec4<f32>,
    words: vec4<u32>,
    radius_squared: f32,
    scale: f32,
) -> SimplexTerms4d {
    let g = edge_directions_4d(words);
    let gx = g.x * scale;
    let gy = g.y * scale;
    let gz = g.z * scale;
    let gw = g.w * scale;
    let t = simplex_beyond_gap((((radius_squared - dy * dy) - dz * dz) - dw * dw) - dx * dx);
    let s = ((gy * dy + gz * dz) + gw * dw) + gx * dx;
    let kernel = simplex_kernel(t);
    let pull = simplex_pull(t, s);
    return SimplexTerms4d(
        kernel * s,
        gx * kernel - dx * pull,
        gy * kernel - dy * pull,
        gz * kernel - dz * pull,
        gw * kernel - dw * pull,
    );
}

fn simplex_sum_4d(cell: vec4<i32>, p: vec4<f32>, radius_squared: f32, scale: f32, key: u32) -> Sample4d {
    if !simplex_is_within(p) {
        return Sample4d(0.0, vec4<f32>(0.0));
    }
    let first = floor(p + (((p.w + p.z) + p.y) + p.x) * SIMPLEX_SKEW.z);
    let low = p - first;
    // For each axis the number of axes along which the point is less far.
    let xs = select(vec3<f32>(0.0), vec3<f32>(1.0), low.yzw < vec3<f32>(low.x));
    let ys = select(vec2<f32>(0.0), vec2<f32>(1.0), low.zw < vec2<f32>(low.y));
    let zw = select(0.0, 1.0, low.w < low.z);
    let ranks = vec4<f32>(
        xs.x + xs.y + xs.z,
        (1.0 - xs.x) + ys.x + ys.y,
        (1.0 - xs.y) + (1.0 - ys.x) + zw,
        (1.0 - xs.z) + (1.0 - ys.y) + (1.0 - zw),
    );
    let least = vec4<f32>(3.5, 2.5, 1.5, 0.5);
    let ahead_x = least < vec4<f32>(ranks.x);
    let ahead_y = least < vec4<f32>(ranks.y);
    let ahead_z = least < vec4<f32>(ranks.z);
    let ahead_w = least < vec4<f32>(ranks.w);

    let ends = integer_hash_ends(cell + vec4<i32>(first));
    let words = integer_hash_upper_words(
        (simplex_terms(ends.low.x, ends.high.x, ahead_x) + key)
            ^ simplex_terms(ends.low.y, ends.high.y, ahead_y)
            ^ simplex_terms(ends.low.z, ends.high.z, ahead_z)
            ^ simplex_terms(ends.low.w, ends.high.w, ahead_w),
    );
    let sum = ((first.x + first.y) + first.z) + first.w;
    let back = (sum + vec4<f32>(0.0, 1.0, 2.0, 3.0)) * SIMPLEX_UNSKEW.z;
    let four = simplex_terms_4d(
        p.x - (simplex_corners(first.x, ahead_x) - back),
        p.y - (simplex_corners(first.y, ahead_y) - back),
        p.z - (simplex_corners(first.z, ahead_z) - back),
        p.w - (simplex_corners(first.w, ahead_w) - back),
        words,
        radius_squared,
        scale,
    );
    let d = p - ((first + 1.0) - (sum + 4.0) * SIMPLEX_UNSKEW.z);
    let word = integer_hash_upper_word(ends.high.x, ends.high.y ^ ends.high.z ^ ends.high.w, key);
    let last = simplex_terms_4d(
        vec4<f32>(d.x), vec4<f32>(d.y), vec4<f32>(d.z), vec4<f32>(d.w), vec4<u32>(word), radius_squared, scale,
    );
    return Sample4d(
        clamp(simplex_added(four.value) + last.value.x, -1.0, 1.0),
        vec4<f32>(
            simplex_added(four.x) + last.x.x,
            simplex_added(four.y) + last.y.x,
            simplex_added(four.z) + last.z.x,
            simplex_added(four.w) + last.w.x,
        ),
    );
}

// For anchored octaves: cells of the skewed lattice are relative to `cell`, and p is the offset
// from it.
fn simplex_in_cell_2d(cell: vec2<i32>, p: vec2<f32>, key: u32) -> Sample2d {
    return simplex_sum_2d(cell, p, 0.5, SIMPLEX_SCALE.x, key);
}

fn simplex_in_cell_3d(cell: vec3<i32>, p: vec3<f32>, key: u32) -> Sample3d {
    return simplex_sum_3d(cell, p, 0.5, SIMPLEX_SCALE.y, key);
}

fn simplex_in_cell_4d(cell: vec4<i32>, p: vec4<f32>, key: u32) -> Sample4d {
    return simplex_sum_4d(cell, p, 0.5, SIMPLEX_SCALE.z, key);
}

// The noise at any point.
fn simplex_noise_2d(p: vec2<f32>, key: u32) -> Sample2d {
    return simplex_in_cell_2d(vec2<i32>(0), p, key);
}

fn simplex_noise_3d(p: vec3<f32>, key: u32) -> Sample3d {
    return simplex_in_cell_3d(vec3<i32>(0), p, key);
}

fn simplex_noise_4d(p: vec4<f32>, key: u32) -> Sample4d {
    return simplex_in_cell_4d(vec4<i32>(0), p, key);
}

// The wider kernel, relative to `cell`.
fn simplex_classic_in_cell_2d(cell: vec2<i32>, p: vec2<f32>, key: u32) -> Sample2d {
    return simplex_sum_2d(cell, p, 0.6, SIMPLEX_WIDE_SCALE.x, key);
}

fn simplex_classic_in_cell_3d(cell: vec3<i32>, p: vec3<f32>, key: u32) -> Sample3d {
    return simplex_sum_3d(cell, p, 0.6, SIMPLEX_WIDE_SCALE.y, key);
}

fn simplex_classic_in_cell_4d(cell: vec4<i32>, p: vec4<f32>, key: u32) -> Sample4d {
    return simplex_sum_4d(cell, p, 0.6, SIMPLEX_WIDE_SCALE.z, key);
}

// The wider kernel, at any point.
fn simplex_classic_noise_2d(p: vec2<f32>, key: u32) -> Sample2d {
    return simplex_classic_in_cell_2d(vec2<i32>(0), p, key);
}

fn simplex_classic_noise_3d(p: vec3<f32>, key: u32) -> Sample3d {
    return simplex_classic_in_cell_3d(vec3<i32>(0), p, key);
}

fn simplex_classic_noise_4d(p: vec4<f32>, key: u32) -> Sample4d {
    return simplex_classic_in_cell_4d(vec4<i32>(0), p, key);
}
