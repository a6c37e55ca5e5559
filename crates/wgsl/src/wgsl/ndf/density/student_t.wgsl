// The Student-t normal distribution of valid roughnesses alpha and an exponent gamma:
// `asperity_ndf_sampling::StudentT`, which uses 64 bits instead of 32.
//
// gamma = 2 is GGX, gamma to infinity Beckmann. The error of D is 1e-6 + 5e-7 a relative, with the
// exponent a of D.

// An exponent clamped to the valid range, 1.51 to 1e12; NaN becomes 2.
fn student_t_clamped_gamma(gamma: f32) -> f32 {
    let is_number = (bitcast<u32>(gamma) & 0x7fffffffu) <= 0x7f800000u;
    return select(2.0, clamp(gamma, 1.51, 1e12), is_number);
}

// D(m) in 1/sr, from the slope of m; 0 for m.z <= 0 and NaN. m.z must be at least 1e-9 or exactly
// 0.
fn student_t_d(alpha: vec2<f32>, gamma: f32, m: vec3<f32>) -> f32 {
    let up = select(1.0, m.z, m.z > 0.0);
    let x = m.x / alpha.x / up;
    let y = m.y / alpha.y / up;
    let square = x * x + y * y;
    if !(m.z > 0.0 && square <= ELEMENTARY_LARGEST) {
        return 0.0;
    }
    // The root of everything but the peak. Far out z^4 compensates for a power that would
    // underflow.
    let root = elementary_exp(-0.5 * gamma * elementary_ln_1p(square / (gamma - 1.0))) / max(up * up, ELEMENTARY_LEAST_NORMAL);
    let peak = 1.0 / (3.1415927 * alpha.x * alpha.y);
    return min(root * (root * peak), ELEMENTARY_LARGEST);
}

// The normal with the direction of z in the stretched space, beyond which the fraction
// exp(-|z|^2/2) of the normals is tilted.
fn student_t_tilted(alpha: vec2<f32>, gamma: f32, z: vec2<f32>) -> vec3<f32> {
    let t = 0.5 * (z.x * z.x + z.y * z.y) / (gamma - 1.0);
    let root = elementary_exp(-0.5 * t);
    let per_rho = sqrt(0.5 * elementary_one_minus_exp_ratio(t, root));
    let x = alpha.x * (z.x * per_rho);
    let y = alpha.y * (z.y * per_rho);
    let m = roughness_unit(vec3<f32>(x, y, max(root, ELEMENTARY_LEAST_NORMAL)));
    return vec3<f32>(m.x, m.y, max(m.z, ELEMENTARY_LEAST_NORMAL));
}

// T(z): the normal of Gaussian coordinates, clamped to 13; 0 for NaN.
fn student_t_warp_gaussian(alpha: vec2<f32>, gamma: f32, z: vec2<f32>) -> vec3<f32> {
    return student_t_tilted(alpha, gamma, vec2<f32>(elementary_bounded(z.x, 13.0), elementary_bounded(z.y, 13.0)));
}

// The inverse of T: the Gaussian coordinates of the normal m, whose slope alone is used; finite for
// every m.
fn student_t_invert(alpha: vec2<f32>, gamma: f32, m: vec3<f32>) -> vec2<f32> {
    let up = select(ELEMENTARY_LEAST_NORMAL, m.z, m.z > ELEMENTARY_LEAST_NORMAL);
    let slope = vec2<f32>(m.x / alpha.x / up, m.y / alpha.y / up);
    if !(abs(slope.x) <= ELEMENTARY_LARGEST && abs(slope.y) <= ELEMENTARY_LARGEST) {
        return vec2<f32>(0.0, 0.0);
    }
    // Scaled by 1e-20 where squares would overflow.
    let is_far = max(abs(slope.x), abs(slope.y)) > 1e18;
    let q = slope * select(1.0, 1e-20, is_far);
    let t = sqrt(q.x * q.x + q.y * q.y);
    if !(t > 0.0) {
        return vec2<f32>(0.0, 0.0);
    }
    var rho = t * 1.4142135;
    let scale = gamma - 1.0;
    if is_far {
        rho = sqrt(2.0 * scale * (2.0 * (elementary_ln(t) + 46.0517) - elementary_ln(scale)));
    } else if t * t / scale > 1e-10 {
        rho = sqrt(2.0 * scale * elementary_ln_1p(t * t / scale));
    }
    let per_t = rho / t;
    return clamp(vec2<f32>(q.x * per_t, q.y * per_t), vec2<f32>(-13.0), vec2<f32>(13.0));
}

