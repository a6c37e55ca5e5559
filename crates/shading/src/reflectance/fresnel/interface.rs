//! The `Fresnel` trait: the reflectance of an interface.

use glam::Vec3;

use crate::math::clamp_to;

/// The reflectance of an interface by the angle of incidence, in linear RGB.
///
/// Implemented by every interface of this crate, with the same reflectance in all channels; by an
/// array of three interfaces, one for each channel; and by a color, for an interface with constant
/// reflectance. Dyn-compatible.
///
/// ```
/// use asperity_shading::{Conductor, Fresnel, glam::Vec3};
///
/// let gold = [(0.18, 3.42), (0.42, 2.35), (1.37, 1.77)].map(|(eta, k)| Conductor::new(eta, k).unwrap());
/// let color = gold.reflectance_rgb(1.0);
/// assert!(color.x > color.y && color.y > color.z);
/// assert_eq!(Vec3::splat(0.5).reflectance_rgb(0.2), Vec3::splat(0.5));
/// ```
#[doc(alias = "fresnel")]
#[doc(alias = "f0")]
pub trait Fresnel {
    /// The reflectance in each channel, within `[0, 1]`; a NaN cosine is read as the horizon.
    #[must_use]
    fn reflectance_rgb(&self, cos_theta: f32) -> Vec3;

    /// `F_avg`: the mean reflectance of diffuse light in each channel.
    ///
    /// ```text
    /// F_avg = 2 ∫ F(cos θ) cos θ dcos θ
    /// ```
    ///
    /// - **Accuracy:** eight nodes of Gauss and Legendre, exact for Schlick's approximation. Within
    ///   10⁻³ for metals and for dielectrics seen from the rarer side. Within 0.06 from the denser
    ///   side, where F has a kink at the critical angle.
    #[must_use]
    fn mean_reflectance_rgb(&self) -> Vec3 {
        MEAN_NODES.into_iter().map(|[c, weight]| weight * self.reflectance_rgb(c)).sum()
    }
}

/// Cosines and weights of `2 ∫ f(c) c dc` over `[0, 1]`, by Gauss and Legendre.
pub(in crate::reflectance) const MEAN_NODES: [[f32; 2]; 8] = [
    [0.019_855_07, 0.002_009_9],
    [0.101_666_76, 0.022_608_76],
    [0.237_233_8, 0.074_421_82],
    [0.408_282_68, 0.148_077_5],
    [0.591_717_3, 0.214_606_28],
    [0.762_766_2, 0.239_284_83],
    [0.898_333_25, 0.199_772_27],
    [0.980_144_9, 0.099_218_64],
];

impl<F: Fresnel + ?Sized> Fresnel for &F {
    #[inline]
    fn reflectance_rgb(&self, cos_theta: f32) -> Vec3 {
        (**self).reflectance_rgb(cos_theta)
    }

    fn mean_reflectance_rgb(&self) -> Vec3 {
        (**self).mean_reflectance_rgb()
    }
}

/// A color is clamped to `[0, 1]`; NaN becomes 0.
impl Fresnel for Vec3 {
    #[inline]
    fn reflectance_rgb(&self, _: f32) -> Vec3 {
        Self::from_array(self.to_array().map(|c| clamp_to(c, 1.0)))
    }
}

/// An interface with a method `reflectance`, for all channels or for each.
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

/// A reflectance within `[0, 1]`; overflow to NaN becomes the limit of a perfect mirror.
#[inline]
pub(super) fn reflectance_or_mirror(f: f32) -> f32 {
    if f >= 0.0 { f.min(1.0) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reflectance::fresnel::{Conductor, Dielectric, Schlick, SchlickF82};

    #[test]
    fn array_of_interfaces_is_per_channel() {
        let glasses = [1.2, 1.5, 2.4].map(|eta| Dielectric::new(eta).unwrap());
        let metals = [0.2, 0.9, 1.4].map(|eta| Conductor::new(eta, 2.0).unwrap());
        let (tints, edges) = (
            [0.1, 0.5, 0.9].map(|f0| Schlick::new(f0).unwrap()),
            [0.1, 0.5, 0.9].map(|f0| SchlickF82::new(f0, 0.05).unwrap()),
        );
        let colors: [(&dyn Fresnel, [&dyn Fresnel; 3]); 4] = [
            (&glasses, [&glasses[0], &glasses[1], &glasses[2]]),
            (&metals, [&metals[0], &metals[1], &metals[2]]),
            (&tints, [&tints[0], &tints[1], &tints[2]]),
            (&edges, [&edges[0], &edges[1], &edges[2]]),
        ];
        for (color, channels) in colors {
            for cosine in [0.1, 0.7, 1.0] {
                let alone = channels.map(|channel| channel.reflectance_rgb(cosine));
                assert!(alone.iter().all(|gray| gray.x == gray.y && gray.y == gray.z));
                assert_eq!(color.reflectance_rgb(cosine).to_array(), alone.map(|gray| gray.x));
            }
        }
    }

    #[test]
    fn reflectance_accepts_every_input() {
        let odd = [f32::MIN_POSITIVE, 1e-20, 0.3, 1.0 - 1e-7, 1.0, 1.0 + 1e-6, 3.0, 1e10, 1e30, f32::MAX];
        for (eta, k) in odd.into_iter().flat_map(|eta| odd.map(|k| (eta, k))) {
            let glass = Dielectric::new(eta).unwrap();
            let (metal, clear) = (Conductor::new(eta, k).unwrap(), Conductor::new(eta, 0.0).unwrap());
            let (schlick, tinted) = (Schlick::new(0.04).unwrap(), SchlickF82::new(0.5, 0.1).unwrap());
            let all: [&dyn Fresnel; 6] = [&glass, &glass.reversed(), &metal, &clear, &schlick, &tinted];
            for c in [f32::NAN, f32::NEG_INFINITY, -1.0, -0.0, 0.0, 1e-30, 0.3, 1.0, 2.0, f32::INFINITY] {
                let shares = all.map(|fresnel| fresnel.reflectance_rgb(c).x);
                assert!(shares.iter().all(|f| (0.0..=1.0).contains(f)), "{eta}, {k}, cos = {c}: {shares:?}");
            }
        }
        assert_eq!(Dielectric::new(1.5).unwrap().reflectance(f32::NAN), 1.0);
        assert_eq!(Dielectric::new(1.0).unwrap().reflectance(0.0), 0.0);
    }
}
