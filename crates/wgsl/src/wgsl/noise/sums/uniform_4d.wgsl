// Sums of octaves in 4-D, in a uniform written by `OctavesUniform`. A custom module may have more
// sums or read them from elsewhere by replacing these two functions.

struct OctavesUniform4d {
    spectrum: OctavesSpectrum,
    layers: array<OctavesLayer4d, 16>,
}

// The spectrum of a sum.
fn octaves_spectrum_4d(sum: u32) -> OctavesSpectrum {
    return octaves_uniform_4d[sum].spectrum;
}

// Octave i of a sum.
fn octaves_layer_4d(sum: u32, i: u32) -> OctavesLayer4d {
    return octaves_uniform_4d[sum].layers[i];
}
