//! Hessians of transforms.

use asperity_noise::ops::{Add, Clamp, Frequency, Multiply, ScaleBias};
use asperity_noise::{Field, Sample, SampleHessian};

use crate::jet::{Jet, Shared};
use crate::point::At;

/// The value and gradient of a field with a Hessian by entries.
fn with<const N: usize>(
    field: &impl Field<At<N>>,
    p: At<N>,
    entry: impl Fn(usize, usize) -> f32,
) -> SampleHessian<At<N>> {
    let Sample { value, gradient } = field.sample(p);
    let hessian = std::array::from_fn(|i| std::array::from_fn(|j| entry(i.min(j), i.max(j))));
    SampleHessian { value, gradient, hessian }
}

impl<const N: usize> Jet<N> for Add<Shared<N>, Shared<N>> {
    fn has_hessian(&self) -> bool {
        self.0.has_hessian() && self.1.has_hessian()
    }
    fn jet(&self, p: At<N>) -> SampleHessian<At<N>> {
        let (a, b) = (self.0.jet(p), self.1.jet(p));
        with(self, p, |i, j| a.hessian[i][j] + b.hessian[i][j])
    }
}

impl<const N: usize> Jet<N> for Multiply<Shared<N>, Shared<N>> {
    fn has_hessian(&self) -> bool {
        self.0.has_hessian() && self.1.has_hessian()
    }
    fn jet(&self, p: At<N>) -> SampleHessian<At<N>> {
        let (a, b) = (self.0.jet(p), self.1.jet(p));
        let (da, db) = (a.gradient.0, b.gradient.0);
        with(self, p, |i, j| {
            (b.value * a.hessian[i][j] + a.value * b.hessian[i][j]) + (da[i] * db[j] + db[i] * da[j])
        })
    }
}

impl<const N: usize> Jet<N> for ScaleBias<Shared<N>> {
    fn has_hessian(&self) -> bool {
        self.0.has_hessian()
    }
    fn jet(&self, p: At<N>) -> SampleHessian<At<N>> {
        let a = self.0.jet(p);
        with(self, p, |i, j| self.1 * a.hessian[i][j])
    }
}

impl<const N: usize> Jet<N> for Clamp<Shared<N>> {
    fn has_hessian(&self) -> bool {
        self.0.has_hessian()
    }
    fn jet(&self, p: At<N>) -> SampleHessian<At<N>> {
        let a = self.0.jet(p);
        let inside = a.value > self.1 && a.value < self.2;
        with(self, p, |i, j| if inside { a.hessian[i][j] } else { 0.0 })
    }
}

impl<const N: usize> Jet<N> for Frequency<Shared<N>> {
    fn has_hessian(&self) -> bool {
        self.0.has_hessian()
    }
    fn jet(&self, p: At<N>) -> SampleHessian<At<N>> {
        let a = self.0.jet(At(p.0.map(|x| self.1 * x)));
        with(self, p, |i, j| self.1 * self.1 * a.hessian[i][j])
    }
}
