// A slice of noise in 4-D: octaves from `noise_octave_4d`, summed and displayed.

// Sum 0 is the field.
fn noise_sum_4d(p: vec4<f32>, sum: u32) -> Sample4d {
    let ridged = noise_view.ridged == 1u && sum % 4u == 0u;
    var total = fbm_total_4d(noise_view.octaves, noise_view.footprint, sum);
    var ridges = ridged_multifractal_4d(noise_view.octaves, noise_view.feedback, sum);
    var walk = total.walk;
    if ridged {
        walk = ridges.walk;
    }
    while fbm_goes_on(walk) {
        let layer = fbm_layer_4d(sum, walk.octave);
        let octave = noise_octave_4d(layer, p);
        if ridged {
            ridges = ridged_multifractal_added_4d(ridges, layer, octave);
            walk = ridges.walk;
        } else {
            total = fbm_added_4d(total, layer, octave);
            walk = total.walk;
        }
    }
    if ridged {
        return ridged_multifractal_divided_4d(ridges);
    }
    return fbm_divided_4d(total);
}

@fragment
fn noise_pixel_4d(screen: Screen) -> @location(0) vec4<f32> {
    let seen = noise_sum_4d(noise_point(screen.at), 0u);
    return noise_shown(seen.value, seen.gradient.xy, vec3<f32>(0.0));
}
