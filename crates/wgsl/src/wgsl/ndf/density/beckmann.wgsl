// The Beckmann normal distribution with valid roughnesses alpha along x and y:
// `asperity_ndf_sampling::Beckmann`.

// The density around the slope `mean`, in units of the roughnesses, whose square is `rest` times
// the square of alpha.
fn beckmann_lobe(alpha: vec2<f32>, mean: vec2<f32>, rest: f32, m: vec3<f32>) -> f32 {
    let up = select(1.0, m.z, m.z > 0.0);
    let x = m.x / alpha.x / up - mean.x;
    let y = m.y / alpha.y / up - mean.y;
    let exponent = -(x * x + y * y) / rest;
    // Beyond it the exponential of half the exponent is 0.
    if !(m.z > 0.0 && exponent > -174.0) {
        return 0.0;
    }
    // Far out the peak or z^4 compensates for an exponential that would underflow: D =
    // (exp(-a/2)/z^2)^2 peak.
    let near = exponent > -40.0;
    let falloff = elementary_exp(select(exponent * 0.5, exponent, near));
    let square = up * up;
    let peak = 1.0 / (3.1415927 * alpha.x * alpha.y * rest);
    let divisor = select(square, square * square, near);
    if !(divisor > 0.0) {
        return ELEMENTARY_LARGEST;
    }
    let ratio = falloff * select(1.0, peak, near) / divisor;
    return min(select(ratio * (ratio * peak), ratio, near), ELEMENTARY_LARGEST);
}

// D(m) in 1/sr, for unit m; 0 for m.z <= 0 and NaN.
fn beckmann_d(alpha: vec2<f32>, m: vec3<f32>) -> f32 {
    return beckmann_lobe(alpha, vec2<f32>(0.0, 0.0), 1.0, m);
}

// T(z): the normal of Gaussian coordinates, in standard deviations, clamped to 13; 0 for NaN.
fn beckmann_warp_gaussian(alpha: vec2<f32>, z: vec2<f32>) -> vec3<f32> {
    let x = elementary_bounded(z.x, 13.0) * (alpha.x * 0.70710677);
    let y = elementary_bounded(z.y, 13.0) * (alpha.y * 0.70710677);
    return roughness_unit(vec3<f32>(x, y, 1.0));
}

// The inverse of T: the Gaussian coordinates of the normal m, whose slope alone is used; finite for
// every m.
fn beckmann_invert(alpha: vec2<f32>, m: vec3<f32>) -> vec2<f32> {
    let up = 1.4142135 / select(ELEMENTARY_LEAST_NORMAL, m.z, m.z > ELEMENTARY_LEAST_NORMAL);
    let x = (m.x / alpha.x) * up;
    let y = (m.y / alpha.y) * up;
    return vec2<f32>(elementary_bounded(x, 13.0), elementary_bounded(y, 13.0));
}

// A normal with the density D over the macro surface, from uniform u in the unit square:
// `Beckmann::sample`.
fn beckmann_sample(alpha: vec2<f32>, u: vec2<f32>) -> vec3<f32> {
    let bounded = elementary_probabilities(u);
    let slope = sqrt(-elementary_ln_1p(-bounded.x));
    let turn = elementary_cos_sin_turns(bounded.y);
    return roughness_unit(vec3<f32>(slope * turn.x * alpha.x, slope * turn.y * alpha.y, 1.0));
}

// p_s(h | z_b) in 1/sr: a Beckmann density around the resolved slope.
fn beckmann_residual_ndf(alpha: vec2<f32>, h: vec3<f32>, split: GaussianSplit) -> f32 {
    return beckmann_lobe(alpha, split.z_b * (split.root * 0.70710677), split.rest, h);
}

// Smith's Lambda(v), for |v| < 1e12; the largest float where it is infinite, at and below the
// horizon.
fn beckmann_lambda(alpha: vec2<f32>, v: vec3<f32>) -> f32 {
    let spread = roughness_spread(alpha, v);
    if !(v.z > 0.0 && spread <= ELEMENTARY_LARGEST) {
        return ELEMENTARY_LARGEST;
    }
    if !(spread > 0.0) {
        return 0.0;
    }
    let z = v.z / spread;
    return min(gaussian_excess(z) / max(z, 1e-37), ELEMENTARY_LARGEST);
}

// Masking G1(v): the visible fraction of the facets that face v.
fn beckmann_masking(alpha: vec2<f32>, v: vec3<f32>) -> f32 {
    return microfacet_masking(beckmann_lambda(alpha, v));
}

// Height-correlated masking and shadowing G2(v, w).
fn beckmann_masking_shadowing(alpha: vec2<f32>, v: vec3<f32>, w: vec3<f32>) -> f32 {
    return microfacet_masking_shadowing(beckmann_lambda(alpha, v), beckmann_lambda(alpha, w));
}

// sigma(v): the projected area of the facets that v sees, per area of the macro surface.
fn beckmann_projected_area(alpha: vec2<f32>, v: vec3<f32>) -> f32 {
    let above = microfacet_above(v);
    let spread = roughness_spread(alpha, above);
    if !(spread > 0.0) {
        return above.z;
    }
    return above.z + spread * gaussian_excess(above.z / spread);
}

// The density of visible normals D_v(m), in 1/sr.
fn beckmann_visible_pdf(alpha: vec2<f32>, v: vec3<f32>, m: vec3<f32>) -> f32 {
    let area = beckmann_projected_area(alpha, v);
    return microfacet_visible_pdf(beckmann_d(alpha, m), microfacet_above(v), m, area);
}

// A normal with the density D_v over solid angle, for uniform u: the slope along the view by
// inversion, the slope across by its quantile.
fn beckmann_sample_visible(alpha: vec2<f32>, v: vec3<f32>, u: vec2<f32>) -> vec3<f32> {
    let bounded = elementary_probabilities(u);
    let w = roughness_stretched(alpha, v);
    let lateral = sqrt(w.x * w.x + w.y * w.y);
    // Along x if the view has no azimuth.
    var cosine = 1.0;
    var sine = 0.0;
    var view = 1e6;
    if lateral > 0.0 {
        let per_lateral = 1.0 / lateral;
        cosine = w.x * per_lateral;
        sine = w.y * per_lateral;
        view = min(w.z * per_lateral * 1.4142135, 1e6);
    }
    let along = visible_slopes_quantile(view, bounded.x);
    let across = inverse_gaussian_cdf(max(bounded.y, 2.3283064e-10));
    let x = (along * cosine - across * sine) * (alpha.x * 0.70710677);
    let y = (along * sine + across * cosine) * (alpha.y * 0.70710677);
    return roughness_unit(vec3<f32>(x, y, 1.0));
}
