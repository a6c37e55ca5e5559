// Sums of octaves of Gaussian noise, one channel, asperity_noise::Gaussian, in the plane.

// One octave, its gradient by its own coordinates; 0 where a coordinate is not finite.
fn gaussian_channel_octave_2d(layer: OctavesLayer2d, p: vec2<f32>) -> Sample2d {
    let at = cell_place_2d(octaves_point_2d(layer, p));
    let octave = gaussian_in_cell_2d(layer.cell + at.cell, at.place, layer.key);
    return sample_known_2d(octave, at.known);
}

// The first octaves of a sum, clamped to a footprint: `Octaves::first(octaves).clamped(footprint)`. A footprint of 0 clamps nothing. Of
// an anchored sum `p` is the difference to the anchor.
fn gaussian_channel_octaves_2d(p: vec2<f32>, octaves: f32, footprint: f32, sum: u32) -> Sample2d {
    var total = octaves_total_2d(octaves, footprint, sum);
    while octaves_goes_on(total.walk) {
        let layer = octaves_layer_2d(sum, total.walk.octave);
        total = octaves_added_2d(total, layer, gaussian_channel_octave_2d(layer, p));
    }
    return octaves_divided_2d(total);
}

// The ridged multifractal of the first octaves of a sum.
fn gaussian_channel_multifractal_2d(p: vec2<f32>, octaves: f32, feedback: f32, sum: u32) -> Sample2d {
    var total = ridged_multifractal_2d(octaves, feedback, sum);
    while octaves_goes_on(total.walk) {
        let layer = octaves_layer_2d(sum, total.walk.octave);
        total = ridged_multifractal_added_2d(total, layer, gaussian_channel_octave_2d(layer, p));
    }
    return ridged_multifractal_divided_2d(total);
}
