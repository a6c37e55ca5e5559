//! Builtin functions against those of Rust, or against their formulas.

use asperity_wgsl::Value;

use crate::{bits, interpreter, value};

/// Functions of Rust.
type One<T> = fn(T) -> T;
type Two = fn(f32, f32) -> f32;
type Three = fn(f32, f32, f32) -> f32;

#[test]
fn of_one_float() {
    let builtins: [(&str, One<f32>); 27] = [
        ("abs", f32::abs),
        ("acos", f32::acos),
        ("acosh", f32::acosh),
        ("asin", f32::asin),
        ("asinh", f32::asinh),
        ("atan", f32::atan),
        ("atanh", f32::atanh),
        ("ceil", f32::ceil),
        ("cos", f32::cos),
        ("cosh", f32::cosh),
        ("degrees", f32::to_degrees),
        ("exp", f32::exp),
        ("exp2", f32::exp2),
        ("floor", f32::floor),
        ("fract", |x| x - x.floor()),
        ("inverseSqrt", |x| 1.0 / x.sqrt()),
        ("log", f32::ln),
        ("log2", f32::log2),
        ("radians", f32::to_radians),
        ("round", f32::round_ties_even),
        ("sign", |x| if x == 0.0 { 0.0 } else { x.signum() }),
        ("sin", f32::sin),
        ("sinh", f32::sinh),
        ("sqrt", f32::sqrt),
        ("tan", f32::tan),
        ("tanh", f32::tanh),
        ("trunc", f32::trunc),
    ];
    for (name, of_rust) in builtins {
        let shader = interpreter(&format!("fn f(x: f32) -> f32 {{ return {name}(x); }}"));
        for x in [0.0, -0.0, 0.3, 0.5, -0.5, 1.5, 2.5, -2.5, -3.7, 100.25, -1e-40, 1e30] {
            let got = shader.call("f", &[x.into()]).unwrap().f32();
            assert_eq!(bits(got), bits(of_rust(x)), "{name}({x}): {got}, not {}", of_rust(x));
        }
    }
}

#[test]
fn of_two_and_three_floats() {
    let of_two: [(&str, Two); 5] = [
        ("atan2", f32::atan2),
        ("max", f32::max),
        ("min", f32::min),
        ("pow", f32::powf),
        ("step", |edge, x| if edge <= x { 1.0 } else { 0.0 }),
    ];
    let of_three: [(&str, Three); 4] = [
        ("clamp", |x, low, high| x.max(low).min(high)),
        ("fma", f32::mul_add),
        ("mix", |a, b, t| a * (1.0 - t) + b * t),
        ("smoothstep", |low, high, x| {
            let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
            t * t * (3.0 - 2.0 * t)
        }),
    ];
    let numbers = [0.1_f32, -0.7, 1.3, 2.9];
    for (name, of_rust) in of_two {
        let shader = interpreter(&format!("fn f(x: f32, y: f32) -> f32 {{ return {name}(x, y); }}"));
        for (x, y) in numbers.iter().flat_map(|x| numbers.map(|y| (*x, y))) {
            let got = shader.call("f", &[x.into(), y.into()]).unwrap().f32();
            assert_eq!(bits(got), bits(of_rust(x, y)), "{name}({x}, {y})");
        }
    }
    for (name, of_rust) in of_three {
        let shader =
            interpreter(&format!("fn f(x: f32, y: f32, z: f32) -> f32 {{ return {name}(x, y, z); }}"));
        for (x, y, z) in
            [(0.1, 0.7, 0.3), (0.2, 1.3, 0.7), (0.2, 0.9, 4.0), (0.5, 0.6, -1.0), (7.0, 1.1, 3.3)]
        {
            let got = shader.call("f", &[x, y, z].map(Value::from)).unwrap().f32();
            assert_eq!(bits(got), bits(of_rust(x, y, z)), "{name}({x}, {y}, {z})");
        }
    }
}

#[test]
fn of_an_exponent() {
    let wgsl = "fn f(x: f32, e: i32) -> f32 { return ldexp(x, e); }";
    for (x, exponent, expected) in [
        (1.5_f32, 4, 24.0_f32),
        (-0.75, -1, -0.375),
        (1.0, -149, f32::from_bits(1)),
        (1.5, -149, f32::from_bits(2)),
        (f32::from_bits(1), 276, 2.0_f32.powi(127)),
        (1.0, 128, f32::INFINITY),
        (1.0, 2000, f32::INFINITY),
        (3.0, -2000, 0.0),
    ] {
        assert_eq!(value(wgsl, "f", &[x.into(), exponent.into()]), expected.into(), "{x} · 2^{exponent}");
    }
}

