// Sums of octaves of simplex noise with the customary wider kernel, asperity_noise::Simplex, in the plane.

// One octave, its gradient by its own coordinates; 0 beyond the kind's reach.
fn simplex_wide_octave_2d(layer: OctavesLayer2d, p: vec2<f32>) -> Sample2d {
    return simplex_wide_in_cell_2d(layer.cell, octaves_point_2d(layer, p), layer.key);
}

// The first octaves of a sum, clamped to a footprint: `Octaves::first(octaves).clamped(footprint)`. A footprint of 0 clamps nothing. Of
// an anchored sum `p` is the difference to the anchor.
fn simplex_wide_octaves_2d(p: vec2<f32>, octaves: f32, footprint: f32, sum: u32) -> Sample2d {
    var total = octaves_total_2d(octaves, footprint, sum);
    while octaves_goes_on(total.walk) {
        let layer = octaves_layer_2d(sum, total.walk.octave);
        total = octaves_added_2d(total, layer, simplex_wide_octave_2d(layer, p));
    }
    return octaves_divided_2d(total);
}

// The ridged multifractal of the first octaves of a sum.
fn simplex_wide_multifractal_2d(p: vec2<f32>, octaves: f32, feedback: f32, sum: u32) -> Sample2d {
    var total = ridged_multifractal_2d(octaves, feedback, sum);
    while octaves_goes_on(total.walk) {
        let layer = octaves_layer_2d(sum, total.walk.octave);
        total = ridged_multifractal_added_2d(total, layer, simplex_wide_octave_2d(layer, p));
    }
    return ridged_multifractal_divided_2d(total);
}
