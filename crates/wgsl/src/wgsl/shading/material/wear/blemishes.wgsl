// Small variations of color and normal: `asperity_shading::material::Blemishes`.

// A color varied by noise without leaving [0, 1].
fn blemishes_varied(colour: f32, noise: f32, variation: f32) -> f32 {
    let room = select(1.0 - colour, colour, noise < 0.0);
    return colour + noise * variation * room;
}

// The fraction of the first octave that the pixel cannot resolve.
fn blemishes_removed(fbm: Fbm, footprint: f32) -> f32 {
    return frequency_clamp_removed_share(footprint, fbm.frequency);
}

// The color with blemishes, filtered over a pixel of this width, given half the mean of the noise's
// magnitude: `Blemishes::colour`.
fn blemishes_colour(
    fbm: Fbm,
    half_mean: f32,
    colour: vec3<f32>,
    strength: f32,
    position: vec3<f32>,
    footprint: f32,
) -> vec3<f32> {
    let removed = blemishes_removed(fbm, footprint);
    var noise = 0.0;
    if removed < 1.0 {
        noise = -fbm_value(fbm, position);
    }
    let near = vec3<f32>(
        blemishes_varied(colour.x, noise, strength),
        blemishes_varied(colour.y, noise, strength),
        blemishes_varied(colour.z, noise, strength),
    );
    let mean = half_mean * strength;
    return near + removed * (colour + mean * (1.0 - 2.0 * colour) - near);
}
