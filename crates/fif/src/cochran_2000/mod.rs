//! The two functions of Cochran, Lewis, Hart 2000, their integrals, and the printed algorithms.
//!
//! The algorithms are methods of a system: [`System::algorithm_two`](crate::System::algorithm_two)
//! and [`System::chaos_game`](crate::System::chaos_game).

pub(crate) mod algorithm_two;
pub(crate) mod chaos_game;

use crate::system::error::FifError;
use crate::system::fif::FixedFif;

const KNOTS: [f64; 3] = [0.0, 1.0, 2.0];

/// The polynomials of both maps of `f` and `g`.
const POLYNOMIALS: [[f64; 2]; 2] = [[0.0, 0.5], [1.0, -0.5]];

/// `f`, eq. 18–21: `2 T(x/2)` with Takagi's function `T`; maximum 4/3 at 2/3, continuous, of
/// dimension 1.
///
/// # Errors
/// None; the system is valid.
#[doc(alias = "takagi")]
#[doc(alias = "blancmange")]
pub fn f() -> Result<FixedFif<2, 2>, FifError> {
    FixedFif::new(&KNOTS, &[0.5, 0.5], &POLYNOMIALS)
}

/// `g`, eq. 18, 19, 22, 23: rough, of dimension `1 + log₂ 1.7`, Hölder exponent 0.234.
///
/// # Errors
/// None; the system is valid.
pub fn g() -> Result<FixedFif<2, 2>, FifError> {
    FixedFif::new(&KNOTS, &[17.0 / 20.0, -17.0 / 20.0], &POLYNOMIALS)
}

/// The integral of [`f`] from 0, eq. 37, 38: continuously differentiable.
///
/// # Errors
/// None; the system is valid.
pub fn f_hat() -> Result<FixedFif<2, 3>, FifError> {
    f()?.integral(0.0)
}

/// The integral of [`g`] from 0, eq. 39, 40: continuously differentiable, its slope rough.
///
/// # Errors
/// None; the system is valid.
pub fn g_hat() -> Result<FixedFif<2, 3>, FifError> {
    g()?.integral(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::map::Map;

    #[test]
    fn systems_match_the_printed_maps() {
        for (system, alpha) in [(f().unwrap(), [0.5, 0.5]), (g().unwrap(), [17.0 / 20.0, -17.0 / 20.0])] {
            let maps = [
                Map { a: 0.5, b: 0.0, alpha: alpha[0], q: [0.0, 0.5] },
                Map { a: 0.5, b: 1.0, alpha: alpha[1], q: [1.0, -0.5] },
            ];
            assert_eq!([0, 1].map(|j| *system.pieces()[j].map()), maps);
        }
    }
}
