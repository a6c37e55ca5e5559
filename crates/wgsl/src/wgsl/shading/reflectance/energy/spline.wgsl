// Uniform quadratic B-splines over [0, 1]: `reflectance/energy/spline.rs` of asperity-shading.

struct EnergySpline {
    first: u32,
    weights: vec3<f32>,
}

// The first of three coefficients of `count` at x in [0, 1], and their weights; 0 for NaN.
fn energy_spline(x: f32, count: u32) -> EnergySpline {
    let at = math_clamped(x, 1.0) * f32(count - 2u);
    let first = min(u32(at), count - 3u);
    let t = at - f32(first);
    return EnergySpline(first, vec3<f32>(0.5 * (1.0 - t) * (1.0 - t), 0.5 + t * (1.0 - t), 0.5 * t * t));
}

// The place in [0, 1] of t in [0, 1], with a finer scale below `width`.
fn energy_place(t: f32, width: f32) -> f32 {
    return sqrt(t * (1.0 + width) / max(t + width, 1.1754944e-38));
}

// A roughness within the tables.
fn energy_alpha(alpha: f32) -> f32 {
    return max(math_clamped(alpha, 1.0), 0.001);
}

// F_ms, the light of further bounces per light that stays, of a mean reflectance and a mean albedo.
fn energy_bounces(f_avg: vec3<f32>, e_avg: f32) -> vec3<f32> {
    return f_avg * e_avg / (1.0 - f_avg * (1.0 - e_avg));
}

// The factor of single scattering: `EnergyCompensated::factor`.
fn energy_factor(bounces: vec3<f32>, albedo: f32) -> vec3<f32> {
    return 1.0 + bounces * ((1.0 - albedo) / albedo);
}
