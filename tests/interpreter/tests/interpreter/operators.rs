//! Operators for which WGSL differs from other languages: integer division by zero, shifts,
//! conversions.

use crate::{interpreter, value};

const FLOATS: [f32; 12] =
    [0.0, -0.0, 1.0, -1.5, 0.1, 1e-40, 16_777_217.0, 3e38, -3e38, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
const SIGNED: [i32; 8] = [0, 1, -1, 7, -13, 33, i32::MAX, i32::MIN];

/// A Rust operator.
type Operator<T, R> = fn(T, T) -> R;

/// Calls `a operator b` for all pairs.
fn at_all_pairs<const N: usize>(
    of: &str,
    operator: &str,
    result: &str,
    operands: [u32; N],
) -> impl Iterator<Item = (u32, u32, u32)> {
    let wgsl = format!("fn f(a: {of}, b: {of}) -> {result} {{ return a {operator} b; }}");
    let pairs: Vec<[u32; 2]> = operands.iter().flat_map(|a| operands.map(|b| [*a, b])).collect();
    let values = interpreter(&wgsl).call_many("f", &pairs).expect("two words each");
    pairs.into_iter().zip(values).map(|([a, b], value)| (a, b, value.u32()))
}

#[test]
fn integers_wrap_and_divide_by_zero() {
    let unsigned: [(&str, Operator<u32, u32>); 8] = [
        ("+", u32::wrapping_add),
        ("-", u32::wrapping_sub),
        ("*", u32::wrapping_mul),
        ("/", |a, b| a.checked_div(b).unwrap_or(a)),
        ("%", |a, b| a.checked_rem(b).unwrap_or(0)),
        ("&", |a, b| a & b),
        ("|", |a, b| a | b),
        ("^", |a, b| a ^ b),
    ];
    for (operator, of_rust) in unsigned {
        for (a, b, got) in at_all_pairs("u32", operator, "u32", SIGNED.map(i32::cast_unsigned)) {
            assert_eq!(got, of_rust(a, b), "{a} {operator} {b}");
        }
    }
    let signed: [(&str, Operator<i32, i32>); 8] = [
        ("+", i32::wrapping_add),
        ("-", i32::wrapping_sub),
        ("*", i32::wrapping_mul),
        ("/", |a, b| if b == 0 { a } else { a.wrapping_div(b) }),
        ("%", |a, b| if b == 0 { 0 } else { a.wrapping_rem(b) }),
        ("&", |a, b| a & b),
        ("|", |a, b| a | b),
        ("^", |a, b| a ^ b),
    ];
    for (operator, of_rust) in signed {
        for (a, b, got) in at_all_pairs("i32", operator, "i32", SIGNED.map(i32::cast_unsigned)) {
            let (a, b) = (a.cast_signed(), b.cast_signed());
            assert_eq!(got.cast_signed(), of_rust(a, b), "{a} {operator} {b}");
        }
    }
}

#[test]
fn shifts_use_the_last_five_bits() {
    let wgsl = "
        fn left(a: u32, b: u32) -> u32 { return a << b; }
        fn right(a: u32, b: u32) -> u32 { return a >> b; }
        fn signed(a: i32, b: u32) -> i32 { return a >> b; }";
    let shader = interpreter(wgsl);
    for a in SIGNED {
        for b in [0, 1, 13, 31, 32, 40] {
            let call = |name: &str| shader.call(name, &[a.into(), b.into()]).unwrap();
            let word = a.cast_unsigned();
            assert_eq!(call("left").u32(), word << (b % 32), "{a} << {b}");
            assert_eq!(call("right").u32(), word >> (b % 32), "{word} >> {b}");
            assert_eq!(call("signed").i32(), a >> (b % 32), "{a} >> {b}");
        }
    }
}

#[test]
fn conversions_saturate() {
    let wgsl = "
        fn signed(a: f32) -> i32 { return i32(a); }
        fn unsigned(a: f32) -> u32 { return u32(a); }
        fn truth(a: f32) -> bool { return bool(a); }
        fn from_signed(a: i32) -> f32 { return f32(a); }
        fn from_unsigned(a: u32) -> f32 { return f32(a); }
        fn from_truth(a: bool) -> f32 { return f32(a); }
        fn truth_of(a: u32) -> bool { return bool(a); }
        fn same_bits(a: f32) -> vec2<u32> { return bitcast<vec2<u32>>(vec2<f32>(a, -a)); }
        fn signs(a: u32) -> i32 { return i32(a); }";
    for a in FLOATS.into_iter().chain([2.9, -2.9, 4e9, 3e9]) {
        assert_eq!(value(wgsl, "signed", &[a.into()]).i32(), a as i32, "{a}");
        assert_eq!(value(wgsl, "unsigned", &[a.into()]).u32(), a as u32, "{a}");
        assert_eq!(value(wgsl, "truth", &[a.into()]), (a != 0.0).into(), "{a}");
        assert_eq!(value(wgsl, "same_bits", &[a.into()]).words(), [a.to_bits(), (-a).to_bits()], "{a}");
    }
    for a in SIGNED.into_iter().chain([16_777_219]) {
        assert_eq!(value(wgsl, "from_signed", &[a.into()]).f32(), a as f32, "{a}");
        assert_eq!(value(wgsl, "from_unsigned", &[a.into()]).f32(), a.cast_unsigned() as f32, "{a}");
        assert_eq!(value(wgsl, "truth_of", &[a.into()]), (a != 0).into(), "{a}");
        assert_eq!(value(wgsl, "signs", &[a.into()]).i32(), a, "{a}");
    }
    assert_eq!(value(wgsl, "from_truth", &[true.into()]), 1.0.into());
}
