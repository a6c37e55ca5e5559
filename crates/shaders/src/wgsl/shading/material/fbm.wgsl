// Octaves of simplex noise by position, as a pixel sees them: `material/fbm.rs` of asperity-shading.

struct Fbm {
    // Cells of the first octave per unit of length, and the frequency of the last over that of the first.
    frequency: f32,
    highest: f32,
    // How many octaves take part.
    octaves: f32,
    // The number of the sum in the uniform of sums.
    sum: u32,
}

// The variance of each component of the gradient of one octave, per cell squared.
const FBM_SLOPE_VARIANCE: f32 = 3.08;

// One octave at a point of the sum.
fn fbm_octave(layer: OctavesLayer3d, p: vec3<f32>) -> Sample3d {
    return simplex_in_cell_3d(layer.cell_and_key.xyz, octaves_point_3d(layer, p), bitcast<u32>(layer.cell_and_key.w));
}

// The footprint in cells that octaves are clamped to; 0 where all are resolved.
fn fbm_footprint(fbm: Fbm, footprint: f32) -> f32 {
    let width = footprint * fbm.frequency;
    return select(0.0, width, frequency_clamp_removed_share(width, fbm.highest) > 0.0);
}

// The first octaves of the sum at p in cells, clamped to a footprint in cells: the value and the gradient.
fn fbm_sum(fbm: Fbm, p: vec3<f32>, octaves: f32, footprint: f32) -> Sample3d {
    let spectrum = octaves_spectrum_3d(fbm.sum);
    let divisor = octaves_divisor(octaves, footprint, spectrum);
    var value = divisor.constant;
    var gradient = vec3<f32>(0.0);
    var amplitude = 1.0;
    var frequency = 1.0;
    for (var i = 0u; i < 8u; i++) {
        let weight = min(octaves - f32(i), 1.0);
        let weighted = weight * amplitude * (1.0 - frequency_clamp_removed_share(footprint, frequency));
        if !(weighted > 0.0) {
            break;
        }
        let layer = octaves_layer_3d(fbm.sum, i);
        let octave = fbm_octave(layer, p);
        let slope = octaves_shape_slope(spectrum.shape, octave.value);
        value += weighted * octaves_shape_value(spectrum.shape, octave.value);
        gradient += weighted * octaves_pull_back_3d(layer, slope * octave.gradient);
        amplitude *= spectrum.gain;
        frequency *= spectrum.lacunarity;
    }
    return Sample3d(value * divisor.factor, gradient * divisor.factor);
}

// The value, and the gradient by cells of the first octave, with the octaves that the pixel cannot resolve faded to 0.
fn fbm_sample(fbm: Fbm, position: vec3<f32>, footprint: f32) -> Sample3d {
    return fbm_sum(fbm, position * fbm.frequency, fbm.octaves, fbm_footprint(fbm, footprint));
}

// The value without any fading.
fn fbm_value(fbm: Fbm, position: vec3<f32>) -> f32 {
    return fbm_sum(fbm, position * fbm.frequency, fbm.octaves, 0.0).value;
}

// The variance of each component of the gradient that fading takes away, for octaves of this one.
fn fbm_removed_slope(fbm: Fbm, footprint: f32, slope_variance: f32) -> f32 {
    if !(frequency_clamp_removed_share(footprint * fbm.frequency, fbm.highest) > 0.0) {
        return 0.0;
    }
    let spectrum = octaves_spectrum_3d(fbm.sum);
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
