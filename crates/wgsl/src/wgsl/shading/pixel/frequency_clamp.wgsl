// The real number of octaves that a pixel resolves: asperity_shading::pixel::FrequencyClamp.

// Octaves of a footprint by its width, in [0, max_octaves]: `FrequencyClamp::octaves`. Negative
// widths are taken as their magnitude, NaN as infinite, and widths up to 2^-126 of a cell as 0.
fn frequency_clamp_octaves(width: f32, limits: FrequencyClamp) -> f32 {
    let cells = 2.0 * abs(width) * limits.frequency;
    // Bits of 1 and above, infinity and NaN.
    if (bitcast<u32>(cells) & 0x7fffffffu) >= 0x3f800000u {
        return 0.0;
    }
    if cells < 1.1754944e-38 {
        return limits.max_octaves;
    }
    // The error of the built-in logarithm is one unit in the last place, a millionth of an octave.
    return clamp(-log2(cells) / limits.log_lacunarity, 0.0, limits.max_octaves);
}
