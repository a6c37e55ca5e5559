//! Every noise in every dimension, for tests of common properties.

use asperity_noise::{
    Field, GaussianNoise, Noise, Perlin, PerlinClassic, Point, Simplex, SparseConvolution, ValueCatmullRom,
    ValueGradient, ValueNoise, WhiteNoise,
    glam::{Vec2, Vec3, Vec4},
};

/// A noise that can be tested at points `V` in N dimensions.
pub trait Testable<V: Point, const N: usize>: Noise + Field<V> + Copy + Sync + 'static {}

impl<K: Noise + Field<V> + Copy + Sync + 'static, V: Point, const N: usize> Testable<V, N> for K {}

/// A noise that can be tested in 1 to 4 dimensions.
pub trait AnyKind: Testable<f32, 1> + Testable<Vec2, 2> + Testable<Vec3, 3> + Testable<Vec4, 4> {}

impl<K: Testable<f32, 1> + Testable<Vec2, 2> + Testable<Vec3, 3> + Testable<Vec4, 4>> AnyKind for K {}

/// A test of each noise in each dimension.
pub trait Visit {
    /// Visits one noise in one dimension.
    fn visit<V: Point<Coordinates = [f32; N]>, K: Testable<V, N>, const N: usize>(
        &mut self,
        name: &str,
        noise: K,
    );
}

/// Visits one noise in 1 to 4 dimensions.
pub fn every_dimension<K: AnyKind>(visitor: &mut impl Visit, name: &str, noise: K) {
    visitor.visit::<f32, K, 1>(&format!("{name} 1-D"), noise);
    visitor.visit::<Vec2, K, 2>(&format!("{name} 2-D"), noise);
    visitor.visit::<Vec3, K, 3>(&format!("{name} 3-D"), noise);
    visitor.visit::<Vec4, K, 4>(&format!("{name} 4-D"), noise);
}

/// Visits every noise on the integer hash in 1 to 4 dimensions.
pub fn every_kind(visitor: &mut impl Visit) {
    every_dimension(visitor, "white", WhiteNoise::default());
    every_dimension(visitor, "value", ValueNoise::default());
    every_dimension(visitor, "value, Catmull-Rom", ValueCatmullRom::default());
    every_dimension(visitor, "Perlin 1985", PerlinClassic::default());
    every_dimension(visitor, "Perlin 2002", Perlin::default());
    every_dimension(visitor, "value-gradient", ValueGradient::default());
    every_dimension(visitor, "simplex", Simplex::new(0));
    every_dimension(visitor, "wide simplex", Simplex::new(0).with_classic_radius());
    every_dimension(visitor, "sparse", SparseConvolution::default());
    every_dimension(visitor, "Gaussian", GaussianNoise::default());
}

/// Visits the parametric noises in 1 to 4 dimensions with non-default parameters.
///
/// # Panics
///
/// Never: the parameters are in range.
pub fn every_variant(visitor: &mut impl Visit) {
    for weight in [0.0, 0.25, 0.6, 1.0] {
        let noise = ValueGradient::default().with_weight(weight).expect("a weight in [0, 1]");
        every_dimension(visitor, &format!("value-gradient of weight {weight}"), noise);
    }
    for impulses in 2..=SparseConvolution::MAX_IMPULSES {
        let noise = SparseConvolution::default().with_impulses(impulses).expect("a count in range");
        every_dimension(visitor, &format!("sparse of {impulses}"), noise);
    }
}
