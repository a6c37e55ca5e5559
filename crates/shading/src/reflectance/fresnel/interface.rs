//! The share of light that an interface reflects, as a trait.

use glam::Vec3;

use crate::math::clamp_to;

/// The share of light that an interface reflects, by the angle of incidence, in linear RGB.
///
/// Implemented by every interface of this crate, which reflects the three channels alike; by an array of three, one for
/// each channel; and by a colour, for an interface that reflects the same share from everywhere. Dyn-compatible.
///
/// ```
/// use asperity_shading::{Conductor, Fresnel, glam::Vec3};
///
/// let gold = [(0.18, 3.42), (0.42, 2.35), (1.37, 1.77)].map(|(eta, k)| Conductor::new(eta, k).unwrap());
/// let colour = gold.reflectance_rgb(1.0);
/// assert!(colour.x > colour.y && colour.y > colour.z);
/// assert_eq!(Vec3::splat(0.5).reflectance_rgb(0.2), Vec3::splat(0.5));
/// ```
#[doc(alias = "fresnel")]
#[doc(alias = "f0")]
pub trait Fresnel {
    /// The share of each channel that is reflected, within `[0, 1]`; a cosine that is NaN counts as the horizon's.
    #[must_use]
    fn reflectance_rgb(&self, cos_theta: f32) -> Vec3;
}

impl<F: Fresnel + ?Sized> Fresnel for &F {
    #[inline]
    fn reflectance_rgb(&self, cos_theta: f32) -> Vec3 {
        (**self).reflectance_rgb(cos_theta)
    }
}

/// A colour is clamped to `[0, 1]`, with NaN as 0.
impl Fresnel for Vec3 {
    #[inline]
    fn reflectance_rgb(&self, _: f32) -> Vec3 {
        Self::from_array(self.to_array().map(|c| clamp_to(c, 1.0)))
    }
}

/// An interface with a method `reflectance`, in the three channels alike or one for each.
macro_rules! channels {
    ($interface:ty) => {
        impl Fresnel for $interface {
            #[inline]
            fn reflectance_rgb(&self, cos_theta: f32) -> Vec3 {
                Vec3::splat(self.reflectance(cos_theta))
            }
        }

        impl Fresnel for [$interface; 3] {
            #[inline]
            fn reflectance_rgb(&self, cos_theta: f32) -> Vec3 {
                let [r, g, b] = self;
                Vec3::new(r.reflectance(cos_theta), g.reflectance(cos_theta), b.reflectance(cos_theta))
            }
        }
    };
}

pub(super) use channels;

/// A reflectance within `[0, 1]`; what overflowed to NaN is the limit of a perfect mirror.
#[inline]
pub(super) fn reflectance_or_mirror(f: f32) -> f32 {
    if f >= 0.0 { f.min(1.0) } else { 1.0 }
}
