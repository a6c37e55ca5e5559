// Frequency clamping: asperity_noise::removed_share.

// The share of an octave that is removed for a footprint: smoothstep(0.2, 0.6, footprint * frequency). Nothing is removed for a
// footprint that is negative or no number.
fn frequency_clamp_removed_share(footprint: f32, frequency: f32) -> f32 {
    let x = footprint * frequency;
    // By bits, as compilers may take it that no number is NaN.
    if bitcast<u32>(x) > 0x7f800000u {
        return 0.0;
    }
    if x >= 0.6 {
        return 1.0;
    }
    if x > 0.2 {
        // The difference as it is rounded.
        let t = (x - 0.2) / 0.40000004;
        return t * t * (3.0 - 2.0 * t);
    }
    return 0.0;
}
