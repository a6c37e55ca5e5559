// Radiance of the exact rule at points of a plane under five half vectors, and the BRDF by visible
// normals for three pairs of directions.

struct MeansJob {
    halves: array<vec4<f32>, 5>,
    views: array<vec4<f32>, 3>,
    lights: array<vec4<f32>, 3>,
    alpha: vec2<f32>,
    octaves: f32,
    // Side of the plane in cells of the first octave.
    side: f32,
}

fn means_uniform(word: u32) -> f32 {
    return f32(word >> 8u) * (1.0 / 16777216.0);
}

@group(1) @binding(0) var<storage, read> means_count: array<u32>;
@group(1) @binding(1) var<storage, read_write> means_radiances: array<f32>;

@compute @workgroup_size(64)
fn means_point(@builtin(global_invocation_id) id: vec3<u32>) {
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
        means_radiances[i * 8u + k] = level_of_detail_exact_ggx(means_job.alpha, h, -seen.z, seen.resolved_variance);
    }
    let split = gaussian_split(-seen.z, seen.resolved_variance);
    for (var k = 0u; k < 3u; k++) {
        let wo = means_job.views[k].xyz;
        let wi = means_job.lights[k].xyz;
        let far = cook_torrance_ggx(means_job.alpha, wi, wo);
        let f = far.x * schlick_reflectance(vec3<f32>(0.04), far.y).x;
        let z = ggx_invert_visible(means_job.alpha, wo, direction_half(wi, wo));
        means_radiances[i * 8u + 5u + k] = gaussian_split_weigh(split, f, z);
    }
}
