//! Fields of kinds and of sums of their octaves, in each number of dimensions.

use std::sync::Arc;

use asperity_noise::{Fbm, Field, HasHessian, NoiseError, RidgedMultifractal};

use crate::jet::{Curved, Plain, Pointwise, Shared};
use crate::kind::Kind;
use crate::point::At;
use crate::sum::{AnyShape, Sum};

/// Where a noise is: everywhere, repeated, or near an anchor.
#[derive(Clone, Copy, Debug)]
pub enum Place<'a> {
    /// Around the origin.
    Origin,
    /// In a tile with these periods.
    Tile(&'a [u32]),
    /// Relative to an anchor.
    Anchor(&'a [f64]),
}

/// Points for which fields can be built.
pub trait Space<const N: usize> {
    /// Creates the field of a kind, or the sum of its octaves.
    ///
    /// # Errors
    ///
    /// If the kind does not have the periods, or not in this number of dimensions.
    fn noise(kind: &Kind, sum: Option<&Sum>, place: Place<'_>) -> Result<Shared<N>, String>;
}

/// A sum of octaves of a field of any type.
///
/// # Errors
///
/// If the feedback is invalid.
pub fn sum_of<const N: usize>(field: Shared<N>, sum: &Sum) -> Result<Shared<N>, String> {
    plain(Fbm::new(field, sum.spectrum), sum)
}

/// Defines a function that wraps a sum with its parameters.
macro_rules! wrapped {
    ($name:ident, $bound:ident, $signed:expr, $other:expr) => {
        fn $name<F: $bound<At<N>> + Send + Sync + 'static, const N: usize>(
            fbm: Fbm<F, At<N>>,
            sum: &Sum,
        ) -> Result<Shared<N>, String> {
            Ok(match with_parameters(fbm, sum)? {
                Summed::Signed(fbm) => Arc::new($signed(fbm)),
                Summed::Shaped(fbm) => Arc::new($other(fbm)),
                Summed::Ridged(sum) => Arc::new($other(sum)),
            })
        }
    };
}

wrapped!(plain, Field, Plain, Plain);
// With Hessians where the shape is the identity.
wrapped!(curved, HasHessian, Curved, Plain);
// Lanes for the sums that are used most.
wrapped!(plain_signed, Field, Plain, |sum| Plain(Pointwise(sum)));
wrapped!(curved_signed, HasHessian, Curved, |sum| Plain(Pointwise(sum)));
wrapped!(plain_pointwise, Field, |sum| Plain(Pointwise(sum)), |sum| Plain(Pointwise(sum)));
wrapped!(curved_pointwise, HasHessian, |sum| Curved(Pointwise(sum)), |sum| Plain(Pointwise(sum)));

/// A sum of any shape.
enum Summed<F, const N: usize> {
    Signed(Fbm<F, At<N>>),
    Shaped(Fbm<F, At<N>, AnyShape>),
    Ridged(RidgedMultifractal<F, At<N>>),
}

fn with_parameters<F: Field<At<N>>, const N: usize>(
    mut fbm: Fbm<F, At<N>>,
    sum: &Sum,
) -> Result<Summed<F, N>, String> {
    if let Some(normalization) = sum.normalization {
        fbm = fbm.with_normalization(normalization);
    }
    let fbm = fbm.with_octaves(sum.octaves);
    if let Some(feedback) = sum.feedback {
        return RidgedMultifractal::from_fbm(fbm, feedback).map(Summed::Ridged).map_err(said);
    }
    Ok(match sum.shape {
        AnyShape::Signed => Summed::Signed(fbm.band_limited(sum.footprint)),
        shape => Summed::Shaped(fbm.with_shape(shape).band_limited(sum.footprint)),
    })
}

fn said(error: NoiseError) -> String {
    error.to_string()
}

/// An array of one number per axis, from one number for all axes or one for each.
fn per_axis<T: Copy, const N: usize>(name: &str, numbers: &[T]) -> Result<[T; N], String> {
    match *numbers {
        [number] => Ok([number; N]),
        _ => numbers.try_into().map_err(|_| format!("`{name}` must have {N} numbers, got {}", numbers.len())),
    }
}

/// Builds a kind in one number of dimensions. `$near` is for batches of the noise as it is, `$far` for
/// tiles and anchors: `lanes` compiles them for every SIMD level, `signed` does so for sums without
/// a shape, `points` evaluates point by point.
macro_rules! noise {
    ($n:literal, $noise:ident, $hessian:ident, $sum:ident, $place:ident, $tiles:tt, $near:ident, $far:ident) => {{
        let noise = *$noise;
        match ($place, $sum) {
            (Place::Origin, None) => Ok(lone!($hessian, $near, noise) as Shared<$n>),
            (Place::Origin, Some(sum)) => summed!($hessian, $near, fbm!($n, noise, sum), sum),
            (Place::Anchor(at), None) => {
                let single = Fbm::<_, At<$n>>::single(noise).anchored(per_axis("anchor", at)?);
                Ok(lone!($hessian, points, single) as Shared<$n>)
            }
            (Place::Anchor(at), Some(sum)) => {
                let fbm = fbm!($n, noise, sum).anchored(per_axis("anchor", at)?);
                summed!($hessian, $far, fbm, sum)
            }
            (Place::Tile(_), _) => tiled!($n, noise, $hessian, $sum, $place, $tiles, $far),
        }
    }};
}

macro_rules! fbm {
    ($n:literal, $noise:ident, $sum:ident) => {
        Fbm::<_, At<$n>>::new($noise, $sum.spectrum).with_rotation($sum.rotation)
    };
}

macro_rules! lone {
    (plain, lanes, $noise:expr) => {
        Arc::new(Plain($noise))
    };
    (plain, signed, $noise:expr) => {
        Arc::new(Plain($noise))
    };
    (plain, points, $noise:expr) => {
        Arc::new(Plain(Pointwise($noise)))
    };
    (curved, lanes, $noise:expr) => {
        Arc::new(Curved($noise))
    };
    (curved, signed, $noise:expr) => {
        Arc::new(Curved($noise))
    };
    (curved, points, $noise:expr) => {
        Arc::new(Curved(Pointwise($noise)))
    };
}

macro_rules! summed {
    (plain, lanes, $fbm:expr, $sum:ident) => {
        plain($fbm, $sum)
    };
    (plain, signed, $fbm:expr, $sum:ident) => {
        plain_signed($fbm, $sum)
    };
    (plain, points, $fbm:expr, $sum:ident) => {
        plain_pointwise($fbm, $sum)
    };
    (curved, lanes, $fbm:expr, $sum:ident) => {
        curved($fbm, $sum)
    };
    (curved, signed, $fbm:expr, $sum:ident) => {
        curved_signed($fbm, $sum)
    };
    (curved, points, $fbm:expr, $sum:ident) => {
        curved_pointwise($fbm, $sum)
    };
}

macro_rules! tiled {
    ($n:literal, $noise:ident, $hessian:ident, $sum:ident, $place:ident, never, $far:ident) => {
        Err(format!("simplex noise in {}-D has no period (1-D and 3-D have)", $n))
    };
    ($n:literal, $noise:ident, $hessian:ident, $sum:ident, $place:ident, $tiles:ident, $far:ident) => {{
        let Place::Tile(periods) = $place else { return Err(String::new()) };
        let periods: [u32; $n] = per_axis("period", periods)?;
        match $sum {
            None => Ok(lone!($tiles, $far, $noise.tiled(periods).map_err(said)?) as Shared<$n>),
            Some(sum) => {
                summed!($tiles, $far, fbm!($n, $noise, sum).tiled(periods).map_err(said)?, sum)
            }
        }
    }};
}

/// Each kind with the batches of the plain noise, and of tiles and anchors: the kinds that are used
/// most, those that are used often, and the others.
macro_rules! space {
    ($n:literal, $simplex:tt, [$a:ident, $far_a:ident], [$b:ident, $far_b:ident], [$c:ident, $far_c:ident]) => {
        impl Space<$n> for At<$n> {
            fn noise(kind: &Kind, sum: Option<&Sum>, place: Place<'_>) -> Result<Shared<$n>, String> {
                match kind {
                    Kind::Perlin(k) => noise!($n, k, curved, sum, place, curved, $a, $far_a),
                    Kind::Simplex(k) => noise!($n, k, curved, sum, place, $simplex, $a, $far_a),
                    Kind::Value(k) => noise!($n, k, curved, sum, place, curved, $b, $far_b),
                    Kind::Gaussian(k) => noise!($n, k, curved, sum, place, curved, $b, $far_b),
                    Kind::Cellular(k) => noise!($n, k, plain, sum, place, plain, $b, $far_b),
                    Kind::White(k) => noise!($n, k, plain, sum, place, plain, $c, $far_c),
                    Kind::ValueCatmullRom(k) => noise!($n, k, plain, sum, place, plain, $c, $far_c),
                    Kind::PerlinClassic(k) => noise!($n, k, curved, sum, place, curved, $c, $far_c),
                    Kind::ValueGradient(k) => noise!($n, k, curved, sum, place, curved, $c, $far_c),
                    Kind::Sparse(k) => noise!($n, k, plain, sum, place, plain, $c, $far_c),
                }
            }
        }
    };
}

// Lanes of tiles, of anchors and of four dimensions take minutes to compile, so that only some have
// them. Simplex noise tiles in 1-D, and in 3-D as a kind without Hessians.
space!(1, curved, [lanes, points], [lanes, points], [lanes, points]);
space!(2, never, [lanes, signed], [lanes, signed], [lanes, points]);
space!(3, plain, [lanes, points], [lanes, points], [lanes, points]);
space!(4, never, [signed, points], [points, points], [points, points]);
