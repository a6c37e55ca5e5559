//! Materials as the renderer takes them: the crate's surfaces with reflectances.

mod bumped;
mod carpet;
pub mod cobbles;
pub mod field;
mod glass;
mod paint;
mod panel;
pub mod pattern;
mod plain;
mod wall;

use asperity_shading::{Beckmann, SurfacePoint};

pub use bumped::bumped;
pub use carpet::carpet;
pub use glass::{glass, pane};
pub use paint::{glinting, paint};
pub use panel::{panel, scratched};
pub use plain::{chrome, cloth, glazed, matte};
pub use wall::{bricks, marble, wallpaper};

use crate::integrator::path_tracer::Seen;

/// The point of a surface in metres, where a unit of the scene is so many.
fn in_metres(seen: &Seen, metres: f32) -> SurfacePoint {
    seen.point.scaled(metres)
}

/// A density as wide as facets and unresolved slopes together.
///
/// ```text
/// α² + 2 σ²
/// ```
fn widened(alpha: f32, slope_variance: f32) -> Beckmann {
    let alpha = (alpha * alpha + 2.0 * slope_variance).sqrt();
    Beckmann::clamped(alpha, alpha)
}
