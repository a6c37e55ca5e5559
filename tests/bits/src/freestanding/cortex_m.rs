//! On a Cortex-M: writes the report to the debugger's output.

use core::{fmt::Write, panic::PanicInfo};

use cortex_m_rt::entry;
use cortex_m_semihosting::{
    debug::{self, EXIT_FAILURE, EXIT_SUCCESS},
    hio,
};

#[entry]
fn main() -> ! {
    let said = hio::hstdout().is_ok_and(|mut out| out.write_str(super::report()).is_ok());
    debug::exit(if said { EXIT_SUCCESS } else { EXIT_FAILURE });
    // Not reached in an emulator.
    loop {}
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    let _ = hio::hstderr().map(|mut err| writeln!(err, "{info}"));
    debug::exit(EXIT_FAILURE);
    loop {}
}