#[test]
fn of_integers() {
    let unsigned: [(&str, One<u32>); 7] = [
        ("abs", |x| x),
        ("countLeadingZeros", u32::leading_zeros),
        ("countOneBits", u32::count_ones),
        ("countTrailingZeros", u32::trailing_zeros),
        ("firstLeadingBit", |x| x.checked_ilog2().unwrap_or(u32::MAX)),
        ("firstTrailingBit", |x| if x == 0 { u32::MAX } else { x.trailing_zeros() }),
        ("reverseBits", u32::reverse_bits),
    ];
    for (name, of_rust) in unsigned {
        let wgsl = format!("fn f(x: u32) -> u32 {{ return {name}(x); }}");
        for x in [0_u32, 1, 2, 40, 0x8000_0000, u32::MAX] {
            assert_eq!(value(&wgsl, "f", &[x.into()]).u32(), of_rust(x), "{name}({x})");
        }
    }
    let signed: [(&str, One<i32>); 3] = [
        ("abs", i32::wrapping_abs),
        ("sign", i32::signum),
        ("firstLeadingBit", |x| {
            let other = if x < 0 { !x } else { x };
            other.checked_ilog2().map_or(-1, |bit| bit as i32)
        }),
    ];
    for (name, of_rust) in signed {
        let wgsl = format!("fn f(x: i32) -> i32 {{ return {name}(x); }}");
        for x in [0, 1, -1, 5, -9, i32::MAX, i32::MIN] {
            assert_eq!(value(&wgsl, "f", &[x.into()]).i32(), of_rust(x), "{name}({x})");
        }
    }
    let wgsl = "
        fn unsigned(x: u32, low: u32, high: u32) -> u32 { return clamp(x, low, high); }
        fn signed(x: i32, low: i32, high: i32) -> i32 { return clamp(x, low, high); }
        fn bits(x: u32, at: u32, count: u32) -> u32 { return extractBits(x, at, count); }
        fn signed_bits(x: i32, at: u32, count: u32) -> i32 { return extractBits(x, at, count); }";
    assert_eq!(value(wgsl, "unsigned", &[u32::MAX, 3, 9].map(Value::from)), 9_u32.into());
    assert_eq!(value(wgsl, "signed", &[-1, 3, 9].map(Value::from)), 3.into());
    for (at, count, expected, expected_signed) in [
        (0, 32, 0xdead_beef, 0xdead_beef),
        (4, 8, 0xee, 0xffff_ffee),
        (28, 8, 0xd, 0xffff_fffd),
        (40, 3, 0, 0),
        (3, 0, 0, 0),
    ] {
        let call = |name| value(wgsl, name, &[0xdead_beef_u32, at, count].map(Value::from)).u32();
        assert_eq!([call("bits"), call("signed_bits")], [expected, expected_signed], "{count} bits at {at}");
    }
}

