// Ridged octaves in four dimensions, each weighted by the octave before, under way: asperity_noise::RidgedMultifractal. Shape and
// normalisation of the spectrum are left out of account.

struct RidgedMultifractal4d {
    walk: OctavesWalk,
    feedback: f32,
    range: f32,
    value: f32,
    gradient: vec4<f32>,
    // Of the next octave, with its gradient.
    weight: f32,
    weight_slope: vec4<f32>,
}

// The sum before the first octave; the feedback is from 0 on.
fn ridged_multifractal_4d(octaves: f32, feedback: f32, sum: u32) -> RidgedMultifractal4d {
    let walk = octaves_walk(octaves, 0.0, octaves_spectrum_4d(sum));
    return RidgedMultifractal4d(walk, feedback, 0.0, 0.0, vec4<f32>(0.0), 1.0, vec4<f32>(0.0));
}

// The sum with its next octave.
fn ridged_multifractal_added_4d(
    total: RidgedMultifractal4d,
    layer: OctavesLayer4d,
    octave: Sample4d,
) -> RidgedMultifractal4d {
    let amplitude = total.walk.weight;
    let height = octaves_shape_value(OCTAVES_RIDGED, octave.value);
    let steepness = octaves_shape_slope(OCTAVES_RIDGED, octave.value);
    let slopes = octaves_pull_back_4d(layer, steepness * octave.gradient);
    let ridge = total.weight * height;
    let next = total.feedback * ridge;
    let slope = total.weight * slopes + total.weight_slope * height;
    return RidgedMultifractal4d(
        octaves_next(total.walk),
        total.feedback,
        total.range + amplitude,
        total.value + amplitude * ridge,
        total.gradient + amplitude * slope,
        select(1.0, next, next < 1.0),
        select(vec4<f32>(0.0), total.feedback * slope, next < 1.0),
    );
}

// Value and gradient of the whole sum.
fn ridged_multifractal_divided_4d(total: RidgedMultifractal4d) -> Sample4d {
    var factor = 0.0;
    if total.range > 0.0 {
        factor = 1.0 / total.range;
    }
    return Sample4d(total.value * factor, total.gradient * factor);
}
