// Sums of octaves of simplex noise with the customary wider kernel, asperity_noise::Simplex, in four dimensions.

// One octave, its gradient by its own coordinates; 0 beyond the kind's reach.
fn simplex_wide_octave_4d(layer: OctavesLayer4d, p: vec4<f32>) -> Sample4d {
    return simplex_wide_in_cell_4d(layer.cell, octaves_point_4d(layer, p), layer.key);
}

// The first octaves of a sum, clamped to a footprint: `Octaves::first(octaves).clamped(footprint)`. A footprint of 0 clamps nothing. Of
// an anchored sum `p` is the difference to the anchor.
fn simplex_wide_octaves_4d(p: vec4<f32>, octaves: f32, footprint: f32, sum: u32) -> Sample4d {
    var total = octaves_total_4d(octaves, footprint, sum);
    while octaves_goes_on(total.walk) {
        let layer = octaves_layer_4d(sum, total.walk.octave);
        total = octaves_added_4d(total, layer, simplex_wide_octave_4d(layer, p));
    }
    return octaves_divided_4d(total);
}

// The ridged multifractal of the first octaves of a sum.
fn simplex_wide_multifractal_4d(p: vec4<f32>, octaves: f32, feedback: f32, sum: u32) -> Sample4d {
    var total = ridged_multifractal_4d(octaves, feedback, sum);
    while octaves_goes_on(total.walk) {
        let layer = octaves_layer_4d(sum, total.walk.octave);
        total = ridged_multifractal_added_4d(total, layer, simplex_wide_octave_4d(layer, p));
    }
    return ridged_multifractal_divided_4d(total);
}
