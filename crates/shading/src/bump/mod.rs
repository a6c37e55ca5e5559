//! Bump mapping: surface gradients, displaced surfaces, and facets for unresolved slopes.

mod displacement;
pub(crate) mod slope_facets;
mod surface_gradient;

pub use displacement::{Displaced, displace};
#[doc(hidden)]
pub use slope_facets::facets_along;
pub use slope_facets::{Facet, slope_facets};
pub use surface_gradient::{
    bumped_normal, finite_difference_gradient, flip_to_visible, gradient_of_normal, project_to_tangent_plane,
    surface_gradient,
};
