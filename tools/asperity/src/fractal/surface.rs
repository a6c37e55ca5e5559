//! The surface z = f(x) f(y) as a mesh.

use std::io::Write;

use crate::failure::Result;
use crate::fractal::curve::Curve;

/// The largest number of samples along an axis: 4 million vertices.
pub(super) const MOST: usize = 2049;

/// Writes an OBJ file with y up, and with exact normals if the slopes are known.
pub(super) fn write(curve: &Curve, file: &mut impl Write) -> Result<()> {
    let points = &curve.points;
    let side = points.len();
    for &[y, fy] in points {
        for &[x, fx] in points {
            writeln!(file, "v {} {} {}", x, fx * fy, -y)?;
        }
    }
    if let Some(slopes) = &curve.slopes {
        for (&[_, fy], dfy) in points.iter().zip(slopes) {
            for (&[_, fx], dfx) in points.iter().zip(slopes) {
                let [x, z] = [-dfx * fy, fx * dfy];
                let scale = 1.0 / (x * x + z * z + 1.0).sqrt();
                writeln!(file, "vn {:.9} {:.9} {:.9}", x * scale, scale, z * scale)?;
            }
        }
    }
    let corner = |index: usize| match &curve.slopes {
        Some(_) => format!("{index}//{index}"),
        None => index.to_string(),
    };
    for row in 0..side - 1 {
        for column in 0..side - 1 {
            let first = row * side + column + 1;
            let [a, b, c, d] = [first, first + 1, first + side + 1, first + side].map(corner);
            writeln!(file, "f {a} {b} {c} {d}")?;
        }
    }
    Ok(())
}
