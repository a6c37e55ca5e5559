// Frosted glass, Beckmann facets that reflect and refract:
// `asperity_shading::reflectance::RoughDielectric`.

struct RoughDielectric {
    alpha: f32,
    // The relative IOR, at least 0.01 from 1: see `rough_dielectric_index`.
    eta: f32,
    // A thin wall that transmits the fraction `tint` undeflected, or the surface of a body.
    wall: bool,
    tint: vec3<f32>,
}

// The nearest index with at least the minimum distance from 1.
fn rough_dielectric_index(eta: f32) -> f32 {
    return select(max(eta, 1.01), min(eta, 0.99), eta < 1.0);
}

// The fraction that is transmitted on the way through a wall at an angle: tint^(1/cos).
fn rough_dielectric_through_wall(tint: vec3<f32>, cosine: f32, eta: f32) -> vec3<f32> {
    let c = math_clamped(cosine, 1.0);
    let sine_squared = (1.0 - c * c) / (eta * eta);
    let longer = 1.0 / sqrt(max(1.0 - sine_squared, 0.000001));
    let share = math_shares(tint);
    let depth = vec3<f32>(
        elementary_ln(max(share.x, 1e-37)), elementary_ln(max(share.y, 1e-37)), elementary_ln(max(share.z, 1e-37)),
    ) * longer;
    let left = vec3<f32>(elementary_exp(depth.x), elementary_exp(depth.y), elementary_exp(depth.z));
    return math_shares(select(vec3<f32>(0.0), left, share > vec3<f32>(0.0)));
}

// The direction from which facets above look the same as from w.
fn rough_dielectric_up(w: vec3<f32>) -> vec3<f32> {
    return select(w, -w, w.z < 0.0);
}

// The fraction of light at this angle on the side of w that a facet reflects.
fn rough_dielectric_reflectance(glass: RoughDielectric, w: vec3<f32>, cosine: f32) -> f32 {
    if glass.wall {
        let once = dielectric_reflectance(glass.eta, cosine);
        return 2.0 * once / (1.0 + once);
    }
    if w.z < 0.0 {
        return dielectric_reflectance(dielectric_reversed(glass.eta), cosine);
    }
    return dielectric_reflectance(glass.eta, cosine);
}

// f_r in 1/sr; for directions on two sides the transmission.
fn rough_dielectric_eval(glass: RoughDielectric, wi: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    if !direction_have_sides(wi, wo) {
        return vec3<f32>(0.0);
    }
    let crosses = (wi.z < 0.0) != (wo.z < 0.0);
    var h = vec3<f32>(0.0);
    var incident = 0.0;
    var cosine = 0.0;
    var jacobian = 0.0;
    // The far side of a thin wall is seen through it, as if light came from above.
    var back = wi;
    if crosses && !glass.wall {
        let index_i = select(1.0, glass.eta, wi.z < 0.0);
        let index_o = select(glass.eta, 1.0, wi.z < 0.0);
        h = direction_unit_or_zero(rough_dielectric_up(wi * index_i + wo * index_o));
        let i = dot(wi, h);
        let o = dot(wo, h);
        let both = index_i * i + index_o * o;
        // A facet seen from the same side by both directions does not refract one into the other.
        if i * wi.z <= 0.0 || o * wo.z <= 0.0 || both == 0.0 {
            return vec3<f32>(0.0);
        }
        incident = abs(i);
        cosine = abs(o);
        jacobian = (index_i / both) * (index_i / both) * abs(i);
    } else {
        if crosses {
            back = vec3<f32>(wi.x, wi.y, -wi.z);
        }
        let sum = back + wo;
        h = rough_dielectric_up(direction_half(back, wo));
        cosine = 0.5 * sqrt(dot(sum, sum));
        incident = cosine;
        jacobian = 0.25 / max(cosine, 1e-30);
    }
    if !(h.z > 0.0) {
        return vec3<f32>(0.0);
    }
    let alpha = vec2<f32>(glass.alpha);
    let wi_above = rough_dielectric_up(back);
    let wo_above = rough_dielectric_up(wo);
    var masking = beckmann_masking(alpha, wi_above) * beckmann_masking(alpha, wo_above);
    if glass.wall {
        masking = beckmann_masking_shadowing(alpha, wi_above, wo_above);
    }
    let facets = beckmann_d(alpha, h) * masking * cosine * jacobian;
    let value = brdf_finite(facets / abs(wi.z * wo.z));
    if !crosses {
        return vec3<f32>(value * rough_dielectric_reflectance(glass, wo, cosine));
    }
    if glass.wall {
        let through = rough_dielectric_through_wall(glass.tint, cosine, glass.eta);
        return value * ((1.0 - rough_dielectric_reflectance(glass, wo, cosine)) * through);
    }
    // Uses the cosine above the surface in both cases, as the cosine below is ill-conditioned near
    // the critical angle.
    let above = select(incident, cosine, wo.z > 0.0);
    return vec3<f32>(value * (1.0 - dielectric_reflectance(glass.eta, above)));
}
