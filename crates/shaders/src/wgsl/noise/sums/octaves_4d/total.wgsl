// Sums of octaves in four dimensions under way: asperity_noise::Octaves. The octaves of a kind are added one after the other:
//
//     var total = octaves_total_4d(octaves, footprint, sum);
//     while octaves_goes_on(total.walk) {
//         let layer = octaves_layer_4d(sum, total.walk.octave);
//         total = octaves_added_4d(total, layer, a sample at octaves_point_4d(layer, p));
//     }
//     return octaves_divided_4d(total);

struct OctavesTotal4d {
    walk: OctavesWalk,
    factor: f32,
    value: f32,
    gradient: vec4<f32>,
}

// The sum before the first octave, of the first `octaves` octaves, clamped to a footprint; 0 clamps nothing.
fn octaves_total_4d(octaves: f32, footprint: f32, sum: u32) -> OctavesTotal4d {
    let spectrum = octaves_spectrum_4d(sum);
    let divisor = octaves_divisor(octaves, footprint, spectrum);
    return OctavesTotal4d(octaves_walk(octaves, footprint, spectrum), divisor.factor, divisor.constant, vec4<f32>(0.0));
}

// The sum with its next octave.
fn octaves_added_4d(total: OctavesTotal4d, layer: OctavesLayer4d, octave: Sample4d) -> OctavesTotal4d {
    let shape = total.walk.spectrum.shape;
    let weight = total.walk.weight;
    let slope = octaves_shape_slope(shape, octave.value);
    return OctavesTotal4d(
        octaves_next(total.walk),
        total.factor,
        total.value + weight * octaves_shape_value(shape, octave.value),
        total.gradient + weight * octaves_pull_back_4d(layer, slope * octave.gradient),
    );
}

// Value and gradient of the whole sum.
fn octaves_divided_4d(total: OctavesTotal4d) -> Sample4d {
    return Sample4d(total.value * total.factor, total.gradient * total.factor);
}
