//! Fields that may have Hessians, behind one pointer.

use std::sync::Arc;

use asperity_noise::simd::{Points, Target};
use asperity_noise::{Field, HasHessian, Moments, Sample, SampleHessian};

use crate::point::At;

/// A field that is shared by threads, with its Hessian if it has one.
pub trait Jet<const N: usize>: Field<At<N>> + Send + Sync {
    /// Returns whether [`jet`](Self::jet) returns Hessians.
    fn has_hessian(&self) -> bool {
        false
    }

    /// Returns value, gradient and Hessian; the Hessian is 0 unless [`has_hessian`](Self::has_hessian).
    fn jet(&self, p: At<N>) -> SampleHessian<At<N>> {
        let Sample { value, gradient } = self.sample(p);
        SampleHessian { value, gradient, hessian: [[0.0; N]; N] }
    }
}

/// A field of any type.
pub type Shared<const N: usize> = Arc<dyn Jet<N>>;

/// A field without Hessians.
pub(crate) struct Plain<F>(pub(crate) F);

/// A field with Hessians.
pub(crate) struct Curved<F>(pub(crate) F);

/// Evaluates batches point by point, and is compiled for single points only.
pub(crate) struct Pointwise<F>(pub(crate) F);

macro_rules! forward {
    () => {
        fn sample(&self, p: At<N>) -> Sample<At<N>> {
            self.0.sample(p)
        }
        fn value(&self, p: At<N>) -> f32 {
            self.0.value(p)
        }
        fn range(&self) -> [f32; 2] {
            self.0.range()
        }
        fn moments(&self) -> Option<Moments> {
            self.0.moments()
        }
    };
}

impl<F: Field<At<N>>, const N: usize> Field<At<N>> for Plain<F> {
    forward!();
    fn fill(&self, points: &Points<'_, At<N>>, target: Target<'_, At<N>>) {
        self.0.fill(points, target);
    }
}

impl<F: Field<At<N>>, const N: usize> Field<At<N>> for Curved<F> {
    forward!();
    fn fill(&self, points: &Points<'_, At<N>>, target: Target<'_, At<N>>) {
        self.0.fill(points, target);
    }
}

impl<F: Field<At<N>>, const N: usize> Field<At<N>> for Pointwise<F> {
    forward!();
}

impl<F: HasHessian<At<N>>, const N: usize> HasHessian<At<N>> for Pointwise<F> {
    fn sample_with_hessian(&self, p: At<N>) -> SampleHessian<At<N>> {
        self.0.sample_with_hessian(p)
    }
}

impl<F: Field<At<N>> + Send + Sync, const N: usize> Jet<N> for Plain<F> {}

impl<F: HasHessian<At<N>> + Send + Sync, const N: usize> Jet<N> for Curved<F> {
    fn has_hessian(&self) -> bool {
        true
    }
    fn jet(&self, p: At<N>) -> SampleHessian<At<N>> {
        self.0.sample_with_hessian(p)
    }
}
