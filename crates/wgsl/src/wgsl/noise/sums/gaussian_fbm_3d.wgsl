// Sums of octaves of Gaussian noise in 3-D, two channels, N(0, 1) at every point for every real
// number of octaves: asperity_noise::GaussianFbm.

// Both channels with their gradients, the fraction of the whole spectrum's variance that they
// carry, in [0, 1), and the weight of the first octave, in [0, 1].
struct GaussianFbm3d {
    pair: GaussianPair3d,
    resolved_variance: f32,
    fade: f32,
}

// Both channels of one octave in its own coordinates, with cells relative to another cell; 0 if a
// coordinate is not finite.
fn gaussian_fbm_pair_3d(cell: vec3<i32>, q: vec3<f32>, key: u32) -> GaussianPair3d {
    let at = cell_place_3d(q);
    if !at.known {
        return GaussianPair3d(vec2<f32>(0.0), vec2<f32>(0.0), vec2<f32>(0.0), vec2<f32>(0.0));
    }
    return gaussian_pair_in_cell_3d(cell + at.cell, at.place, key);
}

// The first octaves of a sum: `GaussianFbm::pair_with_octaves`, `FbmSpectrum::resolved_variance` and
// `FbmSpectrum::weight`. For an anchored sum `p` is the difference to the anchor.
fn gaussian_fbm_3d(p: vec3<f32>, octaves: f32, sum: u32) -> GaussianFbm3d {
    let spectrum = fbm_spectrum_3d(sum);
    let whole = fbm_lone_whole(octaves, spectrum);
    let divisor = fbm_divisor(octaves, 0.0, spectrum);
    var value = vec2<f32>(0.0);
    var dx = vec2<f32>(0.0);
    var dy = vec2<f32>(0.0);
    var dz = vec2<f32>(0.0);
    var amplitude = 1.0;
    for (var i = 0u; i < 16u; i++) {
        let weight = min(whole - f32(i), 1.0);
        if !(weight > 0.0) {
            break;
        }
        let weighted = weight * amplitude;
        amplitude *= spectrum.gain;
        let layer = fbm_layer_3d(sum, i);
        let octave = gaussian_fbm_pair_3d(layer.cell_and_key.xyz, fbm_point_3d(layer, p), bitcast<u32>(layer.cell_and_key.w));
        value += weighted * octave.value;
        dx += weighted * (layer.row_x.x * octave.dx + layer.row_y.x * octave.dy + layer.row_z.x * octave.dz);
        dy += weighted * (layer.row_x.y * octave.dx + layer.row_y.y * octave.dy + layer.row_z.y * octave.dz);
        dz += weighted * (layer.row_x.z * octave.dx + layer.row_y.z * octave.dy + layer.row_z.z * octave.dz);
    }
    let factor = divisor.factor;
    return GaussianFbm3d(
        GaussianPair3d(value * factor, dx * factor, dy * factor, dz * factor),
        fbm_resolved_variance(octaves, divisor.squares, spectrum),
        fbm_fade(octaves, spectrum),
    );
}
