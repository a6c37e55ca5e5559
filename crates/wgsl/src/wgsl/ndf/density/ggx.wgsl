// The GGX normal distribution with valid roughnesses alpha along x and y:
// `asperity_ndf_sampling::Ggx`.

// D(m) in 1/sr, for unit m; 0 for m.z <= 0 and NaN.
fn ggx_d(alpha: vec2<f32>, m: vec3<f32>) -> f32 {
    let x = m.x / alpha.x;
    let y = m.y / alpha.y;
    let t = (x * x + y * y) + m.z * m.z;
    let peak = 3.1415927 * alpha.x * alpha.y;
    let inverse = peak * t * t;
    let density = select(ELEMENTARY_LARGEST, min(1.0 / inverse, ELEMENTARY_LARGEST), inverse > 0.0);
    return select(0.0, density, m.z > 0.0 && t <= ELEMENTARY_LARGEST);
}

// T(z): the normal of Gaussian coordinates, in standard deviations, clamped to 13; 0 for NaN.
fn ggx_warp_gaussian(alpha: vec2<f32>, z: vec2<f32>) -> vec3<f32> {
    let x = elementary_bounded(z.x, 13.0);
    let y = elementary_bounded(z.y, 13.0);
    let half_square = (x * x + y * y) * 0.5;
    let up = elementary_exp(half_square * -0.5);
    let scale = sqrt(elementary_one_minus_exp_ratio(half_square, up) * 0.5);
    return roughness_unit(vec3<f32>(x * scale * alpha.x, y * scale * alpha.y, up));
}

// The inverse of T: the Gaussian coordinates of the normal m, whose slope alone is used; finite for
// every m.
fn ggx_invert(alpha: vec2<f32>, m: vec3<f32>) -> vec2<f32> {
    let up = select(ELEMENTARY_LEAST_NORMAL, m.z, m.z > ELEMENTARY_LEAST_NORMAL);
    let x = m.x / alpha.x;
    let y = m.y / alpha.y;
    let lateral = sqrt(x * x + y * y);
    if !(lateral > 0.0 && lateral <= ELEMENTARY_LARGEST) {
        return vec2<f32>(0.0, 0.0);
    }
    // Beyond 1e19 the square would overflow. Below 1e-5 it may underflow, and the logarithm is t^2
    // to the last bit.
    let t = min(lateral / up, 1e19);
    let rho = select(sqrt(elementary_ln_1p(t * t) * 2.0), t * 1.4142135, t < 1e-5);
    let per_lateral = rho / lateral;
    return clamp(vec2<f32>(x * per_lateral, y * per_lateral), vec2<f32>(-13.0), vec2<f32>(13.0));
}

// A normal with the density D over the macro surface, from uniform u in the unit square:
// `Ggx::sample`.
fn ggx_sample(alpha: vec2<f32>, u: vec2<f32>) -> vec3<f32> {
    let bounded = elementary_probabilities(u);
    let slope = sqrt(bounded.x);
    let turn = elementary_cos_sin_turns(bounded.y);
    let x = slope * turn.x * alpha.x;
    let y = slope * turn.y * alpha.y;
    return roughness_unit(vec3<f32>(x, y, sqrt(1.0 - bounded.x)));
}

// p_s(h | z_b) in 1/sr, the density of the unresolved part.
fn ggx_residual_ndf(alpha: vec2<f32>, h: vec3<f32>, split: GaussianSplit) -> f32 {
    return gaussian_split_weigh(split, ggx_d(alpha, h), ggx_invert(alpha, h));
}

// Smith's Lambda(v); the largest float where it is infinite, at and below the horizon.
fn ggx_lambda(alpha: vec2<f32>, v: vec3<f32>) -> f32 {
    let up = select(1.0, v.z, v.z > 0.0);
    let x = alpha.x * v.x / up;
    let y = alpha.y * v.y / up;
    let t = x * x + y * y;
    let lambda = 0.5 * t / (1.0 + sqrt(1.0 + t));
    return select(ELEMENTARY_LARGEST, lambda, v.z > 0.0 && t <= ELEMENTARY_LARGEST);
}

// Masking G1(v): the visible fraction of the facets that face v.
fn ggx_masking(alpha: vec2<f32>, v: vec3<f32>) -> f32 {
    return microfacet_masking(ggx_lambda(alpha, v));
}

