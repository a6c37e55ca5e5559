// Ridged octaves in space, each weighted by the octave before, under way: asperity_noise::RidgedMultifractal. Shape and
// normalisation of the spectrum are left out of account.

struct RidgedMultifractal3d {
    walk: OctavesWalk,
    feedback: f32,
    range: f32,
    value: f32,
    gradient: vec3<f32>,
    // Of the next octave, with its gradient.
    weight: f32,
    weight_slope: vec3<f32>,
}

// The sum before the first octave; the feedback is from 0 on.
fn ridged_multifractal_3d(octaves: f32, feedback: f32, sum: u32) -> RidgedMultifractal3d {
    let walk = octaves_walk(octaves, 0.0, octaves_spectrum_3d(sum));
    return RidgedMultifractal3d(walk, feedback, 0.0, 0.0, vec3<f32>(0.0), 1.0, vec3<f32>(0.0));
}

// The sum with its next octave.
fn ridged_multifractal_added_3d(
    total: RidgedMultifractal3d,
    layer: OctavesLayer3d,
    octave: Sample3d,
) -> RidgedMultifractal3d {
    let amplitude = total.walk.weight;
    let height = octaves_shape_value(OCTAVES_RIDGED, octave.value);
    let steepness = octaves_shape_slope(OCTAVES_RIDGED, octave.value);
    let slopes = octaves_pull_back_3d(layer, steepness * octave.gradient);
    let ridge = total.weight * height;
    let next = total.feedback * ridge;
    let slope = total.weight * slopes + total.weight_slope * height;
    return RidgedMultifractal3d(
        octaves_next(total.walk),
        total.feedback,
        total.range + amplitude,
        total.value + amplitude * ridge,
        total.gradient + amplitude * slope,
        select(1.0, next, next < 1.0),
        select(vec3<f32>(0.0), total.feedback * slope, next < 1.0),
    );
}

// Value and gradient of the whole sum.
fn ridged_multifractal_divided_3d(total: RidgedMultifractal3d) -> Sample3d {
    var factor = 0.0;
    if total.range > 0.0 {
        factor = 1.0 / total.range;
    }
    return Sample3d(total.value * factor, total.gradient * factor);
}
