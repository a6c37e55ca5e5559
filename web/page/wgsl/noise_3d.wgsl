// A slice of noise in 3-D: octaves from `noise_octave_3d`, summed, warped and displayed.

// Sum 0 is the field, 1 to 3 are its warp fields, and 4 is the second field of a flow in space.
fn noise_sum_3d(p: vec3<f32>, sum: u32) -> Sample3d {
    let ridged = noise_view.ridged == 1u && sum % 4u == 0u;
    var total = fbm_total_3d(noise_view.octaves, noise_view.footprint, sum);
    var ridges = ridged_multifractal_3d(noise_view.octaves, noise_view.feedback, sum);
    var walk = total.walk;
    if ridged {
        walk = ridges.walk;
    }
    while fbm_goes_on(walk) {
        let layer = fbm_layer_3d(sum, walk.octave);
        let octave = noise_octave_3d(layer, p);
        if ridged {
            ridges = ridged_multifractal_added_3d(ridges, layer, octave);
            walk = ridges.walk;
        } else {
            total = fbm_added_3d(total, layer, octave);
            walk = total.walk;
        }
    }
    if ridged {
        return ridged_multifractal_divided_3d(ridges);
    }
    return fbm_divided_3d(total);
}

// First the warp sums, then the field at the displaced point, and the second field of a flow.
@fragment
fn noise_pixel_3d(screen: Screen) -> @location(0) vec4<f32> {
    let p = noise_point(screen.at).xyz;
    var samples = array<Sample3d, 5>();
    var moved = warp_displacement_3d(p, 0.0, samples[0], samples[1], samples[2]);
    let first = select(1u, 4u, noise_view.strength == 0.0);
    let last = select(4u, 5u, noise_view.flow > 0.0);
    for (var turn = first; turn <= last; turn++) {
        var q = p;
        var sum = turn;
        if turn == 4u {
            moved = warp_displacement_3d(p, noise_view.strength, samples[1], samples[2], samples[3]);
            q = moved.point;
            sum = 0u;
        } else if turn == 5u {
            sum = 4u;
        }
        samples[sum] = noise_sum_3d(q, sum);
    }
    let seen = warp_sample_3d(moved, samples[0]);
    if noise_view.flow > 0.0 {
        let velocity = curl_velocity_3d(seen.gradient, samples[4].gradient);
        return noise_shown(seen.value, velocity.xy, velocity);
    }
    return noise_shown(seen.value, seen.gradient.xy, vec3<f32>(0.0));
}
