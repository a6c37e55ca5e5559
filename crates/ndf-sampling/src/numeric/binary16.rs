//! IEEE 754 binary16, the half floats of textures: conversion to and from `f32`.

/// The largest finite half float.
#[cfg(any(feature = "alloc", test))]
pub(crate) const MAX_HALF: f32 = 65504.0;

/// The bits of the half float nearest to `x`, ties to even.
///
/// Magnitudes from 65520 on become infinite, magnitudes below 2⁻²⁵ zero, with their signs. NaN
/// becomes a quiet NaN. Between 2⁻¹⁴ and 65504 the relative error is at most 2⁻¹¹. Below,
/// the absolute error is at most 2⁻²⁵.
///
/// IEEE 754-2019, sections 3.4, 4.3.1 and 5.4.2.
#[cfg(any(feature = "alloc", test))]
#[inline]
#[must_use]
pub(crate) const fn to_half(x: f32) -> u16 {
    let bits = x.to_bits();
    let sign = ((bits >> 16) & 0x8000) as u16;
    let magnitude = bits & 0x7FFF_FFFF;
    if magnitude > 0x7F80_0000 {
        return sign | 0x7E00;
    }
    // 65520, halfway between the largest half float and the next value of the same spacing.
    if magnitude >= 0x477F_F000 {
        return sign | 0x7C00;
    }
    // 2⁻¹⁴, the smallest normal half float: the exponent bias changes from 127 to 15.
    if magnitude >= 0x3880_0000 {
        return sign | nearest_even(magnitude - 0x3800_0000, 13) as u16;
    }
    // 2⁻²⁵, half of the smallest subnormal.
    if magnitude < 0x3300_0000 {
        return sign;
    }
    let significand = (magnitude & 0x007F_FFFF) | 0x0080_0000;
    sign | nearest_even(significand, 126 - (magnitude >> 23)) as u16
}

/// The value of the half float with these bits, exactly; NaN remains NaN.
#[inline]
#[must_use]
pub(crate) const fn from_half(half: u16) -> f32 {
    const TWO_TO_112: f32 = f32::from_bits((127 + 112) << 23);
    let sign = ((half & 0x8000) as u32) << 16;
    let magnitude = ((half & 0x7FFF) as u32) << 13;
    if magnitude >= 0x0F80_0000 {
        return f32::from_bits(sign | magnitude | 0x7F80_0000);
    }
    // A multiplication changes the exponent bias, and also makes subnormal half floats normal.
    f32::from_bits(sign | (f32::from_bits(magnitude) * TWO_TO_112).to_bits())
}

/// `value/2^places` rounded to the nearest integer, ties to even.
///
/// A carry into the exponent is correct as it is.
#[cfg(any(feature = "alloc", test))]
const fn nearest_even(value: u32, places: u32) -> u32 {
    let (kept, rest, tie) = (value >> places, value & ((1 << places) - 1), 1 << (places - 1));
    if rest > tie || (rest == tie && kept & 1 == 1) { kept + 1 } else { kept }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_half_round_trips() {
        for half in 0..=u16::MAX {
            let value = from_half(half);
            if value.is_nan() {
                assert!(from_half(to_half(value)).is_nan() && half & 0x7C00 == 0x7C00 && half & 0x3FF != 0);
            } else {
                assert_eq!(to_half(value), half, "{value}");
            }
        }
    }

    #[test]
    fn midpoints_round_to_even_and_neighbors_to_nearest() {
        for half in 0..0x7BFF_u16 {
            let (low, high) = (from_half(half), from_half(half + 1));
            // Exact, because two neighbors have at most twelve bits between them.
            let middle = 0.5 * (low + high);
            let even = half + (half & 1);
            assert_eq!((to_half(middle), to_half(-middle)), (even, even | 0x8000), "{middle}");
            assert_eq!(to_half(middle.next_down()), half, "{middle}");
            assert_eq!(to_half(middle.next_up()), half + 1, "{middle}");
        }
    }

    #[test]
    fn ends_of_the_range() {
        assert_eq!((to_half(65519.996), to_half(65520.0)), (0x7BFF, 0x7C00));
        assert_eq!((to_half(f32::INFINITY), to_half(f32::NEG_INFINITY)), (0x7C00, 0xFC00));
        assert_eq!((to_half(f32::MAX), to_half(-f32::MAX)), (0x7C00, 0xFC00));
        assert_eq!((to_half(2.0_f32.powi(-25)), to_half(2.0_f32.powi(-25).next_up())), (0, 1));
        assert_eq!((to_half(-0.0), to_half(1e-45), to_half(f32::NAN)), (0x8000, 0, 0x7E00));
        assert_eq!(from_half(0x7BFF), MAX_HALF);
        assert_eq!(from_half(0x7C00), f32::INFINITY);
    }
}
