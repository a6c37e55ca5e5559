//! Runtime of a program without std: heap, panic handler, entry and exit.

#[cfg(target_os = "none")]
mod cortex_m;
#[cfg(target_os = "linux")]
mod linux;
#[cfg(target_family = "wasm")]
mod module;

use core::mem::MaybeUninit;

use linked_list_allocator::LockedHeap;

/// More than twice the peak memory of the report.
const BYTES: usize = 8 << 20;

#[global_allocator]
static HEAP: LockedHeap = LockedHeap::empty();

/// Returns the report. Call once.
fn report() -> &'static str {
    static mut REGION: [MaybeUninit<u8>; BYTES] = [MaybeUninit::uninit(); BYTES];
    // Nothing else uses the region, because this runs once.
    unsafe { HEAP.lock().init((&raw mut REGION).cast(), BYTES) };
    asperity_bits::report().leak()
}
