//! Operations on scalars, each an operation of Rust.

/// An operation on one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unary {
    Copy,
    // Of floats.
    Negate,
    Abs,
    Floor,
    Round,
    Sign,
    Sqrt,
    Exp,
    Exp2,
    Log,
    Log2,
    Sin,
    Cos,
    Tan,
    Flush,
    // Of integers.
    NegateInteger,
    AbsInteger,
    SignInteger,
    Not,
    LogicalNot,
    // Conversions.
    FloatFromSigned,
    FloatFromUnsigned,
    SignedFromFloat,
    UnsignedFromFloat,
    BoolFromFloat,
    BoolFromInteger,
}

/// An operation on two words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binary {
    // Of floats.
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Min,
    Max,
    Atan2,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    // Of integers.
    AddInteger,
    SubtractInteger,
    MultiplyInteger,
    DivideSigned,
    DivideUnsigned,
    RemainderSigned,
    RemainderUnsigned,
    MinSigned,
    MinUnsigned,
    MaxSigned,
    MaxUnsigned,
    EqualInteger,
    NotEqualInteger,
    LessSigned,
    LessUnsigned,
    LessEqualSigned,
    LessEqualUnsigned,
    And,
    Or,
    Xor,
    ShiftLeft,
    ShiftRightSigned,
    ShiftRightUnsigned,
}

/// An operation on three words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ternary {
    /// `a b + c`, rounded once.
    MultiplyAdd,
    /// `a b − c`, rounded once.
    MultiplySubtract,
    /// `c − a b`, rounded once.
    NegatedMultiplyAdd,
    /// `b` where `a` is true, else `c`.
    Select,
}

impl Unary {
    /// It rounds a float.
    pub(super) const fn is_float(self) -> bool {
        use Unary::*;
        matches!(self, Negate | Abs | Floor | Round | Sign | Sqrt | Exp | Exp2 | Log | Log2 | Sin | Cos | Tan)
    }
}

impl Ternary {
    /// It rounds a float.
    pub(super) const fn is_float(self) -> bool {
        matches!(self, Self::MultiplyAdd | Self::MultiplySubtract | Self::NegatedMultiplyAdd)
    }
}

impl Binary {
    /// Its operands are floats.
    pub(super) const fn is_float(self) -> bool {
        use Binary::*;
        self.is_comparison()
            || matches!(self, Add | Subtract | Multiply | Divide | Remainder | Min | Max | Atan2)
    }

    /// Its operands are floats and its result is none.
    pub(super) const fn is_comparison(self) -> bool {
        matches!(self, Self::Equal | Self::NotEqual | Self::Less | Self::LessEqual)
    }
}

/// A function of floats as one of words.
fn float1(f: impl Fn(f32) -> f32) -> impl Fn(u32) -> u32 {
    move |a| f(f32::from_bits(a)).to_bits()
}

/// A function of two floats as one of words.
fn float2(f: impl Fn(f32, f32) -> f32) -> impl Fn(u32, u32) -> u32 {
    move |a, b| f(f32::from_bits(a), f32::from_bits(b)).to_bits()
}

/// A comparison of two floats as a function of words.
fn compare(f: impl Fn(f32, f32) -> bool) -> impl Fn(u32, u32) -> u32 {
    move |a, b| f(f32::from_bits(a), f32::from_bits(b)).into()
}

/// A function of two signed numbers as one of words.
fn signed2(f: impl Fn(i32, i32) -> i32) -> impl Fn(u32, u32) -> u32 {
    move |a, b| f(a.cast_signed(), b.cast_signed()).cast_unsigned()
}

/// A function of three floats as one of words.
fn float3(f: impl Fn(f32, f32, f32) -> f32) -> impl Fn(u32, u32, u32) -> u32 {
    move |a, b, c| f(f32::from_bits(a), f32::from_bits(b), f32::from_bits(c)).to_bits()
}

