// The Ashikhmin-Shirley normal distribution of the exponents n along x and y:
// `asperity_ndf_sampling::AshikhminShirley`, which computes D and the inverse of T in 64 bits.

// Exponents clamped to the valid range, 0 to 2e12; NaN becomes 0.
fn ashikhmin_shirley_clamped(n: vec2<f32>) -> vec2<f32> {
    return clamp(vec2<f32>(elementary_number(n.x), elementary_number(n.y)), vec2<f32>(0.0), vec2<f32>(2e12));
}

// D(m) in 1/sr, from the slope of m; 0 for m.z <= 0 and NaN. The error is 1e-6 + 5e-7 a relative,
// with the exponent a of D.
fn ashikhmin_shirley_d(n: vec2<f32>, m: vec3<f32>) -> f32 {
    if !(m.z > 0.0 && abs(m.x) <= ELEMENTARY_LARGEST && abs(m.y) <= ELEMENTARY_LARGEST) {
        return 0.0;
    }
    let x = clamp(m.x / m.z, -1e18, 1e18);
    let y = clamp(m.y / m.z, -1e18, 1e18);
    let across = x * x;
    let along = y * y;
    let square = across + along;
    var exponent = 0.0;
    if square > 0.0 {
        exponent = n.x * (across / square) + n.y * (along / square);
    }
    let peak = sqrt(n.x + 2.0) * sqrt(n.y + 2.0) / 6.2831855;
    return peak * elementary_exp(-0.5 * exponent * elementary_ln_1p(square));
}

// The normal of unbounded coordinates.
fn ashikhmin_shirley_tilted(n: vec2<f32>, z: vec2<f32>) -> vec3<f32> {
    let d = vec2<f32>(z.x * sqrt(2.0 / (n.x + 2.0)), z.y * sqrt(2.0 / (n.y + 2.0))) * 0.70710677;
    let square = d.x * d.x + d.y * d.y;
    let root = elementary_exp(-0.5 * square);
    let per_length = sqrt(elementary_one_minus_exp_ratio(square, root));
    return vec3<f32>(d.x * per_length, d.y * per_length, max(root, ELEMENTARY_LEAST_NORMAL));
}

// T(z): the normal of Gaussian coordinates, clamped to 13; 0 for NaN.
fn ashikhmin_shirley_warp_gaussian(n: vec2<f32>, z: vec2<f32>) -> vec3<f32> {
    return ashikhmin_shirley_tilted(n, vec2<f32>(elementary_bounded(z.x, 13.0), elementary_bounded(z.y, 13.0)));
}

// The inverse of T: the Gaussian coordinates of the normal m, whose slope alone is used; finite for
// every m.
fn ashikhmin_shirley_invert(n: vec2<f32>, m: vec3<f32>) -> vec2<f32> {
    if !(abs(m.x) <= ELEMENTARY_LARGEST && abs(m.y) <= ELEMENTARY_LARGEST) {
        return vec2<f32>(0.0, 0.0);
    }
    let up = select(ELEMENTARY_LEAST_NORMAL, m.z, m.z > ELEMENTARY_LEAST_NORMAL);
    // Scaled by 1e-20 where squares would overflow.
    let is_far = max(abs(m.x), abs(m.y)) > 1e18;
    let q = vec2<f32>(m.x, m.y) * select(1.0, 1e-20, is_far);
    let lateral = sqrt(q.x * q.x + q.y * q.y);
    if !(lateral > 0.0) {
        return vec2<f32>(0.0, 0.0);
    }
    let t = lateral / up;
    var length_of_d = t;
    if is_far || t > 1e18 {
        length_of_d = sqrt(2.0 * (elementary_ln(lateral) - elementary_ln(up) + select(0.0, 46.0517, is_far)));
    } else if t > 1e-5 {
        length_of_d = sqrt(elementary_ln_1p(t * t));
    }
    let per_lateral = length_of_d / lateral;
    let x = sqrt(n.x + 2.0) * (q.x * per_lateral);
    let y = sqrt(n.y + 2.0) * (q.y * per_lateral);
    return clamp(vec2<f32>(x, y), vec2<f32>(-13.0), vec2<f32>(13.0));
}

// A normal with the density D over the macro surface, from uniform u in the unit square.
fn ashikhmin_shirley_sample(n: vec2<f32>, u: vec2<f32>) -> vec3<f32> {
    let bounded = elementary_probabilities(u);
    let rho = sqrt(-2.0 * elementary_ln_1p(-bounded.x));
    return ashikhmin_shirley_tilted(n, elementary_cos_sin_turns(bounded.y) * rho);
}
