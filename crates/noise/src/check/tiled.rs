//! Checks of tileable fields.

use alloc::format;

use asperity_core::check::{Report, Settings};

use crate::{
    check::{
        difference::REACH,
        field::{Broken, axes, same_sample},
        settings::points,
    },
    contract::field::Field,
    point::Point,
};

/// Checks that a field repeats along each axis after `period`, bit for bit.
///
/// Axes of period 0 are not checked. The check uses 4096 points with coordinates of 15 bits up to
/// ±4: periods up to 1024 in steps of 2⁻¹² move them without rounding.
///
/// ```
/// use asperity_noise::{Fbm, FbmSpectrum, Perlin, check, glam::Vec2};
///
/// let tile = Fbm::new(Perlin::new(1), FbmSpectrum::CLOUD).tiled([8, 5])?;
/// assert!(check::tiled(&tile, Vec2::new(8.0, 5.0), check::Settings::default()).passed());
/// assert!(!check::tiled(&tile, Vec2::new(4.0, 5.0), check::Settings::default()).passed());
/// # Ok::<(), asperity_noise::NoiseError>(())
/// ```
#[must_use]
pub fn tiled<V: Point, F: Field<V> + ?Sized>(field: &F, period: V, settings: Settings) -> Report {
    let (mut report, mut broken) = (Report::default(), Broken::default());
    let (mut point, period) = (points::<V>(settings, 0, REACH), period.coordinates());
    for k in 0..4096 {
        let (p, along) = (point().coordinates(), k % axes::<V>());
        let moved =
            V::from_axes(|axis| p.as_ref()[axis] + if axis == along { period.as_ref()[axis] } else { 0.0 });
        let [here, there] = [V::from_coordinates(p), moved].map(|p| field.sample(p));
        broken.unless(same_sample(here, there), || format!("{here:?} at {p:?}, {there:?} at {moved:?}"));
    }
    broken.add(&mut report, "tile", "points that differ after a period");
    report
}
