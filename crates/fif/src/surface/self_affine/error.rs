//! Error for invalid data of a self-affine surface.
use crate::system::error::FifError;

/// The maximum magnitudes of heights and of both slopes.
///
/// Checks that there are as many as nodes, `columns` per row, and that all are finite.
pub(crate) fn magnitudes(
    expected: usize,
    columns: usize,
    z: &[f64],
    d: &[[f64; 2]],
) -> Result<[f64; 3], FifError> {
    for (parameter, got) in [("z", z.len()), ("d", d.len())] {
        if got != expected {
            return Err(FifError::Length { parameter, expected, got });
        }
    }
    let mut magnitudes = [0.0_f64; 3];
    for (index, (&z, &[x, y])) in z.iter().zip(d).enumerate() {
        for (most, value) in magnitudes.iter_mut().zip([z, x, y]) {
            if !value.is_finite() {
                let node = [index / columns.max(1), index % columns.max(1)];
                return Err(FifError::NodeNotFinite { node, value });
            }
            *most = most.max(value.abs());
        }
    }
    Ok(magnitudes)
}