// Loops over all lanes of one operator, so that nothing is decided within them. With `array::from_fn` or iterators the compiler does not
// see that lanes are of a constant number, or that they do not overlap.

#[inline(always)]
fn map1<const N: usize>([a]: [&[u32; N]; 1], to: &mut [u32; N], f: impl Fn(u32) -> u32) {
    for lane in 0..N {
        to[lane] = f(a[lane]);
    }
}

#[inline(always)]
fn map2<const N: usize>([a, b]: [&[u32; N]; 2], to: &mut [u32; N], f: impl Fn(u32, u32) -> u32) {
    for lane in 0..N {
        to[lane] = f(a[lane], b[lane]);
    }
}

#[inline(always)]
fn map3<const N: usize>([a, b, c]: [&[u32; N]; 3], to: &mut [u32; N], f: impl Fn(u32, u32, u32) -> u32) {
    for lane in 0..N {
        to[lane] = f(a[lane], b[lane], c[lane]);
    }
}

/// Denormals as zero of the same sign.
fn flushed(a: u32) -> u32 {
    if f32::from_bits(a).is_subnormal() { a & 0x8000_0000 } else { a }
}

/// A float by so many units in the last place farther from zero; zero, infinities and NaN stay.
pub(super) fn nudged(a: u32, ulps: i32) -> u32 {
    let x = f32::from_bits(a);
    if x == 0.0 || !x.is_finite() { a } else { a.wrapping_add_signed(ulps) }
}

fn sign(x: f32) -> f32 {
    if x > 0.0 {
        1.0
    } else if x < 0.0 {
        -1.0
    } else {
        0.0
    }
}

impl Unary {
    /// The operation on all lanes, into `to`.
    #[inline]
    pub(super) fn lanes<const N: usize>(self, a: [&[u32; N]; 1], to: &mut [u32; N]) {
        match self {
            Self::Copy => *to = *a[0],
            Self::Negate => map1(a, to, float1(|x| -x)),
            Self::Abs => map1(a, to, float1(f32::abs)),
            Self::Floor => map1(a, to, float1(f32::floor)),
            Self::Round => map1(a, to, float1(f32::round_ties_even)),
            Self::Sign => map1(a, to, float1(sign)),
            Self::Sqrt => map1(a, to, float1(f32::sqrt)),
            Self::Exp => map1(a, to, float1(f32::exp)),
            Self::Exp2 => map1(a, to, float1(f32::exp2)),
            Self::Log => map1(a, to, float1(f32::ln)),
            Self::Log2 => map1(a, to, float1(f32::log2)),
            Self::Sin => map1(a, to, float1(f32::sin)),
            Self::Cos => map1(a, to, float1(f32::cos)),
            Self::Tan => map1(a, to, float1(f32::tan)),
            Self::Flush => map1(a, to, flushed),
            Self::NegateInteger => map1(a, to, u32::wrapping_neg),
            Self::AbsInteger => map1(a, to, |x| x.cast_signed().wrapping_abs().cast_unsigned()),
            Self::SignInteger => map1(a, to, |x| x.cast_signed().signum().cast_unsigned()),
            Self::Not => map1(a, to, |x| !x),
            Self::LogicalNot => map1(a, to, |x| x ^ 1),
            Self::FloatFromSigned => map1(a, to, |x| (x.cast_signed() as f32).to_bits()),
            Self::FloatFromUnsigned => map1(a, to, |x| (x as f32).to_bits()),
            Self::SignedFromFloat => map1(a, to, |x| (f32::from_bits(x) as i32).cast_unsigned()),
            Self::UnsignedFromFloat => map1(a, to, |x| f32::from_bits(x) as u32),
            Self::BoolFromFloat => map1(a, to, |x| (f32::from_bits(x) != 0.0).into()),
            Self::BoolFromInteger => map1(a, to, |x| (x != 0).into()),
        }
    }
}

