//! A function, its derivative and its integral, together.

use core::array;
use core::ops::{Add, Mul};

/// A function, its derivative and its integral at a point; or their error bounds, or output slices.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jet<T = f64> {
    /// `f(x)`.
    pub value: T,
    /// `f′(x)`.
    pub slope: T,
    /// `∫ f` from `x_0` to `x`.
    pub integral: T,
}

impl<T> Jet<T> {
    /// Maps all three by one function.
    #[must_use]
    pub fn map<U>(self, to: impl Fn(T) -> U) -> Jet<U> {
        Jet { value: to(self.value), slope: to(self.slope), integral: to(self.integral) }
    }

    pub(crate) fn zip<U>(self, other: Jet<U>) -> Jet<(T, U)> {
        Jet {
            value: (self.value, other.value),
            slope: (self.slope, other.slope),
            integral: (self.integral, other.integral),
        }
    }
}

/// A number, or SIMD lanes of numbers.
pub(crate) trait Lanes: Copy + Add<Output = Self> + Mul<Output = Self> {}

impl<V: Copy + Add<Output = V> + Mul<Output = V>> Lanes for V {}

/// Constants of a table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scales<V, const C: usize> {
    pub(crate) radix: V,
    pub(crate) per_radix: V,
    /// `1/(k + 1)`, the factor of a coefficient by integration.
    pub(crate) parts: [V; C],
}

impl<const C: usize> Scales<f64, C> {
    pub(crate) fn new(radix: f64) -> Self {
        Self { radix, per_radix: 1.0 / radix, parts: array::from_fn(|k| 1.0 / (k + 1) as f64) }
    }
}

/// Slope and integral are in units of the domain.
#[derive(Clone, Copy)]
pub(crate) struct Sums<V> {
    jet: Jet<V>,
    /// The products of scalings so far, times powers of the radix for slope and integral.
    weight: V,
    steep: V,
    flat: V,
}

impl<V: Lanes> Sums<V> {
    #[inline(always)]
    pub(crate) fn new(jet: Jet<V>, one: V) -> Self {
        Self { jet, weight: one, steep: one, flat: one }
    }

    /// The next term of all three; `z` is the remainder minus 1/2.
    #[inline(always)]
    pub(crate) fn all<const C: usize>(&mut self, c: &[V; C], a: V, middle: V, z: V, by: &Scales<V, C>) {
        if let Some((&last, lower)) = c.split_last() {
            let mut p = last * by.parts[C - 1];
            // No closures, because a separate function would not use the registers of the lanes.
            for (&c, &part) in lower.iter().zip(&by.parts).rev() {
                p = p * z + c * part;
            }
            self.jet.integral = self.jet.integral + self.flat * (middle + p * z * by.per_radix);
        }
        self.flat = self.flat * (a * by.per_radix);
        self.value_and_slope(c, a, z, by);
    }

    /// The last term of the integral, linear in the remainder.
    #[inline(always)]
    pub(crate) fn end_integral<const C: usize>(&mut self, c: &[V; C], middle: V, z: V, by: &Scales<V, C>) {
        if let Some(&first) = c.first() {
            self.jet.integral = self.jet.integral + self.flat * (middle + first * z * by.per_radix);
        }
    }

    #[inline(always)]
    pub(crate) fn value_and_slope<const C: usize>(&mut self, c: &[V; C], a: V, z: V, by: &Scales<V, C>) {
        self.steep = self.steep * by.radix;
        if let Some((p, slope)) = tangent(c, z) {
            self.jet.value = self.jet.value + self.weight * p;
            if let Some(slope) = slope {
                self.jet.slope = self.jet.slope + self.steep * slope;
            }
        }
        self.weight = self.weight * a;
        self.steep = self.steep * a;
    }

    #[inline(always)]
    pub(crate) fn slope<const C: usize>(&mut self, c: &[V; C], a: V, z: V, by: &Scales<V, C>) {
        self.steep = self.steep * by.radix;
        if let Some((_, Some(slope))) = tangent(c, z) {
            self.jet.slope = self.jet.slope + self.steep * slope;
        }
        self.steep = self.steep * a;
    }

    #[inline(always)]
    pub(crate) fn end_value(&mut self, tail: V) {
        self.jet.value = self.jet.value + self.weight * tail;
    }

    #[inline(always)]
    pub(crate) fn end_slope(&mut self, tail: V) {
        self.jet.slope = self.jet.slope + self.steep * tail;
    }

    #[inline(always)]
    pub(crate) fn jet(&self, width: V, per_width: V) -> Jet<V> {
        Jet { value: self.jet.value, slope: self.jet.slope * per_width, integral: self.jet.integral * width }
    }
}

/// A polynomial and its derivative, if it has more than one coefficient.
#[inline(always)]
fn tangent<V: Lanes, const C: usize>(c: &[V; C], z: V) -> Option<(V, Option<V>)> {
    let (&last, lower) = c.split_last()?;
    let (mut p, mut slope) = (last, None);
    for &c in lower.iter().rev() {
        slope = match slope {
            None => Some(p),
            Some(slope) => Some(slope * z + p),
        };
        p = p * z + c;
    }
    Some((p, slope))
}
