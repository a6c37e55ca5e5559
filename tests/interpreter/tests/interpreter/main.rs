//! The WGSL interpreter compared with Rust.

mod access;
mod binding;
mod builtins;
mod control_flow;
mod operators;
mod refused;
mod rounding;

use asperity_interpreter::{Interpreter, Value};

/// Returns the module, or panics with its error.
#[track_caller]
fn interpreter(wgsl: &str) -> Interpreter {
    Interpreter::new(wgsl).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the value of a module's function.
#[track_caller]
fn value(wgsl: &str, function: &str, arguments: &[Value]) -> Value {
    interpreter(wgsl).call(function, arguments).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the bits, with one word for every NaN.
fn bits(value: f32) -> u32 {
    if value.is_nan() { u32::MAX } else { value.to_bits() }
}
