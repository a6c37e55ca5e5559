//! The golden bits of noise, computed on a Cortex-M4 and compared with the pinned ones.
#![no_std]
#![no_main]

#[path = "../../../crates/noise/tests/golden/computed.rs"]
mod computed;
#[path = "../../../crates/noise/tests/golden/pinned.rs"]
mod pinned;

use cortex_m_rt::entry;
use cortex_m_semihosting::{
    debug::{self, EXIT_FAILURE, EXIT_SUCCESS},
    hprintln,
};
use panic_halt as _;
use pinned::{FIELDS, NUMBERS};

#[entry]
fn main() -> ! {
    let (mut computed, mut other) = (0, 0);
    computed::fields(&mut |name, golden| {
        let pinned = FIELDS.get(computed);
        if pinned != Some(&(name, golden)) {
            hprintln!("{}: {:x?}, pinned {:x?}", name, golden, pinned);
            other += 1;
        }
        computed += 1;
    });
    computed::batches(&mut |name, golden| {
        if !FIELDS.contains(&(name, golden)) {
            hprintln!("{}, batch: {:x?}", name, golden);
            other += 1;
        }
    });
    let mut numbers = 0;
    computed::numbers(&mut |name, digest| {
        let pinned = NUMBERS.get(numbers);
        if pinned != Some(&(name, digest)) {
            hprintln!("{}: {:x}, pinned {:x?}", name, digest, pinned);
            other += 1;
        }
        numbers += 1;
    });
    let same = other == 0 && computed == FIELDS.len() && numbers == NUMBERS.len();
    if same {
        hprintln!("{} golden bits agree", computed + numbers);
    }
    debug::exit(if same { EXIT_SUCCESS } else { EXIT_FAILURE });
    // Not reached in an emulator.
    loop {}
}
