//! The functions of the shaders in the interpreter beside those of the crates.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use asperity_shader_tests::{
    case::{Bound, Case, INPUTS, OUTPUTS, Output},
    cases,
    interpreter::Arithmetic,
};
use asperity_shaders::{Binding, Bindings, Imports, Part, module, ordered};

/// Beginnings of the names of cases.
const ROOMS: [&str; 7] =
    ["noise/lattice", "noise/kinds", "noise/sums", "noise/transforms", "ndf/", "shading/", "fif/"];

/// Inputs that are tried with fused sums: bounds are wide, and all adapters are asked for every input in `tests/gpu`.
const FUSED: u32 = Case::COUNT / 4;

/// The first input of a case at which an output is beyond its bound.
fn broken(case: &Case, arithmetic: Arithmetic, bound: fn(&Output) -> Bound) -> Result<(), String> {
    let shader = case.interpreter()?.arithmetic(arithmetic);
    let count = if arithmetic == Arithmetic::Fused { FUSED } else { Case::COUNT };
    let inputs: Vec<[u32; INPUTS]> = (0..count).map(|i| (case.input)(i)).collect();
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

/// Light of materials differs by less than a hundredth in the mean over points, pixels and directions, fused or not.
#[test]
fn materials_are_right_in_the_mean() {
    for case in cases::all().iter().filter(|case| case.name.starts_with("shading/material")) {
        let inputs: Vec<[u32; INPUTS]> = (0..Case::COUNT).map(|i| (case.input)(i)).collect();
        for arithmetic in [Arithmetic::Written, Arithmetic::Fused] {
            let shader = case.interpreter().expect(&case.name).arithmetic(arithmetic);
            let outcomes = shader.call_many("evaluate", &inputs).expect(&case.name);
            let (mut apart, mut light) = (0.0, 0.0);
            for (input, outcome) in inputs.iter().zip(&outcomes) {
                let expected = (case.reference)(*input);
                for k in 0..3 {
                    let [got, expected] =
                        [outcome.words()[k], expected[k]].map(f32::from_bits).map(f64::from);
                    apart += (got - expected).abs();
                    light += expected.abs();
                }
            }
            assert!(apart <= 0.01 * light, "{}, {arithmetic:?}: {}", case.name, apart / light);
        }
    }
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

/// Words of a source, without its comments.
fn words(source: &str) -> HashSet<&str> {
    let code = source.lines().map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(|line| line.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))).collect()
}

/// Parts of all cases that are the crate's, by what they define.
fn homes(parts: &[&'static Part]) -> BTreeMap<&'static str, BTreeSet<&'static str>> {
    let mut homes = BTreeMap::<_, BTreeSet<_>>::new();
    for part in parts {
        let bindings = part.bindings().iter().map(Binding::name);
        for name in part.names().chain(bindings) {
            homes.entry(name).or_default().insert(part.name());
        }
    }
    homes
}

/// Any parts may be in one module, and those who import a part get all that it names.
#[test]
fn names_have_one_home_that_is_imported() {
    let parts: Vec<_> = cases::all().iter().flat_map(|case| ordered(&case.parts)).collect();
    let parts: Vec<_> = parts.into_iter().filter(|part| !part.name().starts_with("case/")).collect();
    let homes = homes(&parts);
    let mut wrong: BTreeSet<_> = homes
        .iter()
        .filter(|(_, homes)| homes.len() > 1)
        .map(|(name, homes)| format!("`{name}` is of {homes:?}"))
        .collect();
    for part in &parts {
        let module = module(part, Imports::Wesl, Bindings::Textures { group: 0 });
        let used = words(part.source());
        for (name, home) in homes.iter().filter(|(name, _)| used.contains(**name)) {
            let home = home.iter().next().expect("a home");
            let import = format!("import package::asperity::{}::", home.replace('/', "::"));
            let imported = module.lines().any(|line| line.starts_with(&import) && words(line).contains(name));
            if *home != part.name() && !imported {
                wrong.insert(format!("{} names `{name}` of {home}", part.name()));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn every_case_is_in_a_room() {
    for case in cases::all() {
        assert_eq!(ROOMS.iter().filter(|room| case.name.starts_with(**room)).count(), 1, "{}", case.name);
    }
}
