// Ward's half vectors as a normal distribution: `asperity_ndf_sampling::Ward`. It is the Beckmann
// distribution except for the lobe.

// Ward's specular reflectance over rho_s/sqrt(cos theta_i cos theta_o), in 1/sr, from the slope of
// the half vector; 0 for h.z <= 0.
fn ward_lobe(alpha: vec2<f32>, h: vec3<f32>) -> f32 {
    let up = select(1.0, h.z, h.z > 0.0);
    let x = h.x / (alpha.x * up);
    let y = h.y / (alpha.y * up);
    let square = x * x + y * y;
    if !(h.z > 0.0 && square < 87.0) {
        return 0.0;
    }
    return elementary_exp(-square) / (4.0 * 3.1415927 * alpha.x * alpha.y);
}
