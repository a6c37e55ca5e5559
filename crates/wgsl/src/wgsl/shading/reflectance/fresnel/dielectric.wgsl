// Fresnel reflectance of a dielectric for unpolarized light: `asperity_shading::Dielectric`.

// The reflected fraction of light, for the relative IOR `eta` > 0 of the transmitted side to the
// incident side.
fn dielectric_reflectance(eta: f32, cos_theta: f32) -> f32 {
    if eta == 1.0 {
        return 0.0;
    }
    let c = math_clamped(cos_theta, 1.0);
    let excess = (eta - 1.0) * (eta + 1.0);
    let g_squared = excess + c * c;
    if g_squared < 0.0 {
        return 1.0;
    }
    let sum = sqrt(g_squared) + c;
    let difference = excess / sum;
    let r_s = difference / sum;
    let r_p = r_s * (c * sum - 1.0) / (c * difference + 1.0);
    let f = 0.5 * (r_s * r_s + r_p * r_p);
    // An overflow is the limit of a perfect mirror.
    return select(1.0, min(f, 1.0), f >= 0.0);
}

// The transmitted fraction, 1 - F without its cancellation: `Dielectric::transmittance`.
fn dielectric_transmittance(eta: f32, cos_theta: f32) -> f32 {
    if eta == 1.0 {
        return 1.0;
    }
    let c = math_clamped(cos_theta, 1.0);
    let g = sqrt(max((eta - 1.0) * (eta + 1.0) + c * c, 0.0));
    let s = 1.0 / (c + g);
    let p = eta / (eta * eta * c + g);
    return math_clamped(2.0 * c * g * (s * s + p * p), 1.0);
}

// The relative IOR from the other side: `Dielectric::reversed`.
fn dielectric_reversed(eta: f32) -> f32 {
    return clamp(1.0 / eta, 1.1754944e-38, MATH_LARGEST);
}
