// Sums of octaves in the plane under way: asperity_noise::Octaves. The octaves of a kind are added one after the other:
//
//     var total = octaves_total_2d(octaves, footprint, sum);
//     while octaves_goes_on(total.walk) {
//         let layer = octaves_layer_2d(sum, total.walk.octave);
//         total = octaves_added_2d(total, layer, a sample at octaves_point_2d(layer, p));
//     }
//     return octaves_divided_2d(total);

struct OctavesTotal2d {
    walk: OctavesWalk,
    factor: f32,
    value: f32,
    gradient: vec2<f32>,
}

// The sum before the first octave, of the first `octaves` octaves, clamped to a footprint; 0 clamps nothing.
fn octaves_total_2d(octaves: f32, footprint: f32, sum: u32) -> OctavesTotal2d {
    let spectrum = octaves_spectrum_2d(sum);
    let divisor = octaves_divisor(octaves, footprint, spectrum);
    return OctavesTotal2d(octaves_walk(octaves, footprint, spectrum), divisor.factor, divisor.constant, vec2<f32>(0.0));
}

// The sum with its next octave.
fn octaves_added_2d(total: OctavesTotal2d, layer: OctavesLayer2d, octave: Sample2d) -> OctavesTotal2d {
    let shape = total.walk.spectrum.shape;
    let weight = total.walk.weight;
    let slope = octaves_shape_slope(shape, octave.value);
    return OctavesTotal2d(
        octaves_next(total.walk),
        total.factor,
        total.value + weight * octaves_shape_value(shape, octave.value),
        total.gradient + weight * octaves_pull_back_2d(layer, slope * octave.gradient),
    );
}

// Value and gradient of the whole sum.
fn octaves_divided_2d(total: OctavesTotal2d) -> Sample2d {
    return Sample2d(total.value * total.factor, total.gradient * total.factor);
}
