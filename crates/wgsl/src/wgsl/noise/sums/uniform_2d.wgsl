// Sums of octaves in 2-D, in a uniform written by `OctavesUniform`. A custom module may have more
// sums or read them from elsewhere by replacing these two functions.

struct OctavesUniform2d {
    spectrum: OctavesSpectrum,
    layers: array<OctavesLayer2d, 16>,
}

// The spectrum of a sum.
fn octaves_spectrum_2d(sum: u32) -> OctavesSpectrum {
    return octaves_uniform_2d[sum].spectrum;
}

// Octave i of a sum.
fn octaves_layer_2d(sum: u32, i: u32) -> OctavesLayer2d {
    return octaves_uniform_2d[sum].layers[i];
}
