//! Why a recurrent system is refused.

use crate::numeric::refusal::refusals;
use crate::system::error::SystemError;

refusals! {
    /// Why a recurrent system was refused. Maps are counted from 1, as in the literature, knots from 0.
    RecurrentError from SystemError {
        /// A source does not go from a knot to a later one; `last` is the last knot of all.
        Source { map: usize, from: usize, to: usize, last: usize } =>
            "`sources` of map {map} must rise within 0 to {last}, got {from} to {to}";
        /// A source is no wider than its image.
        Expansion { map: usize, source: f64, image: f64 } =>
            "`sources` of map {map} must be wider than its image of {image}, got {source}";
    }
}
