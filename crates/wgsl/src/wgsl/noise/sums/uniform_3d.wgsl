// Sums of octaves in 3-D, in a uniform written by `FbmUniform3d`. A custom module may have more
// sums or read them from elsewhere by replacing these two functions.

// The spectrum of a sum.
fn fbm_spectrum_3d(sum: u32) -> FbmSpectrum {
    return fbm_uniform_3d[sum].spectrum;
}

// Octave i of a sum.
fn fbm_layer_3d(sum: u32, i: u32) -> FbmLayer3d {
    return fbm_uniform_3d[sum].layers[i];
}
