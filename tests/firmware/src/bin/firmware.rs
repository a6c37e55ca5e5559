//! Renders the image on a Cortex-M4: a portable gray map to the debugger's output, hash and stack
//! depth to its error output.
#![no_std]
#![no_main]

use asperity_firmware::{HEADER, START, draw, hash, hexadecimal, stack};
use cortex_m_rt::entry;
use cortex_m_semihosting::{
    debug::{self, EXIT_FAILURE, EXIT_SUCCESS},
    hio,
};
use panic_halt as _;

#[entry]
fn main() -> ! {
    debug::exit(if run() { EXIT_SUCCESS } else { EXIT_FAILURE });
    // Not reached in an emulator.
    loop {}
}

fn run() -> bool {
    let (Ok(mut out), Ok(mut err)) = (hio::hstdout(), hio::hstderr()) else { return false };
    let mut said = out.write_all(HEADER).is_ok();
    let (mut digest, mut whole) = (START, false);
    let depth = stack::depth(&mut || {
        whole = draw(&mut |row| {
            digest = hash(digest, row);
            said &= out.write_all(row).is_ok();
        });
    });
    for (name, word) in [(b"hash  ", digest), (b"stack ", depth as u32)] {
        said &= [&name[..], &hexadecimal(word), b"\n"].iter().all(|part| err.write_all(part).is_ok());
    }
    whole && said
}
