// Small variations of color and normal: `asperity_shading::material::Blemishes`.

// A color varied by noise without leaving [0, 1].
fn blemishes_varied(color: f32, noise: f32, variation: f32) -> f32 {
    let room = select(1.0 - color, color, noise < 0.0);
    return color + noise * variation * room;
}

// The fraction of the first octave that the pixel cannot resolve.
fn blemishes_removed(fbm: SizedFbm, footprint: f32) -> f32 {
    return frequency_clamp_filtered_fraction(footprint, fbm.frequency);
}

// The color with blemishes, filtered over a pixel of this width, given half the mean of the noise's
// magnitude: `Blemishes::color`.
fn blemishes_color(
    fbm: SizedFbm,
    half_mean: f32,
    color: vec3<f32>,
    strength: f32,
    position: vec3<f32>,
    footprint: f32,
) -> vec3<f32> {
    let removed = blemishes_removed(fbm, footprint);
    var noise = 0.0;
    if removed < 1.0 {
        noise = -sized_fbm_value(fbm, position);
    }
    let near = vec3<f32>(
        blemishes_varied(color.x, noise, strength),
        blemishes_varied(color.y, noise, strength),
        blemishes_varied(color.z, noise, strength),
    );
    let mean = half_mean * strength;
    return near + removed * (color + mean * (1.0 - 2.0 * color) - near);
}
