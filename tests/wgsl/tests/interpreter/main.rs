//! The interpreter of WGSL against Rust.

mod access;
mod binding;
mod builtins;
mod control_flow;
mod operators;
mod refused;
mod rounding;

use asperity_wgsl::{Interpreter, Value};

/// The module, or a panic that shows what is wrong with it.
#[track_caller]
fn interpreter(wgsl: &str) -> Interpreter {
    Interpreter::new(wgsl).unwrap_or_else(|error| panic!("{error}"))
}

/// The value of a function of a module.
#[track_caller]
fn value(wgsl: &str, function: &str, arguments: &[Value]) -> Value {
    interpreter(wgsl).call(function, arguments).unwrap_or_else(|error| panic!("{error}"))
}

/// Bits, with one word for everything that is not a number.
fn bits(value: f32) -> u32 {
    if value.is_nan() { u32::MAX } else { value.to_bits() }
}
