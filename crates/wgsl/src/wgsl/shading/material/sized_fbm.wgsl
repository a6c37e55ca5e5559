// Octaves of simplex noise by position, filtered over a pixel: `material/fbm.rs` of
// asperity-shading.

// The variance of each component of the gradient of one octave, per cell squared.
const SIZED_FBM_SLOPE_VARIANCE: f32 = 3.08;

// The footprint in cells for frequency clamping; 0 if all octaves are resolved.
fn sized_fbm_footprint(fbm: SizedFbm, footprint: f32) -> f32 {
    let width = footprint * fbm.frequency;
    return select(0.0, width, frequency_clamp_filtered_fraction(width, fbm.highest) > 0.0);
}

// The value, and the gradient in cells of the first octave, with unresolved octaves faded to 0.
fn sized_fbm_sample(fbm: SizedFbm, position: vec3<f32>, footprint: f32) -> Sample3d {
    return simplex_fbm_3d(position * fbm.frequency, fbm.octaves, sized_fbm_footprint(fbm, footprint), fbm.sum);
}

// The value without fading.
fn sized_fbm_value(fbm: SizedFbm, position: vec3<f32>) -> f32 {
    return simplex_fbm_3d(position * fbm.frequency, fbm.octaves, 0.0, fbm.sum).value;
}

// The variance of each component of the gradient that fading removes, for octaves with this
// variance.
fn sized_fbm_removed_slope(fbm: SizedFbm, footprint: f32, slope_variance: f32) -> f32 {
    if !(frequency_clamp_filtered_fraction(footprint * fbm.frequency, fbm.highest) > 0.0) {
        return 0.0;
    }
    let spectrum = fbm_spectrum_3d(fbm.sum);
    var removed = 0.0;
    var total = 0.0;
    var amplitude = 1.0;
    var frequency = 1.0;
    for (var i = 0u; i < 8u; i++) {
        let weight = clamp(fbm.octaves - f32(i), 0.0, 1.0);
        if !(weight > 0.0) {
            break;
        }
        let slope = weight * amplitude * frequency;
        let kept = footprint_kept(footprint, fbm.frequency * frequency);
        removed += slope * slope * (1.0 - kept * kept);
        total += weight * amplitude;
        amplitude *= spectrum.gain;
        frequency *= spectrum.lacunarity;
    }
    return removed * slope_variance / (total * total);
}
