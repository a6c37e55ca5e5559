//! Errors of the interpreter and their messages.

use asperity_interpreter::Interpreter;

use crate::interpreter;

#[test]
fn naga_errors_show_their_line() {
    for (wgsl, expected) in [
        ("fn f() -> f32 { return ; }", "return ;"),
        ("fn f() -> f32 { return nowhere(); }", "return nowhere();"),
        ("fn f(x: f32) -> u32 { return x; }", "return x;"),
    ] {
        let error = Interpreter::new(wgsl).unwrap_err();
        assert!(error.contains("error:") && error.contains(expected), "{error}");
    }
}

#[test]
fn unknown_names_and_arguments() {
    let wgsl = "
        @group(0) @binding(0) var<uniform> scale: vec2<f32>;
        @group(0) @binding(1) var table: texture_2d<f32>;
        fn f(x: f32, y: vec2<f32>) -> f32 { return x + y.x * scale.x; }";
    let mut shader = interpreter(wgsl);
    let arguments = [1.0.into(), [1.0, 2.0].into()];
    assert_eq!(shader.call("g", &[]).unwrap_err(), "no function `g`");
    assert_eq!(shader.call("f", &arguments).unwrap_err(), "no resource for `scale`, in `f`");
    assert!(shader.call("f", &arguments[1..]).unwrap_err().contains("arguments of [1, 2] words, got [2]"));
    assert!(shader.call_many("f", &[[0, 0]]).unwrap_err().contains("arguments of 3 words, got 2"));
    assert_eq!(shader.uniform("size", &[0, 0]).unwrap_err(), "no global variable `size`");
    assert!(shader.uniform("table", &[0, 0]).is_err());
    assert!(shader.storage("scale", vec![0, 0]).is_err());
    assert!(shader.texture("scale", 1, vec![0, 0]).is_err());
    shader.uniform("scale", &[2.0_f32.to_bits(), 0]).unwrap();
    assert_eq!(shader.call("f", &arguments), Ok(3.0.into()));
}

#[test]
fn only_unsupported_functions_fail() {
    let wgsl = "
        @group(0) @binding(0) var picture: texture_2d<f32>;
        @group(0) @binding(1) var linear: sampler;
        @group(0) @binding(2) var<storage, read_write> sums: array<f32>;
        var<workgroup> shared_sum: f32;
        fn good() -> f32 { return 1.0; }
        fn slope(x: f32) -> f32 { return dpdx(x); }
        fn calls(x: f32) -> f32 { return slope(x); }
        fn sampled(p: vec2<f32>) -> vec4<f32> { return textureSampleLevel(picture, linear, p, 0.0); }
        fn written(x: f32) -> f32 { sums[0] = x; return x; }
        fn common_sum() -> f32 { return shared_sum; }";
    let shader = interpreter(wgsl);
    assert_eq!(shader.call("good", &[]), Ok(1.0.into()));
    let refused = |name: &str, words: &[f32]| {
        let words = words.iter().map(|word| word.to_bits()).collect::<Vec<u32>>();
        shader.call_many(name, &[words]).unwrap_err()
    };
    assert_eq!(refused("slope", &[1.0]), "unsupported expression `Derivative`, in `slope`");
    assert_eq!(refused("calls", &[1.0]), "unsupported expression `Derivative`, in `slope`, in `calls`");
    assert_eq!(refused("sampled", &[0.5, 0.5]), "unsupported expression `ImageSample`, in `sampled`");
    assert!(refused("written", &[1.0]).contains("`sums` is in the unsupported address space"));
    assert!(
        refused("common_sum", &[]).contains("`shared_sum` is in the unsupported address space WorkGroup")
    );
}

#[test]
fn out_of_bounds_indices() {
    let wgsl = "
        fn value(i: i32) -> f32 { let v = array(1.0, 2.0, 3.0); return v[i]; }
        fn variable(i: u32) -> f32 { var v = array(1.0, 2.0, 3.0); return v[i]; }";
    let shader = interpreter(wgsl);
    assert_eq!(
        shader.call("value", &[(-1).into()]).unwrap_err(),
        "index -1 is outside 3 elements, in `value`"
    );
    assert_eq!(
        shader.call("variable", &[3_u32.into()]).unwrap_err(),
        "index 3 is outside 3 elements, in `variable`"
    );
}
