//! The traits of a density by those of another, which one of its methods returns.

/// Implements [`Ndf`](crate::ndf::Ndf) by the density that a method returns, and the traits that are named behind it.
macro_rules! delegate_ndf {
    ($density:ty, $to:ident $(, $and:ident)*) => {
        impl $crate::ndf::Ndf for $density {
            #[inline]
            fn density(&self, m: glam::Vec3) -> f32 {
                self.$to().density(m)
            }

            #[inline]
            fn from_gaussian(&self, z: glam::Vec2) -> glam::Vec3 {
                self.$to().from_gaussian(z)
            }

            #[inline]
            fn to_gaussian(&self, m: glam::Vec3) -> glam::Vec2 {
                self.$to().to_gaussian(m)
            }

            #[inline]
            fn sample(&self, u: glam::Vec2) -> glam::Vec3 {
                self.$to().sample(u)
            }
        }

        $($crate::density::delegate::delegate_ndf!(@$and $density, $to);)*
    };
    (@Microfacet $density:ty, $to:ident) => {
        impl $crate::microfacet::Microfacet for $density {
            #[inline]
            fn lambda(&self, v: glam::Vec3) -> f32 {
                self.$to().lambda(v)
            }

            #[inline]
            fn projected_area(&self, v: glam::Vec3) -> f32 {
                self.$to().projected_area(v)
            }

            #[inline]
            fn sample_visible(&self, v: glam::Vec3, u: glam::Vec2) -> glam::Vec3 {
                self.$to().sample_visible(v, u)
            }
        }
    };
    (@Radial $density:ty, $to:ident) => {
        impl $crate::radial::Radial for $density {
            #[inline]
            fn exponent(&self, slope: f64) -> Option<f64> {
                self.$to().exponent(slope)
            }
        }
    };
}
pub(crate) use delegate_ndf;
