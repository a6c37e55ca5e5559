//! Means of a program without std: a heap, an end for panics, a way in and a way out.

#[cfg(target_os = "none")]
mod cortex_m;
#[cfg(target_os = "linux")]
mod linux;
#[cfg(target_family = "wasm")]
mod module;

use core::mem::MaybeUninit;

use linked_list_allocator::LockedHeap;

/// More than twice what the report takes at once.
const BYTES: usize = 8 << 20;

#[global_allocator]
static HEAP: LockedHeap = LockedHeap::empty();

/// The report; to be called once.
fn report() -> &'static str {
    static mut REGION: [MaybeUninit<u8>; BYTES] = [MaybeUninit::uninit(); BYTES];
    // The region has no other user, because this runs once.
    unsafe { HEAP.lock().init((&raw mut REGION).cast(), BYTES) };
    asperity_bits::report().leak()
}
