// Fresnel reflectance of a metal for unpolarized light: `asperity_shading::Conductor`.

// The reflected fraction of light, for the index `eta` > 0 and the extinction coefficient k >= 0
// relative to the incident side.
fn conductor_reflectance(eta: f32, k: f32, cos_theta: f32) -> f32 {
    if eta == 1.0 && k == 0.0 {
        return 0.0;
    }
    let c = math_clamped(cos_theta, 1.0);
    let sin_squared = 1.0 - c * c;
    let real = (eta - k) * (eta + k) - sin_squared;
    let half_imaginary = eta * k;
    let modulus = sqrt(real * real + 4.0 * half_imaginary * half_imaginary);
    // One of the squares of the root cancels, so it is computed from their product.
    let large = 0.5 * (modulus + abs(real));
    var small = 0.0;
    if large > 0.0 {
        small = half_imaginary * half_imaginary / large;
    }
    let a_squared = select(small, large, real >= 0.0);
    let b_squared = select(large, small, real >= 0.0);
    let a = sqrt(a_squared);
    let r_s = ((a - c) * (a - c) + b_squared) / ((a + c) * (a + c) + b_squared);
    let minus = a * c - sin_squared;
    let plus = a * c + sin_squared;
    let rest = b_squared * c * c;
    let r_p = r_s * ((minus * minus + rest) / (plus * plus + rest));
    let f = 0.5 * (r_s + r_p);
    return select(1.0, min(f, 1.0), f >= 0.0);
}
