//! Edge cases of built-in functions. Shaders test the others against the crates.

use asperity_interpreter::Value;

use crate::{bits, interpreter, value};

#[test]
fn builtins_of_one_float() {
    type One = fn(f32) -> f32;
    let builtins: [(&str, One); 4] = [
        ("abs", f32::abs),
        ("floor", f32::floor),
        ("round", f32::round_ties_even),
        ("sign", |x| if x == 0.0 { 0.0 } else { x.signum() }),
    ];
    for (name, of_rust) in builtins {
        let shader = interpreter(&format!("fn f(x: f32) -> f32 {{ return {name}(x); }}"));
        for x in [0.0, 0.3, 0.5, -0.5, 1.5, 2.5, -2.5, -3.7, 100.25, -1e-40, 1e30] {
            let got = shader.call("f", &[x.into()]).unwrap().f32();
            assert_eq!(bits(got), bits(of_rust(x)), "{name}({x}): {got}, not {}", of_rust(x));
        }
    }
}

#[test]
fn builtins_of_vectors() {
    let [a, n] = [[0.3_f32, -1.7, 2.9], [0.6, 0.0, 0.8]];
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let from = |f: &dyn Fn(usize) -> f32| Value::from([f(0), f(1), f(2)]);
    let cross = |i: usize, j: usize| a[i] * n[j] - n[i] * a[j];
    for (expression, expected) in [
        ("cross(a, n)", from(&|at| [cross(1, 2), cross(2, 0), cross(0, 1)][at])),
        ("normalize(a)", from(&|at| a[at] / dot(a, a).sqrt())),
        ("reflect(a, n)", from(&|at| a[at] - 2.0 * dot(n, a) * n[at])),
        ("select(a, n, a < n)", from(&|at| if a[at] < n[at] { n[at] } else { a[at] })),
        ("vec3<f32>(vec3<i32>(dot(vec3<i32>(a), vec3<i32>(2, 3, 5))))", from(&|_| 7.0)),
    ] {
        let wgsl = format!("fn f(a: vec3<f32>, n: vec3<f32>) -> vec3<f32> {{ return {expression}; }}");
        assert_eq!(value(&wgsl, "f", &[a, n].map(Value::from)).f32s(), expected.f32s(), "{expression}");
    }
}
