//! Reads the reference values in `tests/data`.

use serde_json::Value;

/// Returns the JSON file `name` of `tests/data`, as in `reference::read("ndf/gaussian.json")`.
///
/// # Panics
///
/// If the file does not exist or is not JSON.
#[must_use]
pub fn read(name: &str) -> Value {
    let path = format!("{}/data/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Returns the numbers of a JSON array.
///
/// # Panics
/// If the value is not an array of numbers.
#[must_use]
pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("an array").iter().map(|v| v.as_f64().expect("a number")).collect()
}

/// Returns the rows of a JSON array of arrays of numbers.
///
/// # Panics
/// If the value is not an array of arrays of numbers.
#[must_use]
pub fn rows(value: &Value) -> Vec<Vec<f64>> {
    value.as_array().expect("an array").iter().map(numbers).collect()
}
