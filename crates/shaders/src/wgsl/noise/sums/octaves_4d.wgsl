// Sums of octaves in four dimensions, of the kind that `octaves_noise_4d` is: asperity_noise::Octaves.
// The weights go by the number of octaves, the footprint and the spectrum; the shape is the spectrum's.

// Value and gradient of the first octaves of a sum, clamped to a footprint: `Octaves::first(octaves).clamped(footprint)`. A footprint
// of 0 clamps nothing. Of an anchored sum `p` is the difference to the anchor.
fn octaves_sum_4d(p: vec4<f32>, octaves: f32, footprint: f32, sum: u32) -> Sample4d {
    let spectrum = octaves_spectrum_4d(sum);
    let whole = octaves_lone_whole(octaves, spectrum);
    let divisor = octaves_divisor(octaves, footprint, spectrum);
    var value = divisor.constant;
    var gradient = vec4<f32>(0.0);
    var amplitude = 1.0;
    var frequency = 1.0;
    for (var i = 0u; i < 16u; i++) {
        let weight = min(whole - f32(i), 1.0);
        let weighted = weight * amplitude * (1.0 - frequency_clamp_removed_share(footprint, frequency));
        if !(weighted > 0.0) {
            break;
        }
        let layer = octaves_layer_4d(sum, i);
        let octave = octaves_noise_4d(layer.cell, octaves_point_4d(layer, p), layer.key);
        let slope = octaves_shape_slope(spectrum.shape, octave.value);
        value += weighted * octaves_shape_value(spectrum.shape, octave.value);
        gradient += weighted * octaves_pull_back_4d(layer, slope * octave.gradient);
        amplitude *= spectrum.gain;
        frequency *= spectrum.lacunarity;
    }
    return Sample4d(value * divisor.factor, gradient * divisor.factor);
}
