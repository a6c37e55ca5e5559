// Ridged octaves in space, each weighted by the octave before, of the kind that `octaves_noise_3d` is:
// asperity_noise::RidgedMultifractal. Shape and normalisation of the spectrum are left out of account.

// Value and gradient of the first octaves of a sum; `feedback` is from 0 on.
fn ridged_multifractal_3d(p: vec3<f32>, octaves: f32, feedback: f32, sum: u32) -> Sample3d {
    let spectrum = octaves_spectrum_3d(sum);
    let whole = octaves_lone_whole(octaves, spectrum);
    var value = 0.0;
    var gradient = vec3<f32>(0.0);
    var weight = 1.0;
    var weight_slope = vec3<f32>(0.0);
    var amplitude = 1.0;
    var range = 0.0;
    for (var i = 0u; i < 16u; i++) {
        let part = min(whole - f32(i), 1.0);
        if !(part > 0.0) {
            break;
        }
        let weighted = part * amplitude;
        amplitude *= spectrum.gain;
        range += weighted;
        let layer = octaves_layer_3d(sum, i);
        let octave = octaves_noise_3d(layer.cell_and_key.xyz, octaves_point_3d(layer, p), bitcast<u32>(layer.cell_and_key.w));
        let height = octaves_shape_value(OCTAVES_RIDGED, octave.value);
        let slopes = octaves_pull_back_3d(layer, octaves_shape_slope(OCTAVES_RIDGED, octave.value) * octave.gradient);
        let ridge = weight * height;
        value += weighted * ridge;
        let next = feedback * ridge;
        let slope = weight * slopes + weight_slope * height;
        gradient += weighted * slope;
        weight_slope = select(vec3<f32>(0.0), feedback * slope, next < 1.0);
        weight = select(1.0, next, next < 1.0);
    }
    var factor = 0.0;
    if range > 0.0 {
        factor = 1.0 / range;
    }
    return Sample3d(value * factor, gradient * factor);
}
