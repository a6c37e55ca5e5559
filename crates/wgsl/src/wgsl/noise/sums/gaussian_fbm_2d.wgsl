// Sums of octaves of Gaussian noise in 2-D, two channels, N(0, 1) at every point for every real
// number of octaves: asperity_noise::GaussianFbm.

// Both channels with their gradients, the fraction of the whole spectrum's variance that they
// carry, in [0, 1), and the weight of the first octave, in [0, 1].
struct GaussianFbm2d {
    pair: GaussianPair2d,
    resolved_variance: f32,
    fade: f32,
}

// Both channels of one octave in its own coordinates, with cells relative to another cell; 0 if a
// coordinate is not finite.
fn gaussian_fbm_pair_2d(cell: vec2<i32>, q: vec2<f32>, key: u32) -> GaussianPair2d {
    let at = cell_place_2d(q);
    if !at.known {
        return GaussianPair2d(vec2<f32>(0.0), vec2<f32>(0.0), vec2<f32>(0.0));
    }
    return gaussian_pair_in_cell_2d(cell + at.cell, at.place, key);
}

// The first octaves of a sum: `GaussianFbm::pair_with_octaves`, `FbmSpectrum::resolved_variance` and
// `FbmSpectrum::weight`. For an anchored sum `p` is the difference to the anchor.
fn gaussian_fbm_2d(p: vec2<f32>, octaves: f32, sum: u32) -> GaussianFbm2d {
    let spectrum = fbm_spectrum_2d(sum);
    let whole = fbm_lone_whole(octaves, spectrum);
    let divisor = fbm_divisor(octaves, 0.0, spectrum);
    var value = vec2<f32>(0.0);
    var dx = vec2<f32>(0.0);
    var dy = vec2<f32>(0.0);
    var amplitude = 1.0;
    for (var i = 0u; i < 16u; i++) {
        let weight = min(whole - f32(i), 1.0);
        if !(weight > 0.0) {
            break;
        }
        let weighted = weight * amplitude;
        amplitude *= spectrum.gain;
        let layer = fbm_layer_2d(sum, i);
        let octave = gaussian_fbm_pair_2d(layer.cell, fbm_point_2d(layer, p), layer.key);
        value += weighted * octave.value;
        dx += weighted * (layer.rows.x * octave.dx + layer.rows.z * octave.dy);
        dy += weighted * (layer.rows.y * octave.dx + layer.rows.w * octave.dy);
    }
    let factor = divisor.factor;
    return GaussianFbm2d(
        GaussianPair2d(value * factor, dx * factor, dy * factor),
        fbm_resolved_variance(octaves, divisor.squares, spectrum),
        fbm_fade(octaves, spectrum),
    );
}
