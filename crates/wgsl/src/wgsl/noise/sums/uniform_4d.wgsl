// Sums of octaves in 4-D, in a uniform written by `FbmUniform4d`. A custom module may have more
// sums or read them from elsewhere by replacing these two functions.

// The spectrum of a sum.
fn fbm_spectrum_4d(sum: u32) -> FbmSpectrum {
    return fbm_uniform_4d[sum].spectrum;
}

// Octave i of a sum.
fn fbm_layer_4d(sum: u32, i: u32) -> FbmLayer4d {
    return fbm_uniform_4d[sum].layers[i];
}
