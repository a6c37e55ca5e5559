//! On Linux without std: the C library starts the program and writes its output.

use core::{
    ffi::{c_int, c_void},
    panic::PanicInfo,
};

unsafe extern "C" {
    fn write(file: c_int, bytes: *const c_void, count: usize) -> isize;
    fn abort() -> !;
}

#[unsafe(no_mangle)]
extern "C" fn main() -> c_int {
    let mut rest = super::report().as_bytes();
    while !rest.is_empty() {
        // The pointer and the count belong to a slice.
        let written = unsafe { write(1, rest.as_ptr().cast(), rest.len()) };
        match usize::try_from(written) {
            Ok(written @ 1..) => rest = &rest[written..],
            _ => return 1,
        }
    }
    0
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    unsafe { abort() }
}

/// Required by a precompiled core library; never called, because a panic aborts.
#[unsafe(no_mangle)]
extern "C" fn rust_eh_personality() {}
