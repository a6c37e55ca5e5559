// Frequency clamping: asperity_noise::removed_share.

// The share of an octave that is removed for a footprint: smoothstep(0.2, 0.6, footprint * frequency). Nothing is removed for a
// footprint of 0 or less.
fn frequency_clamp_removed_share(footprint: f32, frequency: f32) -> f32 {
    let x = footprint * frequency;
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
