// Smith masking and shadowing, and views from below: `asperity_ndf_sampling::Microfacet`.

// v if it is a direction above the horizon, normalized if its length is far from 1. Otherwise the
// direction on the horizon above v, or the zenith if v has no azimuth.
fn microfacet_above(v: vec3<f32>) -> vec3<f32> {
    let given = v.x * v.x + v.y * v.y + v.z * v.z;
    if v.z > 0.0 && given >= 0.25 && given <= 4.0 {
        return v;
    }
    let up = max(elementary_number(v.z), 0.0);
    let flat_part = vec3<f32>(elementary_number(v.x), elementary_number(v.y), up);
    let square = flat_part.x * flat_part.x + flat_part.y * flat_part.y + flat_part.z * flat_part.z;
    if !(square > 0.0 && square <= ELEMENTARY_LARGEST) {
        return vec3<f32>(0.0, 0.0, 1.0);
    }
    let per_length = 1.0 / sqrt(square);
    return vec3<f32>(flat_part.x * per_length, flat_part.y * per_length, flat_part.z * per_length);
}

// D_v(m) = D(m) max(0, v.m)/sigma(v), in 1/sr, for the density D(m), a view above the horizon and
// its projected area.
fn microfacet_visible_pdf(density: f32, v: vec3<f32>, m: vec3<f32>, area: f32) -> f32 {
    let cosine = v.x * m.x + v.y * m.y + v.z * m.z;
    let seen = density * select(0.0, cosine, cosine > 0.0) / area;
    return select(0.0, min(seen, ELEMENTARY_LARGEST), seen >= 0.0);
}

// G1 = 1/(1 + Lambda); 0 for the largest float, which represents an infinite Lambda.
fn microfacet_masking(lambda: f32) -> f32 {
    return select(0.0, 1.0 / (1.0 + lambda), lambda < ELEMENTARY_LARGEST);
}

// Height-correlated G2 = 1/(1 + Lambda(v) + Lambda(w)).
fn microfacet_masking_shadowing(lambda_v: f32, lambda_w: f32) -> f32 {
    let is_seen = lambda_v < ELEMENTARY_LARGEST && lambda_w < ELEMENTARY_LARGEST;
    return select(0.0, 1.0 / (1.0 + lambda_v + lambda_w), is_seen);
}
