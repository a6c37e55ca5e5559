//! Fractal interpolation functions of any degree behind one pointer.

use std::sync::Arc;

use asperity_fif::{Bounded, Estimate, Extrema, Fif, FifError, Interval};

/// A function through knots whose polynomials have any number of coefficients.
pub(crate) trait Curve: Send + Sync {
    /// The number of coefficients of the polynomials.
    fn coefficients(&self) -> usize;
    /// Knots, values at knots, vertical scalings and polynomials.
    fn system(&self) -> System;
    fn evaluate(&self, x: f64, tolerance: f64) -> Bounded;
    fn domain(&self) -> Interval;
    fn range(&self) -> Interval;
    fn integral_over(&self, l: f64, r: f64) -> Estimate;
    fn mean(&self, l: f64, r: f64) -> Estimate;
    fn moment_over(&self, k: usize, p: usize, l: f64, r: f64) -> Result<Estimate, FifError>;
    fn dimension(&self) -> Interval;
    fn extrema_over(&self, l: f64, r: f64, width: f64) -> Option<Extrema>;
    fn conditioning(&self, x: f64) -> f64;
    fn modulus(&self, distance: f64) -> f64;
    fn holder_exponent(&self) -> f64;
    fn integral(&self, y0: f64) -> Result<Arc<dyn Curve>, String>;
    fn derivative(&self) -> Result<Arc<dyn Curve>, String>;
    /// The function with four coefficients, for surfaces.
    fn cubic(&self) -> Option<Fif<4>>;
}

/// What defines a function.
pub(crate) struct System {
    pub(crate) knots: Vec<f64>,
    pub(crate) values: Vec<f64>,
    pub(crate) scaling: Vec<f64>,
    pub(crate) polynomials: Vec<Vec<f64>>,
}

macro_rules! curve {
    ($c:literal, $integral:expr, $derivative:expr) => {
        impl Curve for Fif<$c> {
            fn coefficients(&self) -> usize {
                $c
            }
            fn system(&self) -> System {
                let pieces = self.pieces();
                let (first, last) = (pieces.first(), pieces.iter());
                System {
                    knots: first
                        .map(|p| p.x()[0])
                        .into_iter()
                        .chain(last.clone().map(|p| p.x()[1]))
                        .collect(),
                    values: first.map(|p| p.y()[0]).into_iter().chain(last.map(|p| p.y()[1])).collect(),
                    scaling: pieces.iter().map(|piece| piece.map().alpha).collect(),
                    polynomials: pieces.iter().map(|piece| piece.map().q.to_vec()).collect(),
                }
            }
            fn evaluate(&self, x: f64, tolerance: f64) -> Bounded {
                Fif::evaluate(self, x, tolerance)
            }
            fn domain(&self) -> Interval {
                Fif::domain(self)
            }
            fn range(&self) -> Interval {
                Fif::range(self)
            }
            fn integral_over(&self, l: f64, r: f64) -> Estimate {
                Fif::integral_over(self, l, r)
            }
            fn mean(&self, l: f64, r: f64) -> Estimate {
                Fif::mean(self, l, r)
            }
            fn moment_over(&self, k: usize, p: usize, l: f64, r: f64) -> Result<Estimate, FifError> {
                Fif::moment_over(self, k, p, l, r)
            }
            fn dimension(&self) -> Interval {
                Fif::dimension(self)
            }
            fn extrema_over(&self, l: f64, r: f64, width: f64) -> Option<Extrema> {
                Fif::extrema_over(self, l, r, width)
            }
            fn conditioning(&self, x: f64) -> f64 {
                Fif::conditioning(self, x)
            }
            fn modulus(&self, distance: f64) -> f64 {
                Fif::modulus(self).at(distance)
            }
            fn holder_exponent(&self) -> f64 {
                Fif::modulus(self).exponent()
            }
            fn integral(&self, y0: f64) -> Result<Arc<dyn Curve>, String> {
                let integral: fn(&Self, f64) -> Result<Arc<dyn Curve>, String> = $integral;
                integral(self, y0)
            }
            fn derivative(&self) -> Result<Arc<dyn Curve>, String> {
                let derivative: fn(&Self) -> Result<Arc<dyn Curve>, String> = $derivative;
                derivative(self)
            }
            fn cubic(&self) -> Option<Fif<4>> {
                let System { knots, values, scaling, polynomials } = Curve::system(self);
                let padded = |q: &Vec<f64>| {
                    let mut four = [0.0; 4];
                    four.get_mut(..q.len())?.copy_from_slice(q);
                    Some(four)
                };
                let q = polynomials.iter().map(padded).collect::<Option<Vec<_>>>()?;
                Fif::with_ordinates(&knots, &values, &scaling, &q).ok()
            }
        }
    };
    ($c:literal) => {
        curve!($c, |f, y0| Ok(Arc::new(f.integral::<Vec<_>, { $c + 1 }>(y0).map_err(said)?)), |f| Ok(
            Arc::new(f.derivative::<Vec<_>, { $c - 1 }>().map_err(said)?)
        ));
    };
}

fn said(error: FifError) -> String {
    error.to_string()
}

curve!(1, |f, y0| Ok(Arc::new(f.integral::<Vec<_>, 2>(y0).map_err(said)?)), |_| {
    Err("a function with constant polynomials has no derivative".into())
});
curve!(2);
curve!(3);
curve!(4);
curve!(5);
curve!(6);
curve!(7, |_, _| Err("polynomials must have at most 7 coefficients".into()), |f| Ok(Arc::new(
    f.derivative::<Vec<_>, 6>().map_err(said)?
)));

/// The function through knots with these polynomials.
pub(crate) fn through(x: &[f64], alpha: &[f64], q: &[Vec<f64>]) -> Result<Arc<dyn Curve>, String> {
    let coefficients = q.first().map_or(0, Vec::len);
    macro_rules! with {
        ($($c:literal),+) => {
            match coefficients {
                $($c => {
                    let q = q.iter().map(|q| <[f64; $c]>::try_from(&q[..])).collect::<Result<Vec<_>, _>>();
                    let q = q.map_err(|_| "`polynomials` must have the same number of coefficients")?;
                    Ok(Arc::new(Fif::<$c>::new(x, alpha, &q).map_err(said)?))
                })+
                _ => Err(format!("`polynomials` must have 1 to 7 coefficients, got {coefficients}")),
            }
        };
    }
    with!(1, 2, 3, 4, 5, 6, 7)
}
