// Sums of octaves of simplex noise with the customary wider kernel, asperity_noise::Simplex, in space.

// One octave, its gradient by its own coordinates; 0 beyond the kind's reach.
fn simplex_wide_octave_3d(layer: OctavesLayer3d, p: vec3<f32>) -> Sample3d {
    return simplex_wide_in_cell_3d(layer.cell_and_key.xyz, octaves_point_3d(layer, p), bitcast<u32>(layer.cell_and_key.w));
}

// The first octaves of a sum, clamped to a footprint: `Octaves::first(octaves).clamped(footprint)`. A footprint of 0 clamps nothing. Of
// an anchored sum `p` is the difference to the anchor.
fn simplex_wide_octaves_3d(p: vec3<f32>, octaves: f32, footprint: f32, sum: u32) -> Sample3d {
    var total = octaves_total_3d(octaves, footprint, sum);
    while octaves_goes_on(total.walk) {
        let layer = octaves_layer_3d(sum, total.walk.octave);
        total = octaves_added_3d(total, layer, simplex_wide_octave_3d(layer, p));
    }
    return octaves_divided_3d(total);
}

// The ridged multifractal of the first octaves of a sum.
fn simplex_wide_multifractal_3d(p: vec3<f32>, octaves: f32, feedback: f32, sum: u32) -> Sample3d {
    var total = ridged_multifractal_3d(octaves, feedback, sum);
    while octaves_goes_on(total.walk) {
        let layer = octaves_layer_3d(sum, total.walk.octave);
        total = ridged_multifractal_added_3d(total, layer, simplex_wide_octave_3d(layer, p));
    }
    return ridged_multifractal_divided_3d(total);
}
