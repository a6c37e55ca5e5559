//! Sums, products, blends and clamps of fields, each with its gradient.

use crate::{
    contract::field::Field,
    point::Point,
    row::points::{Points, Target},
    sample::Sample,
    transforms::pointwise::{self, Combine},
};

/// Implements the methods of a pointwise combination of fields from its [`Combine`].
macro_rules! combined {
    ([$($generic:ident),*] $name:ty, |$self:ident| $first:expr, [$($other:expr),*], $range:expr) => {
        combined!([$($generic),*] $name, Point, |$self| $first, [$($other),*], $range);
    };
    ([$($generic:ident),*] $name:ty, $point:path, |$self:ident| $first:expr, [$($other:expr),*], $range:expr) => {
        impl<V: $point, $($generic: Field<V>),*> Field<V> for $name {
            #[inline]
            fn sample(&$self, p: V) -> Sample<V> {
                let (first, others) = ($first.sample(p), [$($other.sample(p)),*]);
                let values = others.map(|other: Sample<V>| other.value);
                let dx = first.gradient.coordinates();
                let d_others = others.map(|other: Sample<V>| other.gradient.coordinates());
                let gradient = V::from_axes(|axis| {
                    let d_others = d_others.map(|d| d.as_ref()[axis]);
                    $self.slope(first.value, values, dx.as_ref()[axis], d_others)
                });
                Sample { value: Combine::combined($self, first.value, values), gradient }
            }

            #[inline]
            fn value(&$self, p: V) -> f32 {
                Combine::combined($self, $first.value(p), [$($other.value(p)),*])
            }

            fn range(&$self) -> [f32; 2] {
                $range
            }

            fn fill(&$self, points: &Points<'_, V>, target: Target<'_, V>) {
                pointwise::fill($self, &$first, [$(&$other),*], points, target);
            }
        }
    };
}

pub(crate) use combined;

/// The sum of two fields, a + b.
///
/// - **Gradient:** ∇a + ∇b.
/// - **Range:** the sum of the ranges.
///
/// ```
/// use asperity_noise::{Field, Perlin, Simplex, glam::Vec3, ops::Add};
///
/// let (a, b, p) = (Perlin::new(1), Simplex::new(2), Vec3::new(0.3, 1.4, -0.2));
/// assert_eq!(Add(a, b).value(p), a.value(p) + b.value(p));
/// assert_eq!(Add(a, b).sample(p).gradient, a.sample(p).gradient + b.sample(p).gradient);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Add<A, B>(
    /// a.
    pub A,
    /// b.
    pub B,
);

impl<A, B> Combine<1> for Add<A, B> {
    #[inline(always)]
    fn combined(&self, x: f32, [y]: [f32; 1]) -> f32 {
        x + y
    }
    #[inline(always)]
    fn slope(&self, _: f32, _: [f32; 1], dx: f32, [dy]: [f32; 1]) -> f32 {
        dx + dy
    }
}

combined!([A, B] Add<A, B>, |self| self.0, [self.1], {
    let ([a, b], [c, d]) = (self.0.range(), self.1.range());
    [a + c, b + d]
});

/// The product of two fields, a b.
///
/// - **Gradient:** b ∇a + a ∇b.
///
/// ```
/// use asperity_noise::{Field, Perlin, Simplex, glam::Vec2, ops::Multiply};
///
/// let (a, b, p) = (Perlin::new(1), Simplex::new(2), Vec2::new(0.3, 1.4));
/// assert_eq!(Multiply(a, b).value(p), a.value(p) * b.value(p));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Multiply<A, B>(
    /// a.
    pub A,
    /// b.
    pub B,
);

impl<A, B> Combine<1> for Multiply<A, B> {
    #[inline(always)]
    fn combined(&self, x: f32, [y]: [f32; 1]) -> f32 {
        x * y
    }
    #[inline(always)]
    fn slope(&self, x: f32, [y]: [f32; 1], dx: f32, [dy]: [f32; 1]) -> f32 {
        dx * y + x * dy
    }
}

combined!([A, B] Multiply<A, B>, |self| self.0, [self.1], product(self.0.range(), self.1.range()));

/// Bounds of products, with 0 · ∞ = 0 as values are finite.
fn product([a, b]: [f32; 2], [c, d]: [f32; 2]) -> [f32; 2] {
    let products = [a * c, a * d, b * c, b * d].map(|x| if x.is_nan() { 0.0 } else { x });
    [
        products.into_iter().fold(f32::INFINITY, f32::min),
        products.into_iter().fold(f32::NEG_INFINITY, f32::max),
    ]
}

/// The blend of two fields by a third, a + t (b − a): a where t is 0 and b where it is 1.
///
/// - **Gradient:** ∇a + t (∇b − ∇a) + (b − a) ∇t.
/// - **Range:** the union of the ranges of a and b if t stays in [0, 1]. t is not clamped; use
///   [`Clamp`] or [`Unit`](crate::ops::Unit).
///
/// ```
/// use asperity_noise::{Field, Perlin, Simplex, ValueNoise, glam::Vec2, ops::{Blend, Unit}};
///
/// let land = Blend(Perlin::new(1), Simplex::new(2), Unit(ValueNoise::new(3)));
/// assert!(land.value(Vec2::new(0.3, 1.4)).abs() <= 1.0);
/// ```
#[doc(alias("mix", "lerp"))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Blend<A, B, T>(
    /// a.
    pub A,
    /// b.
    pub B,
    /// t.
    pub T,
);

