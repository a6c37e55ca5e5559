// Lambertian reflectance: `asperity_shading::Lambert`.

// f_r = albedo/pi above the horizon; 1/sr.
fn lambert_eval(albedo: vec3<f32>, wi: vec3<f32>, wo: vec3<f32>) -> vec3<f32> {
    return select(vec3<f32>(0.0), albedo * 0.31830987, direction_are_above(wi, wo));
}
