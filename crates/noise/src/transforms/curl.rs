//! Curl noise: divergence-free velocities from the gradients of fields.

use glam::{Vec2, Vec3};

use crate::{
    contract::field::{Field, HasHessian},
    point::Point,
};

/// A velocity and its Jacobian.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Velocity<V: Point> {
    /// The velocity v.
    pub velocity: V,
    /// ∂v/∂p by rows: row i is the gradient of component i. Its trace is the divergence of v.
    pub jacobian: V::Matrix,
}

/// The flow along the level lines of a 2-D field ψ.
///
/// ```text
/// v = (∂ψ/∂y, −∂ψ/∂x),   ∂v/∂p = [[ψxy, ψyy], [−ψxx, −ψxy]],   div v = ψxy − ψxy = 0, bit for bit
/// ```
///
/// For batches, evaluate gradients with [`Field`] and swap their components.
///
/// Bridson, Hourihan, Nordenstam 2007, "Curl-Noise for Procedural Fluid Flow".
///
/// ```
/// use asperity_noise::{Perlin, curl::Curl2, glam::Vec2};
///
/// let flow = Curl2(Perlin::new(1)).velocity_and_jacobian(Vec2::new(0.3, 1.4));
/// assert_eq!(flow.jacobian[0][0] + flow.jacobian[1][1], 0.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Curl2<F>(
    /// ψ, the stream function.
    pub F,
);

impl<F: Field<Vec2>> Curl2<F> {
    /// Returns the velocity at a point.
    #[must_use]
    #[inline]
    pub fn velocity(&self, p: Vec2) -> Vec2 {
        let gradient = self.0.sample(p).gradient;
        Vec2::new(gradient.y, -gradient.x)
    }
}

impl<F: HasHessian<Vec2>> Curl2<F> {
    /// Returns velocity and Jacobian at a point.
    #[must_use]
    #[inline]
    pub fn velocity_and_jacobian(&self, p: Vec2) -> Velocity<Vec2> {
        let psi = self.0.sample_with_hessian(p);
        let [[xx, xy], [_, yy]] = psi.hessian;
        Velocity { velocity: Vec2::new(psi.gradient.y, -psi.gradient.x), jacobian: [[xy, yy], [-xx, -xy]] }
    }
}

/// The flow along the intersections of the level surfaces of two fields a and b.
///
/// ```text
/// v = ∇a × ∇b,   ∂v/∂pⱼ = (Hₐ eⱼ) × ∇b + ∇a × (H_b eⱼ),   div v = ∇b·curl ∇a − ∇a·curl ∇b = 0
/// ```
///
/// It evaluates two fields instead of the three of a [`CurlPotential`]. a and b are constant along
/// the flow. The trace of the Jacobian is 0 up to rounding: products cancel in pairs, and only
/// their sums are rounded.
///
/// DeWolf 2005, "Divergence-Free Noise".
///
/// ```
/// use asperity_noise::{Fbm, Simplex, FbmSpectrum, curl::Curl3, glam::Vec3};
///
/// let [a, b] = [1, 2].map(|seed| Fbm::new(Simplex::new(seed), FbmSpectrum::CLOUD).with_octaves(2.0));
/// let flow = Curl3(a, b).velocity_and_jacobian(Vec3::new(0.3, 1.4, -0.2));
/// let divergence = flow.jacobian[0][0] + flow.jacobian[1][1] + flow.jacobian[2][2];
/// assert!(divergence.abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Curl3<A, B>(
    /// a.
    pub A,
    /// b.
    pub B,
);

impl<A: Field<Vec3>, B: Field<Vec3>> Curl3<A, B> {
    /// Returns the velocity at a point.
    #[must_use]
    #[inline]
    pub fn velocity(&self, p: Vec3) -> Vec3 {
        cross(self.0.sample(p).gradient.to_array(), self.1.sample(p).gradient.to_array()).into()
    }
}

impl<A: HasHessian<Vec3>, B: HasHessian<Vec3>> Curl3<A, B> {
    /// Returns velocity and Jacobian at a point.
    #[must_use]
    #[inline]
    pub fn velocity_and_jacobian(&self, p: Vec3) -> Velocity<Vec3> {
        let (a, b) = (self.0.sample_with_hessian(p), self.1.sample_with_hessian(p));
        let (da, db) = (a.gradient.to_array(), b.gradient.to_array());
        let mut jacobian = [[0.0; 3]; 3];
        for j in 0..3 {
            let (first, second) = (cross(a.hessian[j], db), cross(da, b.hessian[j]));
            for i in 0..3 {
                jacobian[i][j] = first[i] + second[i];
            }
        }
        Velocity { velocity: cross(da, db).into(), jacobian }
    }
}

/// The curl of a vector potential of three fields.
///
/// ```text
/// v = (∂A₃/∂y − ∂A₂/∂z, ∂A₁/∂z − ∂A₃/∂x, ∂A₂/∂x − ∂A₁/∂y),   div v = 0
/// ```
///
/// Multiply the potential by a factor that falls to 0 at a wall for a flow along the wall. The
/// trace of the Jacobian is 0 up to rounding.
///
/// Bridson, Hourihan, Nordenstam 2007, "Curl-Noise for Procedural Fluid Flow".
///
/// ```
/// use asperity_noise::{Fbm, Simplex, FbmSpectrum, curl::CurlPotential, glam::Vec3};
///
/// let potential = [1, 2, 3].map(|seed| Fbm::new(Simplex::new(seed), FbmSpectrum::CLOUD).with_octaves(2.0));
/// let flow = CurlPotential(potential);
/// assert!(flow.velocity(Vec3::new(0.3, 1.4, -0.2)).is_finite());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CurlPotential<F>(
    /// A₁, A₂ and A₃.
    pub [F; 3],
);

impl<F: Field<Vec3>> CurlPotential<F> {
    /// Returns the velocity at a point.
    #[must_use]
    #[inline]
    pub fn velocity(&self, p: Vec3) -> Vec3 {
        let [a, b, c] = self.0.each_ref().map(|field| field.sample(p).gradient);
        Vec3::new(c.y - b.z, a.z - c.x, b.x - a.y)
    }
}

impl<F: HasHessian<Vec3>> CurlPotential<F> {
    /// Returns velocity and Jacobian at a point.
    #[must_use]
    #[inline]
    pub fn velocity_and_jacobian(&self, p: Vec3) -> Velocity<Vec3> {
        let [a, b, c] = self.0.each_ref().map(|field| field.sample_with_hessian(p));
        let velocity =
            Vec3::new(c.gradient.y - b.gradient.z, a.gradient.z - c.gradient.x, b.gradient.x - a.gradient.y);
        let [a, b, c] = [a.hessian, b.hessian, c.hessian];
        let mut jacobian = [[0.0; 3]; 3];
        for j in 0..3 {
            jacobian[0][j] = c[1][j] - b[2][j];
            jacobian[1][j] = a[2][j] - c[0][j];
            jacobian[2][j] = b[0][j] - a[1][j];
        }
        Velocity { velocity, jacobian }
    }
}

/// u × v with every operation rounded, so that bits are the same everywhere.
fn cross(u: [f32; 3], v: [f32; 3]) -> [f32; 3] {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}
