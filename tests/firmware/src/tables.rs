//! The packed map of [`density`](crate::density) in flash. `cargo xtask firmware --ship` writes its
//! file.

const BYTES: &[u8] = include_bytes!("density.bin");
const LEN: usize = BYTES.len() / 4;

pub(crate) static DENSITY: [f32; LEN] = words();

const fn words() -> [f32; LEN] {
    let mut words = [0.0; LEN];
    let mut k = 0;
    while k < LEN {
        let at = 4 * k;
        words[k] = f32::from_le_bytes([BYTES[at], BYTES[at + 1], BYTES[at + 2], BYTES[at + 3]]);
        k += 1;
    }
    words
}