// A normal with the density D over the macro surface, from uniform u in the unit square.
fn student_t_sample(alpha: vec2<f32>, gamma: f32, u: vec2<f32>) -> vec3<f32> {
    let bounded = elementary_probabilities(u);
    let rho = sqrt(-2.0 * elementary_ln_1p(-bounded.x));
    return student_t_tilted(alpha, gamma, elementary_cos_sin_turns(bounded.y) * rho);
}

// Smith's Lambda(v), for |v| < 1e12; the largest float where it is infinite, at and below the
// horizon.
fn student_t_lambda(alpha: vec2<f32>, gamma: f32, v: vec3<f32>) -> f32 {
    let spread = roughness_spread(alpha, v);
    if !(v.z > 0.0 && spread <= ELEMENTARY_LARGEST) {
        return ELEMENTARY_LARGEST;
    }
    if !(spread > 0.0) {
        return 0.0;
    }
    let z = v.z / spread;
    return min(student_distribution_excess(student_distribution(2.0 * gamma - 2.0), z) / max(z, 1e-37), ELEMENTARY_LARGEST);
}

// Masking G1(v): the visible fraction of the facets that face v.
fn student_t_masking(alpha: vec2<f32>, gamma: f32, v: vec3<f32>) -> f32 {
    return microfacet_masking(student_t_lambda(alpha, gamma, v));
}

// Height-correlated masking and shadowing G2(v, w).
fn student_t_masking_shadowing(alpha: vec2<f32>, gamma: f32, v: vec3<f32>, w: vec3<f32>) -> f32 {
    return microfacet_masking_shadowing(student_t_lambda(alpha, gamma, v), student_t_lambda(alpha, gamma, w));
}

// sigma(v): the projected area of the facets that v sees, per area of the macro surface.
fn student_t_projected_area(alpha: vec2<f32>, gamma: f32, v: vec3<f32>) -> f32 {
    let above = microfacet_above(v);
    let spread = roughness_spread(alpha, above);
    if !(spread > 0.0) {
        return above.z;
    }
    let along = student_distribution(2.0 * gamma - 2.0);
    return above.z + spread * student_distribution_excess(along, above.z / spread);
}

// The density of visible normals D_v(m), in 1/sr.
fn student_t_visible_pdf(alpha: vec2<f32>, gamma: f32, v: vec3<f32>, m: vec3<f32>) -> f32 {
    let area = student_t_projected_area(alpha, gamma, v);
    return microfacet_visible_pdf(student_t_d(alpha, gamma, m), microfacet_above(v), m, area);
}

// A normal with the density D_v over solid angle, for uniform u. The slope along the view is found
// by inversion of its distribution. Given that slope, the slope across the view is Student-t
// distributed and found by its quantile.
fn student_t_sample_visible(alpha: vec2<f32>, gamma: f32, v: vec3<f32>, u: vec2<f32>) -> vec3<f32> {
    let bounded = elementary_probabilities(u);
    let w = microfacet_above(v) * vec3<f32>(alpha, 1.0);
    let lateral = sqrt(w.x * w.x + w.y * w.y);
    // Along x if the view has no azimuth.
    var cosine = 1.0;
    var sine = 0.0;
    var view = 1e6;
    if lateral > 0.0 {
        cosine = w.x / lateral;
        sine = w.y / lateral;
        view = min(1.4142135 * w.z / lateral, 1e6);
    }
    let freedom = 2.0 * gamma - 2.0;
    let along = student_distribution_solve(student_distribution(freedom), true, view, bounded.x);
    let spread = sqrt((freedom + along * along) / (freedom + 1.0));
    let across = student_distribution_solve(student_distribution(freedom + 1.0), false, 0.0, bounded.y) * spread;
    let x = (along * cosine - across * sine) * alpha.x;
    let y = (along * sine + across * cosine) * alpha.y;
    // The slope is (x, y)/sqrt(2), whose square may overflow.
    let per_largest = 1.0 / max(max(abs(x), abs(y)), 1.0);
    let m = roughness_unit(vec3<f32>(x * per_largest, y * per_largest, 1.4142135 * per_largest));
    return vec3<f32>(m.x, m.y, max(m.z, ELEMENTARY_LEAST_NORMAL));
}
