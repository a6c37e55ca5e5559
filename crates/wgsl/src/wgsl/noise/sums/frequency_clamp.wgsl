// Frequency clamping: asperity_noise::filtered_fraction.

// The fraction of an octave that a footprint removes: smoothstep(0.2, 0.6, footprint * frequency).
// Negative footprints and NaN remove nothing.
fn frequency_clamp_filtered_fraction(footprint: f32, frequency: f32) -> f32 {
    let x = footprint * frequency;
    // Compares bits, as compilers may assume that no number is NaN.
    if bitcast<u32>(x) > 0x7f800000u {
        return 0.0;
    }
    if x >= 0.6 {
        return 1.0;
    }
    if x > 0.2 {
        // The rounded difference.
        let t = (x - 0.2) / 0.40000004;
        return t * t * (3.0 - 2.0 * t);
    }
    return 0.0;
}
