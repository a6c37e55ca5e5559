// Radiance of the exact rule at points of a plane under five half vectors, and the BRDF by visible
// normals for three pairs of directions: of a dielectric, and with every bounce of a metal and of glass.

struct MeansJob {
    halves: array<vec4<f32>, 5>,
    views: array<vec4<f32>, 3>,
    lights: array<vec4<f32>, 3>,
    alpha: vec2<f32>,
    octaves: f32,
    // Side of the plane in cells of the first octave.
    side: f32,
    // Reflectance of the metal at normal incidence, and its mean.
    metal: vec2<f32>,
    // Relative index of the glass.
    eta: f32,
}

// The factors of metal and glass for each view. They do not depend on the bumps.
var<workgroup> means_factors: array<vec2<f32>, 3>;

fn means_factor(wo: vec3<f32>) -> vec2<f32> {
    let bounces = energy_bounces(vec3<f32>(means_job.metal.y), ggx_mean_albedo(means_job.alpha));
    let metal = energy_factor(bounces, ggx_albedo(means_job.alpha, wo)).x;
    return vec2<f32>(metal, energy_factor(vec3<f32>(1.0), glass_albedo(means_job.alpha, means_job.eta, wo)).x);
}

// The reflection of glass, single scattering.
fn means_glass(wi: vec3<f32>, wo: vec3<f32>) -> f32 {
    let h = direction_half(wi, wo);
    let masking = ggx_masking(means_job.alpha, wi) * ggx_masking(means_job.alpha, wo);
    let facets = ggx_d(means_job.alpha, h) * masking / (4.0 * wi.z * wo.z);
    return facets * dielectric_reflectance(means_job.eta, dot(wo, h));
}

fn means_uniform(word: u32) -> f32 {
    return f32(word >> 8u) * (1.0 / 16777216.0);
}

@group(1) @binding(0) var<storage, read> means_count: array<u32>;
@group(1) @binding(1) var<storage, read_write> means_radiances: array<f32>;

@compute @workgroup_size(64)
fn means_point(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    if local < 3u {
        means_factors[local] = means_factor(means_job.views[local].xyz);
    }
    workgroupBarrier();
    let i = id.y * 65536u + id.x;
    if i >= means_count[0] {
        return;
    }
    let word = integer_hash_word(integer_hash_term(0u, i32(i)), 1u);
    let further = integer_hash_further(word, 1u);
    let p = vec3<f32>(means_uniform(word), means_uniform(further), 0.3) * vec3<f32>(means_job.side, means_job.side, 1.0);
    let seen = gaussian_slopes_3d(p, vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 1.0, 0.0), means_job.octaves, 0u);
    for (var k = 0u; k < 5u; k++) {
        let h = means_job.halves[k].xyz;
        means_radiances[i * 14u + k] = level_of_detail_exact_ggx(means_job.alpha, h, -seen.z, seen.resolved_variance);
    }
    let split = gaussian_split(-seen.z, seen.resolved_variance);
    for (var k = 0u; k < 3u; k++) {
        let wo = means_job.views[k].xyz;
        let wi = means_job.lights[k].xyz;
        let far = cook_torrance_ggx(means_job.alpha, wi, wo);
        let f = far.x * schlick_reflectance(vec3<f32>(0.04), far.y).x;
        let z = ggx_invert_visible(means_job.alpha, wo, direction_half(wi, wo));
        means_radiances[i * 14u + 5u + k] = gaussian_split_weigh(split, f, z);
        let metal = far.x * schlick_reflectance(vec3<f32>(means_job.metal.x), far.y).x * means_factors[k].x;
        means_radiances[i * 14u + 8u + k] = gaussian_split_weigh(split, metal, z);
        means_radiances[i * 14u + 11u + k] = gaussian_split_weigh(split, means_glass(wi, wo) * means_factors[k].y, z);
    }
}
