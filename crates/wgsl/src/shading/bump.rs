//! Bump mapping by surface gradients, and facets for unresolved slopes.

use crate::part::{Part, part};
use crate::shading::DIRECTION;

/// Surface gradients and bumped normals, [`bump`](asperity_shading::bump).
pub(crate) static SURFACE_GRADIENT: Part = part!("shading/bump/surface_gradient", DIRECTION);

/// Unresolved slopes as weighted facets: [`slope_facets`](fn@asperity_shading::bump::slope_facets).
pub(crate) static SLOPE_FACETS: Part = part!("shading/bump/slope_facets", SURFACE_GRADIENT);
