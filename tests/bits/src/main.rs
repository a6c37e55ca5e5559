//! Prints the report of the machine that runs this program.
#![cfg_attr(feature = "freestanding", no_std, no_main)]

#[cfg(not(feature = "freestanding"))]
fn main() {
    print!("{}", asperity_bits::report());
}

#[cfg(feature = "freestanding")]
mod freestanding;
