// Spectra of sums of octaves: asperity_noise::FbmSpectrum, with the divisor of a sum. The number of
// octaves is a real number. Negative numbers and NaN are taken as 0, and numbers above the maximum
// as the maximum.

// The constant that a sum starts from, the factor that it ends with, and the sum of the squares of
// its amplitudes, unclamped.
struct FbmDivisor {
    constant: f32,
    factor: f32,
    squares: f32,
}

// Whether there is any octave, even with a tiny fraction. Compares bits, as compilers may assume
// that no number is NaN, and hardware may flush small numbers to 0.
fn fbm_any(octaves: f32) -> bool {
    return bitcast<u32>(octaves) - 1u < 0x7f800000u;
}

// The number of octaves in [0, max_octaves].
fn fbm_within(octaves: f32, spectrum: FbmSpectrum) -> f32 {
    return select(0.0, min(octaves, spectrum.max_octaves), fbm_any(octaves));
}

// The number of octaves, with a lone octave made whole, as its weight cancels against the divisor.
fn fbm_lone_whole(octaves: f32, spectrum: FbmSpectrum) -> f32 {
    return select(0.0, min(max(octaves, 1.0), spectrum.max_octaves), fbm_any(octaves));
}

// Constant and divisor of a sum, `Fbm::with_octaves(octaves).band_limited(footprint)`.
fn fbm_divisor(octaves: f32, footprint: f32, spectrum: FbmSpectrum) -> FbmDivisor {
    let whole = fbm_lone_whole(octaves, spectrum);
    var constant = 0.0;
    var sum = 0.0;
    var squares = 0.0;
    var amplitude = 1.0;
    for (var i = 0u; i < 16u; i++) {
        let weight = min(whole - f32(i), 1.0);
        if !(weight > 0.0) {
            break;
        }
        let weighted = weight * amplitude;
        amplitude *= spectrum.gain;
        constant -= spectrum.mean * weighted;
        sum += weighted;
        squares += weighted * weighted;
    }
    var norm = spectrum.deviation * sqrt(squares);
    if spectrum.normalization == 0u {
        constant = 0.0;
        norm = sum;
    }
    var factor = 0.0;
    if norm > 0.0 {
        factor = 1.0 / norm;
    }
    // Removed octaves are replaced by their mean.
    if spectrum.mean != 0.0 && footprint > 0.0 {
        amplitude = 1.0;
        var frequency = 1.0;
        for (var i = 0u; i < 16u; i++) {
            let weight = min(whole - f32(i), 1.0);
            if !(weight > 0.0) {
                break;
            }
            let removed = frequency_clamp_filtered_fraction(footprint, frequency);
            constant += weight * amplitude * removed * spectrum.mean;
            amplitude *= spectrum.gain;
            frequency *= spectrum.lacunarity;
        }
    }
    return FbmDivisor(constant, factor, squares);
}

// The fraction in [0, 1) of the whole spectrum's variance, from the sum of squares of
// `fbm_divisor`: `FbmSpectrum::resolved_variance`.
fn fbm_resolved_variance(octaves: f32, squares: f32, spectrum: FbmSpectrum) -> f32 {
    let within = fbm_within(octaves, spectrum);
    // Here a lone octave has its weight.
    let resolved = select(squares, within * within, within < 1.0);
    if spectrum.gain < 1.0 {
        return min(resolved * spectrum.variance, 0.99999994);
    }
    return min(resolved / spectrum.variance, 0.99999994);
}

// The weight of the first octave in [0, 1]: how far the sum has faded in, `FbmSpectrum::weight`.
fn fbm_fade(octaves: f32, spectrum: FbmSpectrum) -> f32 {
    return min(fbm_within(octaves, spectrum), 1.0);
}

// Iteration over the active octaves.
struct FbmWalk {
    spectrum: FbmSpectrum,
    // The number of octaves with a lone octave made whole, and the footprint for frequency
    // clamping.
    whole: f32,
    footprint: f32,
    // The number of the next octave, its full amplitude and frequency, and its weighted amplitude;
    // 0 after the last.
    octave: u32,
    amplitude: f32,
    frequency: f32,
    weight: f32,
}

// The first octave.
fn fbm_walk(octaves: f32, footprint: f32, spectrum: FbmSpectrum) -> FbmWalk {
    let whole = fbm_lone_whole(octaves, spectrum);
    return fbm_weighted(FbmWalk(spectrum, whole, footprint, 0u, 1.0, 1.0, 0.0));
}

// The next octave.
fn fbm_next(walk: FbmWalk) -> FbmWalk {
    let amplitude = walk.amplitude * walk.spectrum.gain;
    let frequency = walk.frequency * walk.spectrum.lacunarity;
    let octave = walk.octave + 1u;
    return fbm_weighted(
        FbmWalk(walk.spectrum, walk.whole, walk.footprint, octave, amplitude, frequency, 0.0),
    );
}

// An octave with its weighted amplitude.
fn fbm_weighted(walk: FbmWalk) -> FbmWalk {
    let weight = min(walk.whole - f32(walk.octave), 1.0);
    var weighted = walk;
    if weight > 0.0 {
        let removed = frequency_clamp_filtered_fraction(walk.footprint, walk.frequency);
        weighted.weight = weight * walk.amplitude * (1.0 - removed);
    }
    return weighted;
}

// Whether there is an octave.
fn fbm_goes_on(walk: FbmWalk) -> bool {
    return walk.octave < 16u && walk.weight > 0.0;
}
