// Schlick's approximation of Fresnel reflectance, and the variant with a tint near 82 degrees:
// `asperity_shading::Schlick`, `asperity_shading::reflectance::SchlickF82`. A NaN cosine is taken
// as 0.

// F = normal_incidence + (1 - normal_incidence) (1 - cos)^5, for each channel; normal_incidence in
// [0, 1].
fn schlick_reflectance(normal_incidence: vec3<f32>, cos_theta: f32) -> vec3<f32> {
    let x = 1.0 - math_clamped(cos_theta, 1.0);
    let square = x * x;
    return min(normal_incidence + (1.0 - normal_incidence) * (square * square * x), vec3<f32>(1.0));
}

// The same minus `dip` cos (1 - cos)^6, where `dip` is the dip of `SchlickF82`.
fn schlick_f82_reflectance(normal_incidence: vec3<f32>, dip: vec3<f32>, cos_theta: f32) -> vec3<f32> {
    let c = math_clamped(cos_theta, 1.0);
    let x = 1.0 - c;
    let square = x * x;
    let fifth = square * square * x;
    return math_shares(normal_incidence + (1.0 - normal_incidence) * fifth - dip * c * (fifth * x));
}
