// The Student-t normal density of valid roughnesses alpha and an exponent gamma: `asperity_ndf_sampling::StudentT`, which computes in
// 64 bits what is here in 32.
//
// gamma = 2 is GGX, gamma to infinity Beckmann. D to 1e-6 + 5e-7 a relative, with the exponent a of D.

// An exponent moved to the nearest valid one, 1.51 to 1e12; what is no number becomes 2.
fn student_t_clamped_gamma(gamma: f32) -> f32 {
    let is_number = (bitcast<u32>(gamma) & 0x7fffffffu) <= 0x7f800000u;
    return select(2.0, clamp(gamma, 1.51, 1e12), is_number);
}

// D(m) in 1/sr, of the slope of m; 0 for m.z <= 0 and what is no number, for m.z >= 1e-9 or exactly 0.
fn student_t_density(alpha: vec2<f32>, gamma: f32, m: vec3<f32>) -> f32 {
    let up = select(1.0, m.z, m.z > 0.0);
    let x = m.x / alpha.x / up;
    let y = m.y / alpha.y / up;
    let square = x * x + y * y;
    if !(m.z > 0.0 && square <= ELEMENTARY_LARGEST) {
        return 0.0;
    }
    // The root of it all but the peak: far out z^4 makes up for a power that would underflow.
    let root = elementary_exp(-0.5 * gamma * elementary_ln_1p(square / (gamma - 1.0))) / max(up * up, ELEMENTARY_LEAST_NORMAL);
    let peak = 1.0 / (3.1415927 * alpha.x * alpha.y);
    return min(root * (root * peak), ELEMENTARY_LARGEST);
}

// The normal with the direction of z in the stretched space, beyond which the share exp(-|z|^2/2) of the normals is tilted.
fn student_t_tilted(alpha: vec2<f32>, gamma: f32, z: vec2<f32>) -> vec3<f32> {
    let t = 0.5 * (z.x * z.x + z.y * z.y) / (gamma - 1.0);
    let root = elementary_exp(-0.5 * t);
    let per_rho = sqrt(0.5 * elementary_one_minus_exp_ratio(t, root));
    let x = alpha.x * (z.x * per_rho);
    let y = alpha.y * (z.y * per_rho);
    let m = roughness_unit(vec3<f32>(x, y, max(root, ELEMENTARY_LEAST_NORMAL)));
    return vec3<f32>(m.x, m.y, max(m.z, ELEMENTARY_LEAST_NORMAL));
}

// T(z): the normal of Gaussian coordinates; beyond 13 that bound, 0 for what is no number.
fn student_t_from_gaussian(alpha: vec2<f32>, gamma: f32, z: vec2<f32>) -> vec3<f32> {
    return student_t_tilted(alpha, gamma, vec2<f32>(elementary_bounded(z.x, 13.0), elementary_bounded(z.y, 13.0)));
}

