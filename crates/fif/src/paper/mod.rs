//! The two functions of Cochran, Lewis, Hart 2000 and their integrals, ready made.

pub(crate) mod algorithm_two;
pub(crate) mod chaos_game;
mod functions;

pub use functions::{F_MAPS, G_MAPS, KNOTS, f, f_hat, g, g_hat};
