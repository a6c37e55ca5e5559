//! The functions of the shaders in the interpreter beside those of the crates.

use asperity_shader_tests::{
    case::{Bound, Case, INPUTS, OUTPUTS, Output},
    cases,
    interpreter::Arithmetic,
};

/// What the names of cases begin with.
const ROOMS: [&str; 7] =
    ["noise/lattice", "noise/kinds", "noise/sums", "noise/transforms", "ndf/", "shading/", "fif/"];

/// The first input of a case at which an output is beyond its bound.
fn broken(case: &Case, arithmetic: Arithmetic, bound: fn(&Output) -> Bound) -> Result<(), String> {
    let shader = case.interpreter()?.arithmetic(arithmetic);
    let inputs: Vec<[u32; INPUTS]> = (0..Case::COUNT).map(|i| (case.input)(i)).collect();
    let outcomes = shader.call_many("evaluate", &inputs)?;
    for (i, (input, outcome)) in inputs.iter().zip(&outcomes).enumerate() {
        let expected: [u32; OUTPUTS] = (case.reference)(*input);
        for output in &case.outputs {
            for k in output.words.clone() {
                let (got, expected, bound) = (outcome.words()[k], expected[k], bound(output));
                let error = bound.error(got, expected);
                if error > bound.limit() {
                    let [got, expected] = [got, expected].map(|word| (word, f32::from_bits(word)));
                    let name = output.name;
                    return Err(format!("input {i}, {name}, word {k}: {got:?}, not {expected:?}, {error:e}"));
                }
            }
        }
    }
    Ok(())
}

/// All cases of a room, as written and fused.
fn hold(room: &str) {
    let failures: Vec<String> = cases::all()
        .iter()
        .filter(|case| case.name.starts_with(room))
        .flat_map(|case| {
            let written = broken(case, Arithmetic::Written, |output| output.written)
                .map_err(|e| format!("written, {e}"));
            let fused =
                broken(case, Arithmetic::Fused, |output| output.adapter).map_err(|e| format!("fused, {e}"));
            [written, fused]
                .into_iter()
                .filter_map(Result::err)
                .map(|error| format!("{}: {error}", case.name))
        })
        .collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn lattices() {
    hold(ROOMS[0]);
}

#[test]
fn kinds_of_noise() {
    hold(ROOMS[1]);
}

#[test]
fn sums_of_octaves() {
    hold(ROOMS[2]);
}

#[test]
fn transforms_of_fields() {
    hold(ROOMS[3]);
}

#[test]
fn densities_of_normals() {
    hold(ROOMS[4]);
}

#[test]
fn shading() {
    hold(ROOMS[5]);
}

#[test]
fn fractal_interpolation() {
    hold(ROOMS[6]);
}

/// Coordinates from the middle of a sphere of 40 cells lose what its finer octaves need where products and sums are fused; differences
/// to an anchor do not, as one of the cases shows.
#[test]
fn absolute_coordinates_fail_where_anchors_hold() {
    for zoom in [100.0, 1e4] {
        let case = cases::sums::anchors::absolute(zoom);
        let fused = broken(&case, Arithmetic::Fused, |output| output.adapter);
        assert!(fused.is_err_and(|error| error.contains("gradient")), "zoom {zoom}");
    }
}

#[test]
fn every_case_is_in_a_room() {
    for case in cases::all() {
        assert_eq!(ROOMS.iter().filter(|room| case.name.starts_with(**room)).count(), 1, "{}", case.name);
    }
}
