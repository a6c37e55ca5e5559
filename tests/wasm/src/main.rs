//! The report of this machine.

fn main() {
    print!("{}", asperity_wasm::report());
}
