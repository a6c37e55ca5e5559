//! Access to parts of values and of variables.

use asperity_interpreter::Value;

use crate::{interpreter, value};

#[test]
fn components_and_swizzles() {
    let wgsl = "
        fn f(v: vec4<f32>) -> vec4<f32> { return vec4<f32>(v.wx, v.z, v.y).xzyw; }
        fn at(v: vec4<f32>, i: i32) -> f32 { return v[i]; }
        fn splat(x: f32) -> vec3<f32> { return vec3<f32>(x); }";
    let v = Value::from([1.0, 2.0, 3.0, 4.0]);
    assert_eq!(value(wgsl, "f", std::slice::from_ref(&v)).f32s(), [4.0, 3.0, 1.0, 2.0]);
    assert_eq!(value(wgsl, "at", &[v, 2.into()]), 3.0.into());
    assert_eq!(value(wgsl, "splat", &[5.0.into()]).f32s(), [5.0; 3]);
}

#[test]
fn variables_are_written_in_parts() {
    let wgsl = "
        struct Inner { weight: f32, rows: array<vec3<f32>, 2> }
        struct Outer { count: u32, inner: array<Inner, 2>, turn: mat2x2<f32> }
        fn f(i: u32, j: u32) -> Outer {
            var outer: Outer;
            outer.count = 7u;
            outer.inner[1].weight = 0.5;
            outer.inner[i].rows[j] = vec3<f32>(1.0, 2.0, 3.0);
            outer.inner[i].rows[j].y += 10.0;
            outer.inner[0].rows[1][i + j] = 9.0;
            outer.turn[1] = vec2<f32>(5.0, 6.0);
            outer.turn[j].x = 4.0;
            outer.inner[1].rows[0] = outer.inner[i].rows[j].zyx;
            return outer;
        }";
    let float = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect::<Vec<u32>>();
    let expected =
        |inner: [f32; 14], turn: [f32; 4]| Value::from([vec![7], float(&inner), float(&turn)].concat());
    assert_eq!(
        value(wgsl, "f", &[0_u32.into(), 0_u32.into()]),
        expected(
            [0.0, 1.0, 12.0, 3.0, 9.0, 0.0, 0.0, 0.5, 3.0, 12.0, 1.0, 0.0, 0.0, 0.0],
            [4.0, 0.0, 5.0, 6.0]
        )
    );
    assert_eq!(
        value(wgsl, "f", &[1_u32.into(), 1_u32.into()]),
        expected(
            [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 9.0, 0.5, 3.0, 12.0, 1.0, 1.0, 12.0, 3.0],
            [0.0, 0.0, 4.0, 6.0]
        )
    );
}

#[test]
fn arrays_of_constants_and_of_values() {
    let wgsl = "
        const TABLE: array<vec2<i32>, 3> = array(vec2(1, 2), vec2(3, 4), vec2(5, 6));
        const SIZE = 3u;
        fn constant(i: u32) -> vec2<i32> { return TABLE[(i + 1u) % SIZE]; }
        fn fixed() -> i32 { return TABLE[2].y; }
        fn local(a: f32, i: u32) -> f32 { let values = array(a, a * 2.0, a * 3.0); return values[i]; }
        fn copied(a: f32) -> f32 { var v = array<f32, 2>(a, a); var w = v; w[0] = 9.0; return v[0] + w[0]; }";
    assert_eq!(value(wgsl, "constant", &[1_u32.into()]), [5, 6].into());
    assert_eq!(value(wgsl, "constant", &[2_u32.into()]), [1, 2].into());
    assert_eq!(value(wgsl, "fixed", &[]), 6.into());
    assert_eq!(value(wgsl, "local", &[1.5.into(), 2_u32.into()]), 4.5.into());
    assert_eq!(value(wgsl, "copied", &[1.0.into()]), 10.0.into());
}

#[test]
fn pointers_as_arguments() {
    let wgsl = "
        fn add(to: ptr<function, f32>, x: f32) { *to += x; }
        fn put(to: ptr<function, vec3<f32>>, at: u32) { (*to)[at] = 8.0; }
        fn f(i: u32) -> array<f32, 7> {
            var sums = array<f32, 4>(1.0, 2.0, 3.0, 4.0);
            add(&sums[i], 10.0);
            let last = &sums[3];
            add(last, 100.0);
            var v = vec3<f32>(1.0, 2.0, 3.0);
            put(&v, i);
            return array<f32, 7>(sums[0], sums[1], sums[2], sums[3], v.x, v.y, v.z);
        }";
    let shader = interpreter(wgsl);
    let got = shader.call("f", &[1_u32.into()]).unwrap();
    assert_eq!(got.f32s(), [1.0, 12.0, 3.0, 104.0, 1.0, 8.0, 3.0]);
}

#[test]
fn private_variables_are_reset_per_call() {
    let wgsl = "
        var<private> count: u32 = 3u;
        fn step() { count += 1u; }
        fn f() -> u32 { step(); step(); return count; }";
    let shader = interpreter(wgsl);
    let inputs: [[u32; 0]; 40] = [[]; 40];
    assert!(shader.call_many("f", &inputs).unwrap().iter().all(|count| count.u32() == 5));
}