// Height-correlated masking and shadowing G2(v, w).
fn ggx_masking_shadowing(alpha: vec2<f32>, v: vec3<f32>, w: vec3<f32>) -> f32 {
    return microfacet_masking_shadowing(ggx_lambda(alpha, v), ggx_lambda(alpha, w));
}

// sigma(v): the projected area of the facets that v sees, per area of the macro surface.
fn ggx_projected_area(alpha: vec2<f32>, v: vec3<f32>) -> f32 {
    let w = microfacet_above(v) * vec3<f32>(alpha, 1.0);
    return 0.5 * (w.z + sqrt(w.x * w.x + w.y * w.y + w.z * w.z));
}

// The density of visible normals D_v(m), in 1/sr.
fn ggx_visible_pdf(alpha: vec2<f32>, v: vec3<f32>, m: vec3<f32>) -> f32 {
    return microfacet_visible_pdf(ggx_d(alpha, m), microfacet_above(v), m, ggx_projected_area(alpha, v));
}

// The normal of a uniform direction c of the cap c.z >= -(1 - cut) z, for uniform u, in formulas
// that preserve sin.
fn ggx_cap(alpha: vec2<f32>, v: vec3<f32>, u: vec2<f32>, cut: f32) -> vec3<f32> {
    let bounded = elementary_probabilities(u);
    let stretched = roughness_stretched(alpha, v);
    let square = (stretched.x * stretched.x + stretched.y * stretched.y) + stretched.z * stretched.z;
    // A vector without direction is taken as the zenith.
    var w = vec3<f32>(0.0, 0.0, 1.0);
    if square > 1e-37 {
        let scale = 1.0 / sqrt(square);
        w = vec3<f32>(stretched.x * scale, stretched.y * scale, stretched.z * scale);
    }
    let removed = w.z * cut;
    let rest = (w.x * w.x + w.y * w.y) / (1.0 + w.z) + removed;
    let whole = 1.0 + w.z - removed;
    let below = bounded.y * whole;
    let above = (1.0 - bounded.y) * whole;
    let sin_theta = sqrt(below * (above + rest));
    let turn = elementary_cos_sin_turns(bounded.x);
    let x = (sin_theta * turn.x + w.x) * alpha.x;
    let y = (sin_theta * turn.y + w.y) * alpha.y;
    return roughness_unit(vec3<f32>(x, y, above + removed));
}

// A normal with the density D_v over solid angle, for uniform u.
fn ggx_sample_visible(alpha: vec2<f32>, v: vec3<f32>, u: vec2<f32>) -> vec3<f32> {
    return ggx_cap(alpha, v, u, 0.0);
}

// The part of the cap of a view above the horizon that reflects it below, at least.
fn ggx_cut(alpha: vec2<f32>, v: vec3<f32>) -> f32 {
    let least = min(min(alpha.x, alpha.y), 1.0);
    let reach = 1.0 + sqrt(v.x * v.x + v.y * v.y);
    let rough = least * least;
    let far = reach * reach;
    let high = v.z * v.z;
    return rough * (far + high) / (far + rough * high);
}

// A visible normal for reflections of v, for uniform u: `Ggx::sample_reflecting`.
fn ggx_sample_reflecting(alpha: vec2<f32>, v: vec3<f32>, u: vec2<f32>) -> vec3<f32> {
    let above = microfacet_above(v);
    return ggx_cap(alpha, above, u, ggx_cut(alpha, above));
}

// The density of ggx_sample_reflecting over solid angle, in 1/sr.
fn ggx_reflecting_pdf(alpha: vec2<f32>, v: vec3<f32>, m: vec3<f32>) -> f32 {
    let above = microfacet_above(v);
    let w = above * vec3<f32>(alpha, 1.0);
    let cut = ggx_cut(alpha, above);
    let cosine = above.x * m.x + above.y * m.y + above.z * m.z;
    let k = vec3<f32>(m.x / alpha.x, m.y / alpha.y, m.z);
    let is_up = 2.0 * cosine * m.z >= above.z;
    let along = w.x * k.x + w.y * k.y + w.z * k.z;
    let square = k.x * k.x + k.y * k.y + k.z * k.z;
    if !is_up && 2.0 * along * k.z < cut * w.z * square {
        return 0.0;
    }
    let area = 0.5 * ((1.0 - cut) * w.z + sqrt(w.x * w.x + w.y * w.y + w.z * w.z));
    return microfacet_visible_pdf(ggx_d(alpha, m), above, m, area);
}

