// Sums of octaves in 3-D, in a uniform written by `OctavesUniform`. A custom module may have more
// sums or read them from elsewhere by replacing these two functions.

struct OctavesUniform3d {
    spectrum: OctavesSpectrum,
    layers: array<OctavesLayer3d, 16>,
}

// The spectrum of a sum.
fn octaves_spectrum_3d(sum: u32) -> OctavesSpectrum {
    return octaves_uniform_3d[sum].spectrum;
}

// Octave i of a sum.
fn octaves_layer_3d(sum: u32, i: u32) -> OctavesLayer3d {
    return octaves_uniform_3d[sum].layers[i];
}
