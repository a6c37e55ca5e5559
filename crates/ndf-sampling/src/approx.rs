//! Comparisons by the crate `approx`.

use approx::{AbsDiffEq, RelativeEq, UlpsEq};

use crate::frame::Frame;

impl AbsDiffEq for Frame {
    type Epsilon = f32;

    fn default_epsilon() -> f32 {
        f32::default_epsilon()
    }

    fn abs_diff_eq(&self, other: &Self, epsilon: f32) -> bool {
        self.axes().iter().zip(other.axes()).all(|(a, b)| AbsDiffEq::abs_diff_eq(a, &b, epsilon))
    }
}

impl RelativeEq for Frame {
    fn default_max_relative() -> f32 {
        f32::default_max_relative()
    }

    fn relative_eq(&self, other: &Self, epsilon: f32, max_relative: f32) -> bool {
        self.axes().iter().zip(other.axes()).all(|(a, b)| a.relative_eq(&b, epsilon, max_relative))
    }
}

impl UlpsEq for Frame {
    fn default_max_ulps() -> u32 {
        f32::default_max_ulps()
    }

    fn ulps_eq(&self, other: &Self, epsilon: f32, max_ulps: u32) -> bool {
        self.axes().iter().zip(other.axes()).all(|(a, b)| a.ulps_eq(&b, epsilon, max_ulps))
    }
}

impl Frame {
    const fn axes(&self) -> [glam::Vec3; 3] {
        [self.tangent, self.bitangent, self.normal]
    }
}
