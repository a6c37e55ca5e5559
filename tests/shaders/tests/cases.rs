//! Shader functions in the interpreter, compared with the crates.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::sync::LazyLock;

use asperity_shader_tests::{
    case::{Bound, Case, INPUTS, OUTPUTS, Output},
    cases,
    interpreter::{Arithmetic, Interpreter},
};
use asperity_wgsl::{Binding, Bindings, Imports, Part, module, ordered};

/// Name prefixes of cases.
const ROOMS: [&str; 7] =
    ["noise/lattice", "noise/kinds", "noise/sums", "noise/transforms", "ndf/", "shading/", "fif/"];

/// One of this many inputs is tested with fused sums, because bounds are wide and `tests/gpu` tests
/// every input on all adapters.
const FUSED: usize = 8;

/// All cases, created once for all tests.
static CASES: LazyLock<Vec<Case>> = LazyLock::new(cases::all);

/// Compares the outcomes of a case with its references. Returns the first input with an output
/// beyond its bound, or a wrong mean radiance.
fn broken(
    case: &Case,
    shader: &Interpreter,
    given: &[([u32; INPUTS], [u32; OUTPUTS])],
    bound: fn(&Output) -> Bound,
) -> Result<(), String> {
    let inputs: Vec<[u32; INPUTS]> = given.iter().map(|(input, _)| *input).collect();
    let outcomes = shader.call_many("evaluate", &inputs)?;
    for output in &case.outputs {
        let bound = bound(output);
        let (mut apart, mut light) = (0.0, 0.0);
        for (i, ((_, expected), outcome)) in given.iter().zip(&outcomes).enumerate() {
            for k in output.words.clone() {
                let words = [outcome.words()[k], expected[k]];
                let error = bound.error(words[0], words[1]);
                if error > bound.limit() {
                    let [got, expected] = words.map(|word| (word, f32::from_bits(word)));
                    let name = output.name;
                    return Err(format!("input {i}, {name}, word {k}: {got:?}, not {expected:?}, {error:e}"));
                }
                let [got, expected] = words.map(f32::from_bits).map(f64::from);
                apart += (got - expected).abs();
                light += expected.abs();
            }
        }
        // For materials, the mean over points, pixels and directions.
        if output.name == "light"
            && case.name.starts_with("shading/material")
            && (apart > 0.01 * light || apart.is_nan())
        {
            return Err(format!("mean radiance differs by {:e}", apart / light));
        }
    }
    Ok(())
}

/// Returns inputs of a case with the crates' outputs.
fn given(case: &Case, count: u32) -> Vec<([u32; INPUTS], [u32; OUTPUTS])> {
    (0..count)
        .map(|i| {
            let input = (case.input)(i);
            (input, (case.reference)(input))
        })
        .collect()
}

/// Tests a case as written and fused.
fn failures(case: &Case) -> Vec<String> {
    // Cases that call the same functions with other tables or parameters split the number of
    // inputs. All have a quarter of them: `tests/gpu` compares all.
    let alike = CASES.iter().filter(|other| other.body == case.body).count();
    let given = given(case, Case::COUNT.div_ceil(4 * alike as u32));
    let shader = match case.interpreter() {
        Ok(shader) => shader,
        Err(error) => return vec![format!("{}: {error}", case.name)],
    };
    let written = broken(case, &shader, &given, |output| output.written);
    let shader = shader.arithmetic(Arithmetic::Fused);
    let fused = broken(case, &shader, &given[..given.len() / FUSED], |output| output.adapter);
    [("written", written), ("fused", fused)]
        .into_iter()
        .filter_map(|(arithmetic, result)| Some(format!("{}: {arithmetic}, {}", case.name, result.err()?)))
        .collect()
}

/// Tests all cases of a prefix.
fn hold(room: &str) {
    hold_all(|name| name.starts_with(room));
}

fn hold_all(is_in: impl Fn(&str) -> bool) {
    let cases = CASES.iter().filter(|case| is_in(&case.name));
    let failures: Vec<String> = cases.flat_map(failures).collect();
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

/// Materials take half of the time; a test of their own runs in parallel.
const MATERIALS: &str = "shading/material";

#[test]
fn shading_of_materials() {
    hold(MATERIALS);
}

#[test]
fn other_shading() {
    hold_all(|name| name.starts_with(ROOMS[5]) && !name.starts_with(MATERIALS));
}

#[test]
fn fractal_interpolation() {
    hold(ROOMS[6]);
}

/// Coordinates relative to the center of a sphere of 40 cells lack the precision for its finer
/// octaves if products and sums are fused. Differences to an anchor have it, as one of the cases
/// shows.
#[test]
fn absolute_coordinates_fail_where_anchors_hold() {
    for zoom in [100.0, 1e4] {
        let case = cases::sums::anchors::absolute(zoom);
        let shader = case.interpreter().expect("a valid case").arithmetic(Arithmetic::Fused);
        let fused =
            broken(&case, &shader, &given(&case, Case::COUNT / FUSED as u32), |output| output.adapter);
        assert!(fused.is_err_and(|error| error.contains("gradient")), "zoom {zoom}");
    }
}

/// Returns the words of a source, without comments.
fn words(source: &str) -> HashSet<&str> {
    let code = source.lines().map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(|line| line.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))).collect()
}

/// WGSL built-in names that end in a digit.
const OWN: [&str; 8] = ["f32", "u32", "i32", "vec2", "vec3", "vec4", "log2", "exp2"];

/// naga would rename them, and naga_oil rejects them.
#[test]
fn names_do_not_end_in_a_digit() {
    let is_number = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
    let mut wrong = BTreeSet::new();
    for part in CASES.iter().flat_map(|case| ordered(&case.parts)) {
        let names = words(part.source()).into_iter().chain(part.bindings().iter().map(Binding::name));
        let names = names.filter(|name| !is_number(name) && !OWN.contains(name));
        wrong.extend(names.filter(|name| name.ends_with(|c: char| c.is_ascii_digit())));
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Returns the crate's parts of all cases, by the names they define.
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

/// Any parts may be in one module, and importing a part provides everything it refers to.
#[test]
fn names_are_defined_once_and_imported() {
    let parts: Vec<_> = CASES.iter().flat_map(|case| ordered(&case.parts)).collect();
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
fn every_case_has_a_known_prefix() {
    for case in &*CASES {
        assert_eq!(ROOMS.iter().filter(|room| case.name.starts_with(**room)).count(), 1, "{}", case.name);
    }
}