// The view in the space where the distribution is a hemisphere, of unit length.
fn ggx_stretched_view(alpha: vec2<f32>, v: vec3<f32>) -> vec3<f32> {
    let w = microfacet_above(v) * vec3<f32>(alpha, 1.0);
    return w / sqrt(w.x * w.x + w.y * w.y + w.z * w.z);
}

// T_v(z): the visible normal of Gaussian coordinates, clamped to 13; 0 for NaN.
fn ggx_warp_visible(alpha: vec2<f32>, v: vec3<f32>, z: vec2<f32>) -> vec3<f32> {
    let w = ggx_stretched_view(alpha, v);
    let x = elementary_bounded(z.x, 13.0);
    let y = elementary_bounded(z.y, 13.0);
    let half_square = 0.5 * (x * x + y * y);
    let root = elementary_exp(-0.5 * half_square);
    let ratio = elementary_one_minus_exp_ratio(half_square, root);
    let up = max(root * root, 1e-30) * (1.0 + w.z);
    let rest = (w.x * w.x + w.y * w.y) / (1.0 + w.z);
    let sin_theta = sqrt(0.5 * ratio * (1.0 + w.z) * (up + rest));
    let m = vec3<f32>((x * sin_theta + w.x) * alpha.x, (y * sin_theta + w.y) * alpha.y, up);
    // The squares of the largest component neither vanish nor overflow.
    return roughness_unit(m / max(max(abs(m.x), abs(m.y)), abs(m.z)));
}

// The inverse of T_v: the Gaussian coordinates of a visible normal; finite for every m.
fn ggx_invert_visible(alpha: vec2<f32>, v: vec3<f32>, m: vec3<f32>) -> vec2<f32> {
    let w = ggx_stretched_view(alpha, v);
    let k = vec3<f32>(m.x / alpha.x, m.y / alpha.y, m.z);
    let square = k.x * k.x + k.y * k.y + k.z * k.z;
    if !(square > 0.0 && square <= ELEMENTARY_LARGEST) {
        return vec2<f32>(0.0, 0.0);
    }
    // All of these are multiples of |k|^2.
    let twice = 2.0 * (w.x * k.x + w.y * k.y + w.z * k.z);
    let x = twice * k.x - square * w.x;
    let y = twice * k.y - square * w.y;
    let up = twice * k.z;
    let cosine = twice * k.z - square * w.z;
    let lateral = sqrt(x * x + y * y);
    // By the sine where the cap is above its middle, where 1 - c.z would cancel.
    let whole = 1.0 + w.z;
    var rho_square = 0.0;
    if cosine > 0.0 {
        let rest = lateral * lateral / (square * (square + cosine) * whole);
        rho_square = -2.0 * elementary_ln_1p(-min(rest, 0.99999994));
    } else {
        rho_square = -2.0 * elementary_ln(max(up / (square * whole), ELEMENTARY_LEAST_NORMAL));
    }
    if !(lateral > 0.0) {
        return vec2<f32>(0.0, 0.0);
    }
    let per_lateral = sqrt(max(rho_square, 0.0)) / lateral;
    return vec2<f32>(elementary_bounded(x * per_lateral, 13.0), elementary_bounded(y * per_lateral, 13.0));
}

// p_v(m | z_b) in 1/sr, the density of the unresolved visible normals: `VisibleFacets::d`.
fn ggx_visible_facets_d(alpha: vec2<f32>, v: vec3<f32>, m: vec3<f32>, split: GaussianSplit) -> f32 {
    return gaussian_split_weigh(split, ggx_visible_pdf(alpha, v, m), ggx_invert_visible(alpha, v, m));
}

// A normal with this density, for two standard Gaussian numbers: `VisibleFacets::warp_gaussian`.
fn ggx_visible_facets_warp_gaussian(alpha: vec2<f32>, v: vec3<f32>, xi: vec2<f32>, split: GaussianSplit) -> vec3<f32> {
    return ggx_warp_visible(alpha, v, gaussian_split_join(split, xi));
}
