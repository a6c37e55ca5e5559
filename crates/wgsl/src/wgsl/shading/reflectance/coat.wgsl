// Smooth and rough coats over the layers of a surface: `asperity_shading::reflectance::Coat`.

const COAT_CLEARCOAT: u32 = 0u;
const COAT_THIN_DIELECTRIC: u32 = 1u;
const COAT_DIELECTRIC: u32 = 2u;
const COAT_CONDUCTOR: u32 = 3u;
const COAT_TRANSPARENT: u32 = 4u;

// A direction from which a smooth surface sends a fraction of the light to the eye; below the
// surface the light is transmitted.
struct CoatSpecularSample {
    wi: vec3<f32>,
    weight: vec3<f32>,
}

// A lobe narrower than the gaps between facets is widened to them by part of the slopes' variance:
// alpha, and the remaining variance.
fn coat_widened(roughness: f32, slope_variance: f32) -> vec2<f32> {
    let square = roughness * roughness;
    if math_is_finite(slope_variance) && square < 1.4 * slope_variance {
        let taken = (1.4 * slope_variance - square) / 3.4;
        return vec2<f32>(sqrt(square + 2.0 * taken), slope_variance - taken);
    }
    return vec2<f32>(roughness, slope_variance);
}

// Slopes of this variance around a normal, in the frame of the surface.
fn coat_facets(normal: vec3<f32>, slope_variance: f32) -> SlopeFacets {
    var deviation = 0.0;
    if slope_variance > 0.0 {
        deviation = sqrt(slope_variance);
    }
    let n = vec3<f32>(0.0, 0.0, 1.0);
    return slope_facets(n, normal, vec3<f32>(deviation, 0.0, 0.0), vec3<f32>(0.0, deviation, 0.0));
}

// A clearcoat with a relative IOR over slopes of this variance around a normal.
fn coat_clearcoat(index: f32, roughness: f32, normal: vec3<f32>, slope_variance: f32) -> Coat {
    let none = vec3<f32>(0.0);
    return Coat(normal, slope_variance, none, roughness, vec3<f32>(1.0), index, COAT_CLEARCOAT);
}

// The normal of a facet with slopes of this variance around a normal, visible from the view, chosen
// by uniform numbers.
fn coat_facet(normal: vec3<f32>, slope_variance: f32, wo: vec3<f32>, u: vec2<f32>) -> vec3<f32> {
    let n = vec3<f32>(0.0, 0.0, 1.0);
    var facet = normal;
    if slope_variance > 0.0 && normal.z > 0.0 {
        let radius = sqrt(-2.0 * slope_variance * elementary_ln_1p(-min(math_clamped(u.x, 1.0), 0.999999)));
        let slope = vec3<f32>(radius * elementary_cos_sin_turns(math_clamped(u.y, 1.0)), 0.0);
        facet = surface_gradient_normal(n, n - normal / normal.z + slope);
    }
    return surface_gradient_facing(n, facet, wo);
}

// The fraction of light from one direction that a coat transmits to the layers below.
fn coat_transmittance(coat: Coat, w: vec3<f32>) -> f32 {
    if coat.kind == COAT_CLEARCOAT {
        return dielectric_transmittance(coat.index, dot(w, coat.normal));
    }
    return 1.0;
}

// A lobe of a rough coat at directions in the frame of a facet.
fn coat_lobe(coat: Coat, alpha: f32, wi: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    if coat.kind == COAT_THIN_DIELECTRIC || coat.kind == COAT_DIELECTRIC {
        let rough = RoughDielectric(alpha, rough_dielectric_index(coat.index), coat.kind == COAT_THIN_DIELECTRIC, coat.color);
        return rough_dielectric_eval(rough, wi, wo);
    }
    let value = cook_torrance_beckmann(vec2<f32>(alpha), wi, wo);
    if coat.kind == COAT_CONDUCTOR {
        return value.x * math_shares(coat.color);
    }
    return vec3<f32>(value.x * dielectric_reflectance(coat.index, value.y));
}

// Reflection of a rough coat, and transmission of a dielectric, times the cosine; 0 for a
// smooth coat, whose light is all in `coat_specular_samples`.
fn coat_eval_cos(coat: Coat, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    let transmits = coat.kind == COAT_THIN_DIELECTRIC || coat.kind == COAT_DIELECTRIC;
    let has_sides = direction_are_above(wi, wo) || (transmits && direction_have_sides(wi, wo));
    if !(coat.roughness > 0.0 && coat.kind != COAT_TRANSPARENT && has_sides) {
        return vec3<f32>(0.0);
    }
    // Slopes of a sine have their own facets.
    let is_sine = coat.swing.x != 0.0 || coat.swing.y != 0.0 || coat.swing.z != 0.0;
    var widened = vec2<f32>(coat.roughness, select(coat.slope_variance, 0.0, is_sine));
    if coat.kind != COAT_THIN_DIELECTRIC && !is_sine {
        widened = coat_widened(coat.roughness, coat.slope_variance);
    }
    let alpha = clamp(widened.x, 0.000001, 1000000.0);
    let n = vec3<f32>(0.0, 0.0, 1.0);
    let facets = coat_facets(coat.normal, widened.y);
    let swing = 0.8660254 * coat.swing;
    let swings = (swing.x != 0.0 || swing.y != 0.0 || swing.z != 0.0) && coat.normal.z > 0.0;
    let share = select(1.0, 0.33333334, swings);
    var sum = vec3<f32>(0.0);
    for (var k = 0u; k < 15u; k++) {
        var facet = SlopeFacet(0.0, coat.normal);
        if k < 13u {
            facet = slope_facets_gaussian(facets, k);
            facet.weight *= share;
        } else if swings {
            let side = select(swing, -swing, k == 13u);
            facet = SlopeFacet(share, surface_gradient_normal(n, n - coat.normal / coat.normal.z + side));
        }
        let light = facet_light(facet.weight, facet.normal, wi, wo);
        if light.factor > 0.0 {
            sum += coat_lobe(coat, alpha, light.wi, light.wo) * light.factor;
        }
    }
    return sum;
}

