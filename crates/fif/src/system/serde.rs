//! Serialization of systems: data are written, and read through the validating constructor.

use alloc::vec::Vec;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::system::error::FifError;
use crate::system::fif::System;
use crate::system::map::Piece;
use crate::system::storage::Storage;

/// Arguments of [`System::with_ordinates`].
#[derive(Serialize, Deserialize)]
#[serde(rename = "Fif", deny_unknown_fields)]
struct Data {
    /// Knots.
    x: Vec<f64>,
    /// Ordinates.
    y: Vec<f64>,
    /// Vertical factors.
    alpha: Vec<f64>,
    /// Coefficients of the polynomials in ascending powers of x, at most as many as the type has.
    q: Vec<Vec<f64>>,
}

/// Writes `{ x, y, alpha, q }`, the lists for [`System::with_ordinates`].
///
/// Numbers read back have the same bits, in formats that preserve the bits of numbers. Note that
/// JSON readers may round.
impl<S: AsRef<[Piece<C>]>, const C: usize> Serialize for System<S, C> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let pieces = self.pieces();
        let (x_end, y_end) = (self.domain().hi, self.end_values()[1]);
        let data = Data {
            x: pieces.iter().map(|p| p.x()[0]).chain([x_end]).collect(),
            y: pieces.iter().map(|p| p.y()[0]).chain([y_end]).collect(),
            alpha: pieces.iter().map(|p| p.map().alpha).collect(),
            q: pieces.iter().map(|p| p.map().q.to_vec()).collect(),
        };
        data.serialize(serializer)
    }
}

/// Reads through [`System::with_ordinates`]. An invalid system is an error with the message of its
/// [`FifError`].
///
/// Polynomials may be shorter than those of the type, but not longer.
impl<'de, S: Storage<C>, const C: usize> Deserialize<'de> for System<S, C> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let data = Data::deserialize(deserializer)?;
        let q = data
            .q
            .iter()
            .map(|given| padded(given))
            .collect::<Result<Vec<_>, _>>()
            .map_err(D::Error::custom)?;
        Self::with_ordinates(&data.x, &data.y, &data.alpha, &q).map_err(D::Error::custom)
    }
}

/// Coefficients padded to the number of the type.
fn padded<const C: usize>(given: &[f64]) -> Result<[f64; C], FifError> {
    let mut all = [0.0; C];
    let places = all.get_mut(..given.len());
    places.ok_or(FifError::Coefficients { expected: given.len(), got: C })?.copy_from_slice(given);
    Ok(all)
}