impl<A, B, T> Combine<2> for Blend<A, B, T> {
    #[inline(always)]
    fn combined(&self, a: f32, [b, t]: [f32; 2]) -> f32 {
        let (blend, low, high) = (a + t * (b - a), a.min(b), a.max(b));
        // Rounding may leave the interval between both, and so the range.
        match (0.0..=1.0).contains(&t) {
            true if blend < low => low,
            true if blend > high => high,
            _ => blend,
        }
    }
    #[inline(always)]
    fn slope(&self, a: f32, [b, t]: [f32; 2], da: f32, [db, dt]: [f32; 2]) -> f32 {
        da + t * (db - da) + dt * (b - a)
    }
}

combined!([A, B, T] Blend<A, B, T>, |self| self.0, [self.1, self.2], {
    let ([a, b], [c, d], [low, high]) = (self.0.range(), self.1.range(), self.2.range());
    if low >= 0.0 && high <= 1.0 {
        [a.min(c), b.max(d)]
    } else {
        let [lower, upper] = product([c - b, d - a], [low, high]);
        [a + lower, b + upper]
    }
});

/// A field clamped to two bounds; its gradient is 0 where it is clamped.
///
/// ```
/// use asperity_noise::{Field, Perlin, glam::Vec2, ops::Clamp};
///
/// let (noise, p) = (Perlin::new(1), Vec2::new(0.3, 1.4));
/// assert_eq!(Clamp(noise, -0.1, 0.1).value(p), noise.value(p).clamp(-0.1, 0.1));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clamp<F>(
    /// The field.
    pub F,
    /// The lower bound.
    pub f32,
    /// The upper bound; the result if it is below the lower bound.
    pub f32,
);

impl<F> Combine<0> for Clamp<F> {
    #[inline(always)]
    fn combined(&self, x: f32, _: [f32; 0]) -> f32 {
        x.max(self.1).min(self.2)
    }
    #[inline(always)]
    fn slope(&self, x: f32, _: [f32; 0], dx: f32, _: [f32; 0]) -> f32 {
        if x > self.1 && x < self.2 { dx } else { 0.0 }
    }
}

combined!([F] Clamp<F>, |self| self.0, [], self.0.range().map(|bound| Combine::combined(self, bound, [])));

/// A field scaled and offset, factor · f + offset.
///
/// ```
/// use asperity_noise::{Field, Perlin, glam::Vec2, ops::ScaleBias};
///
/// let hills = ScaleBias(Perlin::new(1), 30.0, 100.0);
/// assert!((70.0..=130.0).contains(&hills.value(Vec2::new(0.3, 1.4))));
/// ```
#[doc(alias("scale", "bias"))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScaleBias<F>(
    /// f.
    pub F,
    /// The factor.
    pub f32,
    /// The offset.
    pub f32,
);

impl<F> Combine<0> for ScaleBias<F> {
    #[inline(always)]
    fn combined(&self, x: f32, _: [f32; 0]) -> f32 {
        self.1 * x + self.2
    }
    #[inline(always)]
    fn slope(&self, _: f32, _: [f32; 0], dx: f32, _: [f32; 0]) -> f32 {
        self.1 * dx
    }
}

combined!([F] ScaleBias<F>, |self| self.0, [], {
    let [low, high] = product(self.0.range(), [self.1, self.1]);
    [low + self.2, high + self.2]
});

/// A function of a field's values, g(f), with its derivative.
///
/// - **Gradient:** g′(f) ∇f.
/// - **Range:** unknown.
///
/// ```
/// use asperity_noise::{Field, Perlin, glam::Vec2, ops::Map};
///
/// let steep = Map(Perlin::new(1), |n: f32| n * n, |n: f32| 2.0 * n);
/// assert!(steep.value(Vec2::new(0.3, 1.4)) >= 0.0);
/// ```
#[doc(alias("curve", "remap"))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Map<F, G, D>(
    /// f.
    pub F,
    /// g.
    pub G,
    /// g′.
    pub D,
);

impl<F, G: Fn(f32) -> f32, D: Fn(f32) -> f32> Combine<0> for Map<F, G, D> {
    #[inline(always)]
    fn combined(&self, x: f32, _: [f32; 0]) -> f32 {
        self.1(x)
    }
    #[inline(always)]
    fn slope(&self, x: f32, _: [f32; 0], dx: f32, _: [f32; 0]) -> f32 {
        self.2(x) * dx
    }
}

impl<V: Point, F: Field<V>, G: Fn(f32) -> f32, D: Fn(f32) -> f32> Field<V> for Map<F, G, D> {
    #[inline]
    fn sample(&self, p: V) -> Sample<V> {
        let Sample { value, gradient } = self.0.sample(p);
        let slope = self.2(value);
        let gradient = gradient.coordinates();
        Sample { value: self.1(value), gradient: V::from_axes(|axis| slope * gradient.as_ref()[axis]) }
    }

    #[inline]
    fn value(&self, p: V) -> f32 {
        self.1(self.0.value(p))
    }

    fn fill(&self, points: &Points<'_, V>, target: Target<'_, V>) {
        pointwise::fill(self, &self.0, [], points, target);
    }
}
