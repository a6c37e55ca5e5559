//! Strategies of proptest: footprints of pixels, and directions, roughness and unit squares of `asperity-ndf-sampling`.

pub use asperity_ndf_sampling::strategies::{direction, roughness, unit_square};
use proptest::prelude::*;

use crate::math::exp2;
use crate::pixel::Footprint;

/// Footprints of pixels: widths from 2⁻³⁰ to 2³⁰, as likely in each octave, no width, and no bound of it.
///
/// ```
/// use asperity_shading::{Carpet, CarpetParameters, Material, SurfacePoint, strategies, glam::Vec3};
/// use proptest::prelude::*;
///
/// let carpet = Carpet::new(CarpetParameters::default())?;
/// proptest!(|(footprint in strategies::footprint(), wo in strategies::direction())| {
///     let point = SurfacePoint::new(Vec3::new(0.3, 0.2, 0.0), Vec3::Z, footprint);
///     prop_assert!(carpet.bsdf(&point, wo).scattered(Vec3::Z, wo).is_finite());
/// });
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
pub fn footprint() -> impl Strategy<Value = Footprint> {
    let width = prop_oneof![
        8 => (-30.0..30.0_f32).prop_map(exp2),
        1 => Just(0.0),
        1 => Just(f32::INFINITY),
    ];
    width.prop_map(Footprint::from_width)
}
