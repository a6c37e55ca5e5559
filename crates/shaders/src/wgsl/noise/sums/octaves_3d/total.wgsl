// Sums of octaves in space under way: asperity_noise::Octaves. The octaves of a kind are added one after the other:
//
//     var total = octaves_total_3d(octaves, footprint, sum);
//     while octaves_goes_on(total.walk) {
//         let layer = octaves_layer_3d(sum, total.walk.octave);
//         total = octaves_added_3d(total, layer, a sample at octaves_point_3d(layer, p));
//     }
//     return octaves_divided_3d(total);

struct OctavesTotal3d {
    walk: OctavesWalk,
    factor: f32,
    value: f32,
    gradient: vec3<f32>,
}

// The sum before the first octave, of the first `octaves` octaves, clamped to a footprint; 0 clamps nothing.
fn octaves_total_3d(octaves: f32, footprint: f32, sum: u32) -> OctavesTotal3d {
    let spectrum = octaves_spectrum_3d(sum);
    let divisor = octaves_divisor(octaves, footprint, spectrum);
    return OctavesTotal3d(octaves_walk(octaves, footprint, spectrum), divisor.factor, divisor.constant, vec3<f32>(0.0));
}

// The sum with its next octave.
fn octaves_added_3d(total: OctavesTotal3d, layer: OctavesLayer3d, octave: Sample3d) -> OctavesTotal3d {
    let shape = total.walk.spectrum.shape;
    let weight = total.walk.weight;
    let slope = octaves_shape_slope(shape, octave.value);
    return OctavesTotal3d(
        octaves_next(total.walk),
        total.factor,
        total.value + weight * octaves_shape_value(shape, octave.value),
        total.gradient + weight * octaves_pull_back_3d(layer, slope * octave.gradient),
    );
}

// Value and gradient of the whole sum.
fn octaves_divided_3d(total: OctavesTotal3d) -> Sample3d {
    return Sample3d(total.value * total.factor, total.gradient * total.factor);
}
