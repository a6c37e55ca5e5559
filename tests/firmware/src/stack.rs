//! Measures stack depth: paints the words below the stack, calls the function, and counts the
//! overwritten words.

use core::ptr::addr_of;

const PAINT: u32 = 0xa5a5_a5a5;
/// Bytes left unpainted below the caller's frame, for the painter's own frames.
const MARGIN: usize = 64;

unsafe extern "C" {
    /// The end of static variables, from cortex-m-rt's linker script. The stack grows down to it.
    static __sheap: u32;
}

/// Returns the bytes of stack used by a call, including its frame, in whole words.
#[inline(never)]
pub fn depth(call: &mut dyn FnMut()) -> usize {
    let here = 0_u32;
    let top = addr_of!(here).addr() - MARGIN & !3;
    let bottom = addr_of!(__sheap).addr();
    let words = || (bottom..top).step_by(4).map(core::ptr::with_exposed_provenance_mut::<u32>);
    // Nothing else uses the words below this frame, and no interrupt is enabled.
    words().for_each(|word| unsafe { word.write_volatile(PAINT) });
    call();
    let first = words().position(|word| unsafe { word.read_volatile() } != PAINT);
    first.map_or(0, |first| top - bottom - 4 * first)
}
