// Sums of octaves of Gaussian noise, one channel, asperity_noise::Gaussian, in space.

// One octave, its gradient by its own coordinates; 0 where a coordinate is not finite.
fn gaussian_channel_octave_3d(layer: OctavesLayer3d, p: vec3<f32>) -> Sample3d {
    let at = cell_place_3d(octaves_point_3d(layer, p));
    let octave = gaussian_in_cell_3d(layer.cell_and_key.xyz + at.cell, at.place, bitcast<u32>(layer.cell_and_key.w));
    return sample_known_3d(octave, at.known);
}

// The first octaves of a sum, clamped to a footprint: `Octaves::first(octaves).clamped(footprint)`. A footprint of 0 clamps nothing. Of
// an anchored sum `p` is the difference to the anchor.
fn gaussian_channel_octaves_3d(p: vec3<f32>, octaves: f32, footprint: f32, sum: u32) -> Sample3d {
    var total = octaves_total_3d(octaves, footprint, sum);
    while octaves_goes_on(total.walk) {
        let layer = octaves_layer_3d(sum, total.walk.octave);
        total = octaves_added_3d(total, layer, gaussian_channel_octave_3d(layer, p));
    }
    return octaves_divided_3d(total);
}

// The ridged multifractal of the first octaves of a sum.
fn gaussian_channel_multifractal_3d(p: vec3<f32>, octaves: f32, feedback: f32, sum: u32) -> Sample3d {
    var total = ridged_multifractal_3d(octaves, feedback, sum);
    while octaves_goes_on(total.walk) {
        let layer = octaves_layer_3d(sum, total.walk.octave);
        total = ridged_multifractal_added_3d(total, layer, gaussian_channel_octave_3d(layer, p));
    }
    return ridged_multifractal_divided_3d(total);
}
