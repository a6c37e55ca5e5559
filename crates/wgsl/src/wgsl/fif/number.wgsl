// Tests for NaN.

// Whether x is not NaN.
fn fif_is_number(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7fffffffu) <= 0x7f800000u;
}
