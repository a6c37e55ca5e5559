//! Implements the traits of an NDF by delegating to another NDF that a method returns.

/// Implements [`Ndf`](crate::ndf::Ndf) and the traits listed after it by the NDF that a method
/// returns.
macro_rules! delegate_ndf {
    ($density:ty, $to:ident $(, $and:ident)*) => {
        impl $crate::ndf::Ndf for $density {
            $crate::ndf::forward_ndf!(|density| density.$to());
        }

        $($crate::density::delegate::delegate_ndf!(@$and $density, $to);)*
    };
    (@Microfacet $density:ty, $to:ident) => {
        impl $crate::microfacet::Microfacet for $density {
            $crate::ndf::forward! { |density| density.$to();
                lambda(v: glam::Vec3) -> f32;
                projected_area(v: glam::Vec3) -> f32;
                sample_visible(v: glam::Vec3, u: glam::Vec2) -> glam::Vec3;
            }
        }
    };
    (@VisibleWarp $density:ty, $to:ident) => {
        impl $crate::microfacet::VisibleWarp for $density {
            $crate::ndf::forward! { |density| density.$to();
                warp_visible(v: glam::Vec3, z: glam::Vec2) -> glam::Vec3;
                invert_visible(v: glam::Vec3, m: glam::Vec3) -> glam::Vec2;
            }
        }
    };
    (@Radial $density:ty, $to:ident) => {
        impl $crate::radial::Radial for $density {
            $crate::ndf::forward! { |density| density.$to(); exponent(slope: f64) -> Option<f64>; }
        }
    };
}
pub(crate) use delegate_ndf;