// Reflectance times cosine of layers under a coat, and of the coat; `scattered` is the value of the
// layers, for directions above the surface.
fn coat_over(coat: Coat, scattered: vec3<f32>, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    let through = coat_transmittance(coat, wi) * coat_transmittance(coat, wo);
    return brdf_finite_channels(scattered * through + coat_eval_cos(coat, wo, wi));
}

// Both directions of `Bsdf::specular_samples`; any direction if the weight is 0.
struct CoatSpecularSamples {
    mirrored: CoatSpecularSample,
    transmitted: CoatSpecularSample,
}

// Reflection and transmission of a smooth coat at a facet chosen by uniform numbers; 0 for a rough
// coat, except for a transparent one.
fn coat_specular_samples(coat: Coat, view: vec3<f32>, u: vec2<f32>) -> CoatSpecularSamples {
    let dark = CoatSpecularSample(vec3<f32>(0.0), vec3<f32>(0.0));
    // The view may have any length. A view that is unit up to rounding keeps its bits.
    let wo = select(direction_unit_or_zero(direction_near_one(view)), view, abs(dot(view, view) - 1.0) < 1e-5);
    if wo.z == 0.0 || !direction_is_finite(wo) {
        return CoatSpecularSamples(dark, dark);
    }
    if coat.kind == COAT_TRANSPARENT {
        return CoatSpecularSamples(dark, CoatSpecularSample(-wo, math_shares(coat.color)));
    }
    // From below everything is upside down.
    let inside = wo.z < 0.0;
    let covers = coat.kind == COAT_CLEARCOAT || coat.kind == COAT_CONDUCTOR;
    if coat.roughness > 0.0 || (inside && covers) {
        return CoatSpecularSamples(dark, dark);
    }
    let side = vec3<f32>(1.0, 1.0, select(1.0, -1.0, inside));
    let up = wo * side;
    let normal = coat.normal * select(vec3<f32>(1.0), vec3<f32>(-1.0, -1.0, 1.0), inside);
    let n = vec3<f32>(0.0, 0.0, 1.0);
    var m = vec3<f32>(0.0);
    if (coat.swing.x != 0.0 || coat.swing.y != 0.0 || coat.swing.z != 0.0) && normal.z > 0.0 {
        let swing = coat.swing * elementary_cos_sin_turns(math_clamped(u.x, 1.0)).x;
        m = surface_gradient_facing(n, surface_gradient_normal(n, n - normal / normal.z + swing), up);
    } else {
        m = coat_facet(normal, coat.slope_variance, up, u);
    }
    let cosine = dot(up, m);
    // Light that a bump reflects into the surface is reflected out again.
    let bounced = direction_reflect(up, m);
    let mirrored = vec3<f32>(bounced.xy, abs(bounced.z)) * side;
    if coat.kind == COAT_CONDUCTOR {
        return CoatSpecularSamples(CoatSpecularSample(mirrored, math_shares(coat.color)), dark);
    }
    if coat.kind == COAT_CLEARCOAT {
        return CoatSpecularSamples(CoatSpecularSample(mirrored, vec3<f32>(dielectric_reflectance(coat.index, cosine))), dark);
    }
    if coat.kind == COAT_THIN_DIELECTRIC {
        let once = dielectric_reflectance(coat.index, cosine);
        let both = 2.0 * once / (1.0 + once);
        let through = rough_dielectric_through_wall(coat.color, cosine, coat.index) * (1.0 - both);
        return CoatSpecularSamples(CoatSpecularSample(mirrored, vec3<f32>(both)), CoatSpecularSample(-wo, math_shares(through)));
    }
    let index = select(coat.index, dielectric_reversed(coat.index), inside);
    let share = dielectric_reflectance(index, cosine);
    let eta = 1.0 / index;
    // Snell's law: sin of the refracted angle is sin of the incident angle divided by the index.
    let below = 1.0 - eta * eta * max(1.0 - cosine * cosine, 0.0);
    let refracted = (eta * cosine - sqrt(max(below, 0.0))) * m - eta * up;
    let kept = select(0.0, 1.0 - share, below > 0.0 && refracted.z < 0.0);
    return CoatSpecularSamples(CoatSpecularSample(mirrored, vec3<f32>(share)), CoatSpecularSample(refracted * side, vec3<f32>(kept)));
}
