//! The two functions of Cochran, Lewis, Hart 2000, their integrals, and the printed algorithms.
//!
//! The algorithms are methods of a system: [`System::algorithm_two`](crate::System::algorithm_two)
//! and [`System::chaos_game`](crate::System::chaos_game).

pub(crate) mod algorithm_two;
pub(crate) mod chaos_game;

use crate::system::error::FifError;
use crate::system::fif::FixedFif;
use crate::system::map::Map;

/// The knots of all four, `0, 1, 2`.
pub const KNOTS: [f64; 3] = [0.0, 1.0, 2.0];

/// `w_1, w_2` of `f`, eq. 18–21.
pub const F_MAPS: [Map<2>; 2] =
    [Map { a: 0.5, b: 0.0, alpha: 0.5, q: [0.0, 0.5] }, Map { a: 0.5, b: 1.0, alpha: 0.5, q: [1.0, -0.5] }];

/// `w_1, w_2` of `g`, eq. 18, 19, 22, 23.
pub const G_MAPS: [Map<2>; 2] = [
    Map { a: 0.5, b: 0.0, alpha: 17.0 / 20.0, q: [0.0, 0.5] },
    Map { a: 0.5, b: 1.0, alpha: -17.0 / 20.0, q: [1.0, -0.5] },
];

/// `f`, eq. 18–21: `2 T(x/2)` with Takagi's function `T`; maximum 4/3 at 2/3, continuous, of
/// dimension 1.
///
/// # Errors
/// None; the system is valid.
#[doc(alias = "takagi")]
#[doc(alias = "blancmange")]
pub fn f() -> Result<FixedFif<2, 2>, FifError> {
    from_maps(&F_MAPS)
}

/// `g`, eq. 18, 19, 22, 23: rough, of dimension `1 + log₂ 1.7`, Hölder exponent 0.234.
///
/// # Errors
/// None; the system is valid.
pub fn g() -> Result<FixedFif<2, 2>, FifError> {
    from_maps(&G_MAPS)
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

fn from_maps(maps: &[Map<2>; 2]) -> Result<FixedFif<2, 2>, FifError> {
    FixedFif::new(&KNOTS, &maps.map(|w| w.alpha), &maps.map(|w| w.q))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_maps_match_the_systems() {
        for (system, maps) in [(f().unwrap(), F_MAPS), (g().unwrap(), G_MAPS)] {
            for (piece, map) in system.pieces().iter().zip(maps) {
                assert_eq!(*piece.map(), map);
            }
        }
    }
}
