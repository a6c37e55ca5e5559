//! The depth of the stack: the words below it are painted, the function is called, what was painted over is counted.

use core::ptr::addr_of;

const PAINT: u32 = 0xa5a5_a5a5;
/// Left alone below the caller's frame: the frames of the painter itself.
const MARGIN: usize = 64;

unsafe extern "C" {
    /// The end of what static variables take, from cortex-m-rt's script; the stack grows down to it.
    static __sheap: u32;
}

/// Bytes of stack that a call takes, its own frame included, to the word.
#[inline(never)]
pub fn depth(call: &mut dyn FnMut()) -> usize {
    let here = 0_u32;
    let top = addr_of!(here).addr() - MARGIN & !3;
    let bottom = addr_of!(__sheap).addr();
    let words = || (bottom..top).step_by(4).map(core::ptr::with_exposed_provenance_mut::<u32>);
    // Nothing else uses the words below this frame; no interrupt is enabled.
    words().for_each(|word| unsafe { word.write_volatile(PAINT) });
    call();
    let first = words().position(|word| unsafe { word.read_volatile() } != PAINT);
    first.map_or(0, |first| top - bottom - 4 * first)
}
