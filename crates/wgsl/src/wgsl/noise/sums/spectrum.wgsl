// Spectra of sums of octaves: asperity_noise::Spectrum, with the divisor of a sum. The number of
// octaves is a real number. Negative numbers and NaN are taken as 0, and numbers above the maximum
// as the maximum.

struct OctavesSpectrum {
    // Ratio of the frequencies of successive octaves, and of their amplitudes.
    lacunarity: f32,
    gain: f32,
    // At most 16.
    max_octaves: f32,
    // 1 - gain^2 for a gain below 1, otherwise the sum of the squares of all amplitudes.
    share: f32,
    // Mean and standard deviation of one octave of amplitude 1.
    mean: f32,
    deviation: f32,
    // 0 for Normalization::Range, 1 for Normalization::Variance.
    normalisation: u32,
    // One of the shapes of octaves.
    shape: u32,
}

// The constant that a sum starts from, the factor that it ends with, and the sum of the squares of
// its amplitudes, unclamped.
struct OctavesDivisor {
    constant: f32,
    factor: f32,
    squares: f32,
}

// Whether there is any octave, even with a tiny fraction. Compares bits, as compilers may assume
// that no number is NaN, and hardware may flush small numbers to 0.
fn octaves_any(octaves: f32) -> bool {
    return bitcast<u32>(octaves) - 1u < 0x7f800000u;
}

// The number of octaves in [0, max_octaves].
fn octaves_within(octaves: f32, spectrum: OctavesSpectrum) -> f32 {
    return select(0.0, min(octaves, spectrum.max_octaves), octaves_any(octaves));
}

// The number of octaves, with a lone octave made whole, as its weight cancels against the divisor.
fn octaves_lone_whole(octaves: f32, spectrum: OctavesSpectrum) -> f32 {
    return select(0.0, min(max(octaves, 1.0), spectrum.max_octaves), octaves_any(octaves));
}

// Constant and divisor of a sum, `Octaves::first(octaves).clamped(footprint)`.
fn octaves_divisor(octaves: f32, footprint: f32, spectrum: OctavesSpectrum) -> OctavesDivisor {
    let whole = octaves_lone_whole(octaves, spectrum);
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
    if spectrum.normalisation == 0u {
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
            let removed = frequency_clamp_removed_share(footprint, frequency);
            constant += weight * amplitude * removed * spectrum.mean;
            amplitude *= spectrum.gain;
            frequency *= spectrum.lacunarity;
        }
    }
    return OctavesDivisor(constant, factor, squares);
}

// The fraction in [0, 1) of the whole spectrum's variance, from the sum of squares of
// `octaves_divisor`: `Spectrum::share`.
fn octaves_share(octaves: f32, squares: f32, spectrum: OctavesSpectrum) -> f32 {
    let within = octaves_within(octaves, spectrum);
    // Here a lone octave has its weight.
    let resolved = select(squares, within * within, within < 1.0);
    if spectrum.gain < 1.0 {
        return min(resolved * spectrum.share, 0.99999994);
    }
    return min(resolved / spectrum.share, 0.99999994);
}

// The weight of the first octave in [0, 1]: how far the sum has faded in, `Spectrum::weight`.
fn octaves_fade(octaves: f32, spectrum: OctavesSpectrum) -> f32 {
    return min(octaves_within(octaves, spectrum), 1.0);
}

// Iteration over the active octaves.
struct OctavesWalk {
    spectrum: OctavesSpectrum,
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
fn octaves_walk(octaves: f32, footprint: f32, spectrum: OctavesSpectrum) -> OctavesWalk {
    let whole = octaves_lone_whole(octaves, spectrum);
    return octaves_weighted(OctavesWalk(spectrum, whole, footprint, 0u, 1.0, 1.0, 0.0));
}

// The next octave.
fn octaves_next(walk: OctavesWalk) -> OctavesWalk {
    let amplitude = walk.amplitude * walk.spectrum.gain;
    let frequency = walk.frequency * walk.spectrum.lacunarity;
    let octave = walk.octave + 1u;
    return octaves_weighted(
        OctavesWalk(walk.spectrum, walk.whole, walk.footprint, octave, amplitude, frequency, 0.0),
    );
}

// An octave with its weighted amplitude.
fn octaves_weighted(walk: OctavesWalk) -> OctavesWalk {
    let weight = min(walk.whole - f32(walk.octave), 1.0);
    var weighted = walk;
    if weight > 0.0 {
        let removed = frequency_clamp_removed_share(walk.footprint, walk.frequency);
        weighted.weight = weight * walk.amplitude * (1.0 - removed);
    }
    return weighted;
}

// Whether there is an octave.
fn octaves_goes_on(walk: OctavesWalk) -> bool {
    return walk.octave < 16u && walk.weight > 0.0;
}
