// Schlick's approximation of Fresnel's reflectance, and the one with a tint near 82 degrees: `asperity_shading::Schlick`,
// `asperity_shading::reflectance::SchlickF82`. A cosine that is no number is the horizon's.

// F = f0 + (1 - f0) (1 - cos)^5, for each channel; f0 in [0, 1].
fn schlick_reflectance(f0: vec3<f32>, cos_theta: f32) -> vec3<f32> {
    let x = 1.0 - math_clamped(cos_theta, 1.0);
    let square = x * x;
    return min(f0 + (1.0 - f0) * (square * square * x), vec3<f32>(1.0));
}

// The same less `dip` cos (1 - cos)^6, where `dip` is that of `SchlickF82`.
fn schlick_tinted_reflectance(f0: vec3<f32>, dip: vec3<f32>, cos_theta: f32) -> vec3<f32> {
    let c = math_clamped(cos_theta, 1.0);
    let x = 1.0 - c;
    let square = x * x;
    let fifth = square * square * x;
    return math_shares(f0 + (1.0 - f0) * fifth - dip * c * (fifth * x));
}
