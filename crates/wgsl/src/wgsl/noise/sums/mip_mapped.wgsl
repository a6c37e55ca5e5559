// Octaves of Gaussian noise in 2-D, two channels, from a mip-mapped texture: Kautz, Heidrich,
// Seidel 2001, "Real-Time Bump Map Synthesis", section 5.2.2. Level l is the sum of all octaves
// except the finest l, each times its amplitude and without a divisor. A blend of two levels is
// therefore a sum with a fraction of one octave.

struct MipMappedFbm {
    // Both channels, N(0, 1) except for the filter between texels.
    value: vec2<f32>,
    resolved_variance: f32,
    fade: f32,
}

// The first octaves of the texture's sum. The texture repeats in every unit square of `uv`.
fn mip_mapped_fbm(uv: vec2<f32>, octaves: f32, sum: u32) -> MipMappedFbm {
    let spectrum = fbm_spectrum_2d(sum);
    let within = fbm_within(octaves, spectrum);
    let divisor = fbm_divisor(octaves, 0.0, spectrum);
    let texel = textureSampleLevel(mip_mapped_noise, mip_mapped_sampler, uv, spectrum.max_octaves - within).xy;
    // The texture contains a lone octave with its weight.
    var factor = divisor.factor;
    if within < 1.0 {
        factor /= max(within, 1e-6);
    }
    let resolved_variance = fbm_resolved_variance(octaves, divisor.squares, spectrum);
    return MipMappedFbm(texel * factor, resolved_variance, fbm_fade(octaves, spectrum));
}
