//! Results of one evaluation of a field: value and gradient, optionally the Hessian.

use crate::point::Point;

/// Value and analytic gradient of a field at a point, from one evaluation.
///
/// `V` is the type of the point: `f32`, [`glam::Vec2`], [`glam::Vec3`] or [`glam::Vec4`]. The
/// gradient is in units of the value per unit of the field's input coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample<V> {
    /// The value, dimensionless.
    pub value: f32,
    /// ∂value/∂p, per unit length of the input.
    pub gradient: V,
}

/// Value, gradient and Hessian of a field at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleHessian<V: Point> {
    /// The value, dimensionless.
    pub value: f32,
    /// ∂value/∂p, per unit length of the input.
    pub gradient: V,
    /// ∂²value/∂pᵢ∂pⱼ, per unit length squared; symmetric, bit for bit.
    pub hessian: V::Matrix,
}

#[cfg(feature = "approx")]
mod approximately {
    use super::{Point, Sample};
    use approx::{AbsDiffEq, RelativeEq, UlpsEq};

    impl<V: AbsDiffEq<Epsilon = f32>> AbsDiffEq for Sample<V> {
        type Epsilon = f32;
        fn default_epsilon() -> f32 {
            f32::default_epsilon()
        }
        fn abs_diff_eq(&self, other: &Self, epsilon: f32) -> bool {
            self.value.abs_diff_eq(&other.value, epsilon)
                && self.gradient.abs_diff_eq(&other.gradient, epsilon)
        }
    }

    impl<V: RelativeEq<Epsilon = f32>> RelativeEq for Sample<V> {
        fn default_max_relative() -> f32 {
            f32::default_max_relative()
        }
        fn relative_eq(&self, other: &Self, epsilon: f32, max_relative: f32) -> bool {
            self.value.relative_eq(&other.value, epsilon, max_relative)
                && self.gradient.relative_eq(&other.gradient, epsilon, max_relative)
        }
    }

    impl<V: UlpsEq<Epsilon = f32>> UlpsEq for Sample<V> {
        fn default_max_ulps() -> u32 {
            f32::default_max_ulps()
        }
        fn ulps_eq(&self, other: &Self, epsilon: f32, max_ulps: u32) -> bool {
            self.value.ulps_eq(&other.value, epsilon, max_ulps)
                && self.gradient.ulps_eq(&other.gradient, epsilon, max_ulps)
        }
    }

    impl<V: Point + AbsDiffEq<Epsilon = f32>> super::SampleHessian<V>
    where
        V::Matrix: AsRef<[V::Coordinates]>,
    {
        /// Whether all entries of both are close under a comparison of numbers.
        fn is_near(&self, other: &Self, gradients: bool, near: impl Fn(&f32, &f32) -> bool) -> bool {
            let rows = self.hessian.as_ref().iter().zip(other.hessian.as_ref());
            gradients
                && near(&self.value, &other.value)
                && rows.flat_map(|(a, b)| a.as_ref().iter().zip(b.as_ref())).all(|(a, b)| near(a, b))
        }
    }

    impl<V: Point + AbsDiffEq<Epsilon = f32>> AbsDiffEq for super::SampleHessian<V>
    where
        V::Matrix: AsRef<[V::Coordinates]>,
    {
        type Epsilon = f32;
        fn default_epsilon() -> f32 {
            f32::default_epsilon()
        }
        fn abs_diff_eq(&self, other: &Self, epsilon: f32) -> bool {
            let gradients = self.gradient.abs_diff_eq(&other.gradient, epsilon);
            self.is_near(other, gradients, |a, b| a.abs_diff_eq(b, epsilon))
        }
    }

    impl<V: Point + RelativeEq<Epsilon = f32>> RelativeEq for super::SampleHessian<V>
    where
        V::Matrix: AsRef<[V::Coordinates]>,
    {
        fn default_max_relative() -> f32 {
            f32::default_max_relative()
        }
        fn relative_eq(&self, other: &Self, epsilon: f32, max_relative: f32) -> bool {
            let gradients = self.gradient.relative_eq(&other.gradient, epsilon, max_relative);
            self.is_near(other, gradients, |a, b| a.relative_eq(b, epsilon, max_relative))
        }
    }
}

#[cfg(test)]
mod tests {
    #[cfg(feature = "approx")]
    #[test]
    fn approx_compares_every_entry() {
        use super::{Sample, SampleHessian};
        use approx::{abs_diff_eq, relative_eq, ulps_eq};
        use glam::Vec2;

        let second = |numbers: [f32; 7]| {
            let [value, x, y, xx, xy, yx, yy] = numbers;
            SampleHessian { value, gradient: Vec2::new(x, y), hessian: [[xx, xy], [yx, yy]] }
        };
        let first = |numbers| {
            let SampleHessian { value, gradient, .. } = second(numbers);
            Sample { value, gradient }
        };
        let numbers = [4.0; 7];
        let (a, b) = (first(numbers), second(numbers));
        assert!(abs_diff_eq!(a, a) && relative_eq!(a, a) && ulps_eq!(a, a));
        assert!(abs_diff_eq!(b, b) && relative_eq!(b, b));
        for k in 0..7 {
            let mut other = numbers;
            // 2¹⁹ units in the last place.
            other[k] = 4.25;
            let (c, d) = (first(other), second(other));
            assert!(abs_diff_eq!(a, c, epsilon = 0.3) && abs_diff_eq!(b, d, epsilon = 0.3));
            assert!(relative_eq!(a, c, max_relative = 0.06) && relative_eq!(b, d, max_relative = 0.06));
            assert!(ulps_eq!(a, c, epsilon = 0.0, max_ulps = 1 << 19));
            assert!(!abs_diff_eq!(b, d, epsilon = 0.2) && !relative_eq!(b, d, max_relative = 0.05), "{k}");
            // A sample has no Hessian.
            let differs = k < 3;
            assert_eq!(!abs_diff_eq!(a, c, epsilon = 0.2), differs, "{k}");
            assert_eq!(!relative_eq!(a, c, max_relative = 0.05), differs, "{k}");
            assert_eq!(!ulps_eq!(a, c, epsilon = 0.0, max_ulps = (1 << 19) - 1), differs, "{k}");
        }
    }
}
