//! Implementations with other rounding.

use asperity_interpreter::{Arithmetic, Value};

use crate::{bits, interpreter};

/// Returns the value of a function of three floats with fused sums.
fn fused(expression: &str, [a, b, c]: [f32; 3]) -> f32 {
    let wgsl = format!("fn f(a: f32, b: f32, c: f32) -> f32 {{ {expression} }}");
    let shader = interpreter(&wgsl).arithmetic(Arithmetic::Fused);
    shader.call("f", &[a, b, c].map(Value::from)).map_or(f32::NAN, |value| value.f32())
}

#[test]
fn products_used_once_are_fused() {
    // Products that lose bits, so that rounding is visible.
    let [a, b, c] = [1.0 + f32::EPSILON, 1.0 + 3.0 * f32::EPSILON, -1.0];
    let written = a * b + c;
    let once = a.mul_add(b, c);
    assert_ne!(written, once);
    for (expression, expected) in [
        ("return a * b + c;", once),
        ("return c + a * b;", once),
        ("let p = a * b; return p + c;", once),
        ("return a * b - (-c);", once),
        ("return -c - a * b;", -once),
        ("return a * b + c * a;", a.mul_add(b, c * a)),
        ("return dot(vec2(a, c), vec2(b, a));", a.mul_add(b, c * a)),
        // The product has another use, or is not an operand of a sum.
        ("let p = a * b; return p + c * p;", c.mul_add(a * b, a * b)),
        ("let p = a * b; return min(p, 9.0) + c;", written),
        ("let p = a * b; return (p + c) / p;", written / (a * b)),
        ("return (a + b) * c;", (a + b) * c),
    ] {
        assert_eq!(bits(fused(expression, [a, b, c])), bits(expected), "{expression}");
    }
}

#[test]
fn written_arithmetic_is_the_default() {
    let wgsl = "fn f(a: f32, b: f32, c: f32) -> f32 { return a * b + c; }";
    let numbers = [1.0 + f32::EPSILON, 1.0 + 3.0 * f32::EPSILON, -1.0];
    let [a, b, c] = numbers;
    let arguments = numbers.map(Value::from);
    let shader = interpreter(wgsl);
    assert_eq!(shader.call("f", &arguments), Ok((a * b + c).into()));
    let shader = shader.arithmetic(Arithmetic::Fused).arithmetic(Arithmetic::Written);
    assert_eq!(shader.call("f", &arguments), Ok((a * b + c).into()));
}

#[test]
fn quotients_and_roots_are_off_by_configured_units() {
    let wgsl = "
        fn divided(a: f32, b: f32) -> f32 { return a / b; }
        fn root(a: f32, b: f32) -> f32 { return sqrt(a) + b; }
        fn product(a: f32, b: f32) -> f32 { return a * b; }";
    let up = interpreter(wgsl).division_ulps(2);
    let down = interpreter(wgsl).division_ulps(-2);
    let call = |name, a: f32, b: f32| {
        [&up, &down].map(|shader| shader.call(name, &[a.into(), b.into()]).unwrap().f32())
    };
    let quotient = (-7.0_f32 / 3.0).to_bits();
    assert_eq!(call("divided", -7.0, 3.0).map(f32::to_bits), [quotient + 2, quotient - 2]);
    let root = 2.0_f32.sqrt().to_bits();
    assert_eq!(call("root", 2.0, 0.0).map(f32::to_bits), [root + 2, root - 2]);
    assert_eq!(call("product", 2.5, 3.0), [7.5; 2]);
    assert_eq!(call("divided", 0.0, 3.0), [0.0; 2]);
    assert_eq!(call("divided", 1.0, 0.0), [f32::INFINITY; 2]);
}

#[test]
fn denormals_are_flushed_as_operands_and_results() {
    let wgsl = "
        fn product(a: f32, b: f32) -> f32 { return a * b; }
        fn is_zero(a: f32, b: f32) -> bool { return a == 0.0 * b; }
        fn word(a: u32, b: u32) -> u32 { return a + b; }";
    let flushed = interpreter(wgsl).flush_denormals(true);
    let kept = interpreter(wgsl);
    let call = |name: &str, a: f32, b: f32| {
        [&flushed, &kept].map(|shader| shader.call(name, &[a.into(), b.into()]).unwrap())
    };
    let small = f32::MIN_POSITIVE;
    assert_eq!(call("product", -small, 0.5), [(-0.0).into(), (-small * 0.5).into()]);
    assert_eq!(call("product", small * 0.5, 4.0), [0.0.into(), (small * 2.0).into()]);
    assert_eq!(call("is_zero", small * 0.5, 1.0), [true.into(), false.into()]);
    // Integers are not denormals.
    assert_eq!(call("word", f32::from_bits(3), f32::from_bits(4)), [7_u32.into(), 7_u32.into()]);
}
