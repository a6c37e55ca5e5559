// Sums of octaves in 2-D, in a uniform written by `FbmUniform2d`. A custom module may have more
// sums or read them from elsewhere by replacing these two functions.

// The spectrum of a sum.
fn fbm_spectrum_2d(sum: u32) -> FbmSpectrum {
    return fbm_uniform_2d[sum].spectrum;
}

// Octave i of a sum.
fn fbm_layer_2d(sum: u32, i: u32) -> FbmLayer2d {
    return fbm_uniform_2d[sum].layers[i];
}
