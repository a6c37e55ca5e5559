// Ward's anisotropic reflectance and its two later denominators, in 1/sr per specular color:
// `asperity_shading::reflectance::WardReflection`.

const WARD_AS_PUBLISHED: u32 = 0u;
const WARD_DUR: u32 = 1u;
const WARD_BOUNDED: u32 = 2u;

// A Gaussian of the half vector's slopes, for valid roughnesses along x and y and one of the forms
// above.
fn ward_brdf_eval(alpha: vec2<f32>, form: u32, wi: vec3<f32>, wo: vec3<f32>) -> f32 {
    if !direction_are_above(wi, wo) {
        return 0.0;
    }
    let sum = wi + wo;
    let x = sum.x / (sum.z * alpha.x);
    let y = sum.y / (sum.z * alpha.y);
    let peak = 0.31830987 / (alpha.x * alpha.y);
    var factor = dot(sum, sum) / (sum.z * sum.z * sum.z * sum.z);
    if form == WARD_AS_PUBLISHED {
        factor = 0.25 / sqrt(wi.z * wo.z);
    } else if form == WARD_DUR {
        factor = 0.25 / (wi.z * wo.z);
    }
    return brdf_finite(elementary_exp(-(x * x + y * y)) * peak * factor);
}
