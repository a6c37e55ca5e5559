//! A module of WebAssembly: one function, which tells where the report is.

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

static mut REPORT: [usize; 2] = [0; 2];

/// The address of the address and the length of the report; to be called once.
#[unsafe(no_mangle)]
pub extern "C" fn report() -> *const [usize; 2] {
    let text = super::report();
    unsafe { REPORT = [text.as_ptr() as usize, text.len()] };
    &raw const REPORT
}
