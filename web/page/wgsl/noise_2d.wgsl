// A slice of noise in 2-D: octaves from `noise_octave_2d`, summed, warped and displayed.

// Sum 0 is the field, 1 to 2 are its warp fields.
fn noise_sum_2d(p: vec2<f32>, sum: u32) -> Sample2d {
    let ridged = noise_view.ridged == 1u && sum % 4u == 0u;
    var total = fbm_total_2d(noise_view.octaves, noise_view.footprint, sum);
    var ridges = ridged_multifractal_2d(noise_view.octaves, noise_view.feedback, sum);
    var walk = total.walk;
    if ridged {
        walk = ridges.walk;
    }
    while fbm_goes_on(walk) {
        let layer = fbm_layer_2d(sum, walk.octave);
        let octave = noise_octave_2d(layer, p);
        if ridged {
            ridges = ridged_multifractal_added_2d(ridges, layer, octave);
            walk = ridges.walk;
        } else {
            total = fbm_added_2d(total, layer, octave);
            walk = total.walk;
        }
    }
    if ridged {
        return ridged_multifractal_divided_2d(ridges);
    }
    return fbm_divided_2d(total);
}

// First the warp sums, then the field at the displaced point.
@fragment
fn noise_pixel_2d(screen: Screen) -> @location(0) vec4<f32> {
    let p = noise_point(screen.at).xy;
    var samples = array<Sample2d, 5>();
    var moved = warp_displacement_2d(p, 0.0, samples[0], samples[1]);
    let first = select(1u, 3u, noise_view.strength == 0.0);
    for (var turn = first; turn <= 3u; turn++) {
        var q = p;
        var sum = turn;
        if turn == 3u {
            moved = warp_displacement_2d(p, noise_view.strength, samples[1], samples[2]);
            q = moved.point;
            sum = 0u;
        }
        samples[sum] = noise_sum_2d(q, sum);
    }
    let seen = warp_sample_2d(moved, samples[0]);
    if noise_view.flow > 0.0 {
        let velocity = vec3<f32>(curl_velocity_2d(seen.gradient), 0.0);
        return noise_shown(seen.value, velocity.xy, velocity);
    }
    return noise_shown(seen.value, seen.gradient.xy, vec3<f32>(0.0));
}