#[test]
fn of_vectors() {
    let [a, b, n] = [[0.3_f32, -1.7, 2.9], [1.1, 0.7, -0.2], [0.6, 0.0, 0.8]];
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let from = |f: &dyn Fn(usize) -> f32| Value::from([f(0), f(1), f(2)]);
    let cross = |i: usize, j: usize| a[i] * b[j] - b[i] * a[j];
    let twice = 2.0 * dot(n, a);
    let eta = 0.7_f32;
    let bent = dot(n, a);
    let k = 1.0 - eta * eta * (1.0 - bent * bent);
    for (expression, expected) in [
        ("vec3(dot(a, b))", from(&|_| dot(a, b))),
        ("cross(a, b)", from(&|at| [cross(1, 2), cross(2, 0), cross(0, 1)][at])),
        ("vec3(length(a))", from(&|_| dot(a, a).sqrt())),
        ("vec3(distance(a, b))", {
            let apart = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
            from(&|_| dot(apart, apart).sqrt())
        }),
        ("normalize(a)", from(&|at| a[at] / dot(a, a).sqrt())),
        ("reflect(a, n)", from(&|at| a[at] - twice * n[at])),
        ("refract(a, n, 0.7)", from(&|at| eta * a[at] - (eta * bent + k.sqrt()) * n[at])),
        ("refract(b, n, 2.0)", from(&|_| 0.0)),
        ("faceForward(a, b, n)", from(&|at| -a[at])),
        ("faceForward(a, -b, n)", from(&|at| a[at])),
        ("mix(a, b, 0.25)", from(&|at| a[at] * (1.0 - 0.25) + b[at] * 0.25)),
        ("mix(a, b, n)", from(&|at| a[at] * (1.0 - n[at]) + b[at] * n[at])),
        ("saturate(a)", from(&|at| a[at].clamp(0.0, 1.0))),
        ("select(a, b, a < b)", from(&|at| if a[at] < b[at] { b[at] } else { a[at] })),
        ("select(a, b, a.x < b.x)", from(&|at| b[at])),
        ("modf(a).fract", from(&|at| a[at] - a[at].trunc())),
        ("modf(a).whole", from(&|at| a[at].trunc())),
        ("vec3<f32>(vec3<i32>(dot(vec3<i32>(a), vec3<i32>(2, 3, 5))))", from(&|_| 7.0)),
        ("2.0 * a + b / 3.0", from(&|at| 2.0 * a[at] + b[at] / 3.0)),
        ("a * b.y - 1.0", from(&|at| a[at] * b[1] - 1.0)),
    ] {
        let wgsl =
            format!("fn f(a: vec3<f32>, b: vec3<f32>, n: vec3<f32>) -> vec3<f32> {{ return {expression}; }}");
        let got = value(&wgsl, "f", &[a, b, n].map(Value::from));
        assert_eq!(got.f32s(), expected.f32s(), "{expression}");
    }
}

#[test]
fn of_matrices() {
    // Columns (1, 2, 3) and (5, 7, 11).
    let wgsl = "
        fn times(m: mat2x3<f32>, v: vec2<f32>) -> vec3<f32> { return m * v; }
        fn by(v: vec3<f32>, m: mat2x3<f32>) -> vec2<f32> { return v * m; }
        fn product(m: mat2x3<f32>, n: mat3x2<f32>) -> mat3x3<f32> { return m * n; }
        fn scaled(m: mat2x3<f32>) -> mat2x3<f32> { return (m + m) * 0.25; }
        fn turned(m: mat2x3<f32>) -> mat3x2<f32> { return transpose(m); }
        fn column(m: mat2x3<f32>, i: u32) -> vec3<f32> { return m[i]; }
        fn from_columns(a: vec2<f32>, b: vec2<f32>) -> mat2x2<f32> { return mat2x2<f32>(a, b); }
        fn area(m: mat2x2<f32>) -> f32 { return determinant(m); }
        fn volume(m: mat3x3<f32>) -> f32 { return determinant(m); }";
    let m = Value::from([1.0, 2.0, 3.0, 5.0, 7.0, 11.0]);
    let n = Value::from([1.0, -1.0, 2.0, 0.5, 4.0, 3.0]);
    let shader = interpreter(wgsl);
    let call = |name: &str, arguments: &[Value]| shader.call(name, arguments).unwrap().f32s();
    assert_eq!(call("times", &[m.clone(), [10.0, 100.0].into()]), [510.0, 720.0, 1130.0]);
    assert_eq!(call("by", &[[1.0, 10.0, 100.0].into(), m.clone()]), [321.0, 1175.0]);
    let product = [-4.0, -5.0, -8.0, 4.5, 7.5, 11.5, 19.0, 29.0, 45.0];
    assert_eq!(call("product", &[m.clone(), n]), product);
    assert_eq!(call("scaled", std::slice::from_ref(&m)), [0.5, 1.0, 1.5, 2.5, 3.5, 5.5]);
    assert_eq!(call("turned", std::slice::from_ref(&m)), [1.0, 5.0, 2.0, 7.0, 3.0, 11.0]);
    assert_eq!(call("column", &[m, 1_u32.into()]), [5.0, 7.0, 11.0]);
    assert_eq!(call("from_columns", &[[1.0, 2.0].into(), [3.0, 4.0].into()]), [1.0, 2.0, 3.0, 4.0]);
    assert_eq!(call("area", &[[1.0, 2.0, 3.0, 4.0].into()]), [-2.0]);
    assert_eq!(
        call("volume", &[[2.0, 0.0, 1.0, 1.0, 3.0, 2.0, 1.0, 1.0, 1.0].into()]),
        [0.0 + 2.0 * 1.0 + 1.0 * -2.0]
    );
}