// The inverse of T: the Gaussian coordinates of the normal m, of which only the slope counts; finite for every m.
fn student_t_to_gaussian(alpha: vec2<f32>, gamma: f32, m: vec3<f32>) -> vec2<f32> {
    let up = select(ELEMENTARY_LEAST_NORMAL, m.z, m.z > ELEMENTARY_LEAST_NORMAL);
    let slope = vec2<f32>(m.x / alpha.x / up, m.y / alpha.y / up);
    if !(abs(slope.x) <= ELEMENTARY_LARGEST && abs(slope.y) <= ELEMENTARY_LARGEST) {
        return vec2<f32>(0.0, 0.0);
    }
    // In units of 1e20 where squares would overflow.
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

// A normal with the density D over the macro surface, for uniform u in the unit square.
fn student_t_from_uniform(alpha: vec2<f32>, gamma: f32, u: vec2<f32>) -> vec3<f32> {
    let bounded = elementary_probabilities(u);
    let rho = sqrt(-2.0 * elementary_ln_1p(-bounded.x));
    return student_t_tilted(alpha, gamma, elementary_cos_sin_turns(bounded.y) * rho);
}

// Gamma(x + 1/2)/Gamma(x) for x > 0, by Tricomi and Erdelyi's series beyond x = 5.
fn student_t_gamma_ratio(x: f32) -> f32 {
    var above = 1.0;
    var below = 1.0;
    var y = x;
    for (var k = 0; k < 5; k++) {
        if y >= 5.0 {
            break;
        }
        above *= y;
        below *= y + 0.5;
        y += 1.0;
    }
    let t = 1.0 / (8.0 * y);
    let series = 1.0 - t * (1.0 - 0.5 * t * (1.0 + 5.0 * t * (1.0 - 1.05 * t * (1.0 + 19.0 * t))));
    return above / below * sqrt(y) * series;
}

// The mean excess E[max(0, X - z)] of Student's t with nu > 1 degrees of freedom, for z >= 0.
//
// Below the seam the mean beyond z less z times the tail by the series at 0, above it by Gauss's continued fraction without that
// difference. Either takes some fifteen terms at the seam.
fn student_t_excess(nu: f32, z: f32) -> f32 {
    if !(z < 1e18) {
        return 0.0;
    }
    let square = z * z;
    let peak = student_t_gamma_ratio(0.5 * nu) / sqrt(3.1415927 * nu);
    let density = peak * elementary_exp(-0.5 * (nu + 1.0) * elementary_ln_1p(square / nu));
    // nu + z^2 over nu - 1, times the density.
    let beyond = (nu + square) / (nu - 1.0) * density;
    if square < 2.0 * nu / (nu + 2.0) {
        let y = square / (nu + square);
        var term = 1.0;
        var sum = 1.0;
        for (var k = 0; k < 40; k++) {
            term *= (0.5 * (nu + 1.0) + f32(k)) / (1.5 + f32(k)) * y;
            sum += term;
            if term < 3e-8 * sum {
                break;
            }
        }
        return beyond - z * (0.5 - z * density * sum);
    }
    let c = 0.5 * nu;
    let ratio = nu / square;
    var d = 1.0;
    var change = ratio * 0.5 * c / (c * (c + 1.0));
    var k_sum = change;
    for (var n = 2; n < 80; n++) {
        let k = f32(n / 2);
        let is_odd = (n & 1) == 1;
        let m = select(k, 0.5 + k, is_odd);
        let above = select(c - 0.5 + k, c + k, is_odd);
        let a = ratio * m / (c + f32(n) - 1.0) * (above / (c + f32(n)));
        d = 1.0 / (1.0 + a * d);
        change *= d - 1.0;
        k_sum += change;
        if abs(change) < 3e-8 * k_sum {
            break;
        }
    }
    return beyond * (1.0 + (nu - 1.0) * k_sum / (1.0 + k_sum)) / nu;
}

// Smith's Lambda(v), for |v| < 1e12; the largest float where it is infinite, at and below the horizon.
fn student_t_lambda(alpha: vec2<f32>, gamma: f32, v: vec3<f32>) -> f32 {
    let spread = roughness_spread(alpha, v);
    if !(v.z > 0.0 && spread <= ELEMENTARY_LARGEST) {
        return ELEMENTARY_LARGEST;
    }
    if !(spread > 0.0) {
        return 0.0;
    }
    let z = v.z / spread;
    return min(student_t_excess(2.0 * gamma - 2.0, z) / max(z, 1e-37), ELEMENTARY_LARGEST);
}

// Masking G1(v): the visible share of the facets that face v.
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
    return above.z + spread * student_t_excess(2.0 * gamma - 2.0, above.z / spread);
}

// The density of visible normals D_v(m), in 1/sr.
fn student_t_visible_density(alpha: vec2<f32>, gamma: f32, v: vec3<f32>, m: vec3<f32>) -> f32 {
    let area = student_t_projected_area(alpha, gamma, v);
    return microfacet_visible_density(student_t_density(alpha, gamma, m), microfacet_above(v), m, area);
}