impl Binary {
    /// The operation on all lanes, into `to`.
    #[inline]
    pub(super) fn lanes<const N: usize>(self, ab: [&[u32; N]; 2], to: &mut [u32; N]) {
        match self {
            Self::Add => map2(ab, to, float2(|a, b| a + b)),
            Self::Subtract => map2(ab, to, float2(|a, b| a - b)),
            Self::Multiply => map2(ab, to, float2(|a, b| a * b)),
            Self::Divide => map2(ab, to, float2(|a, b| a / b)),
            Self::Remainder => map2(ab, to, float2(|a, b| a % b)),
            Self::Min => map2(ab, to, float2(f32::min)),
            Self::Max => map2(ab, to, float2(f32::max)),
            Self::Atan2 => map2(ab, to, float2(f32::atan2)),
            Self::Equal => map2(ab, to, compare(|a, b| a == b)),
            Self::NotEqual => map2(ab, to, compare(|a, b| a != b)),
            Self::Less => map2(ab, to, compare(|a, b| a < b)),
            Self::LessEqual => map2(ab, to, compare(|a, b| a <= b)),
            Self::AddInteger => map2(ab, to, u32::wrapping_add),
            Self::SubtractInteger => map2(ab, to, u32::wrapping_sub),
            Self::MultiplyInteger => map2(ab, to, u32::wrapping_mul),
            // As WGSL has it: `x / 0 = x` and `x % 0 = 0`.
            Self::DivideSigned => map2(ab, to, signed2(|a, b| if b == 0 { a } else { a.wrapping_div(b) })),
            Self::DivideUnsigned => map2(ab, to, |a, b| a.checked_div(b).unwrap_or(a)),
            Self::RemainderSigned => map2(ab, to, signed2(|a, b| if b == 0 { 0 } else { a.wrapping_rem(b) })),
            Self::RemainderUnsigned => map2(ab, to, |a, b| a.checked_rem(b).unwrap_or(0)),
            Self::MinSigned => map2(ab, to, signed2(i32::min)),
            Self::MinUnsigned => map2(ab, to, u32::min),
            Self::MaxSigned => map2(ab, to, signed2(i32::max)),
            Self::MaxUnsigned => map2(ab, to, u32::max),
            Self::EqualInteger => map2(ab, to, |a, b| (a == b).into()),
            Self::NotEqualInteger => map2(ab, to, |a, b| (a != b).into()),
            Self::LessSigned => map2(ab, to, |a, b| (a.cast_signed() < b.cast_signed()).into()),
            Self::LessUnsigned => map2(ab, to, |a, b| (a < b).into()),
            Self::LessEqualSigned => map2(ab, to, |a, b| (a.cast_signed() <= b.cast_signed()).into()),
            Self::LessEqualUnsigned => map2(ab, to, |a, b| (a <= b).into()),
            Self::And => map2(ab, to, |a, b| a & b),
            Self::Or => map2(ab, to, |a, b| a | b),
            Self::Xor => map2(ab, to, |a, b| a ^ b),
            Self::ShiftLeft => map2(ab, to, u32::wrapping_shl),
            Self::ShiftRightSigned => map2(ab, to, |a, b| a.cast_signed().wrapping_shr(b).cast_unsigned()),
            Self::ShiftRightUnsigned => map2(ab, to, u32::wrapping_shr),
        }
    }
}

impl Ternary {
    /// The operation on all lanes, into `to`.
    #[inline]
    pub(super) fn lanes<const N: usize>(self, abc: [&[u32; N]; 3], to: &mut [u32; N]) {
        match self {
            Self::MultiplyAdd => map3(abc, to, float3(f32::mul_add)),
            Self::MultiplySubtract => map3(abc, to, float3(|a, b, c| a.mul_add(b, -c))),
            Self::NegatedMultiplyAdd => map3(abc, to, float3(|a, b, c| (-a).mul_add(b, c))),
            Self::Select => map3(abc, to, |a, b, c| if a != 0 { b } else { c }),
        }
    }
}
