//! Every kind of noise in every dimension, for tests that hold for all of them.

use asperity_noise::{
    Gaussian, Kernel, Noise, Perlin1985, Perlin2002, PermutationTable, Point, Simplex, Sparse, Value,
    ValueCatmullRom, ValueGradient, White,
    glam::{Vec2, Vec3, Vec4},
};

/// A kind of noise that can be tested at points `V` in N dimensions.
pub trait Testable<V, const N: usize>: Kernel<N> + Noise<V> + Copy + Sync {}

impl<K: Kernel<N> + Noise<V> + Copy + Sync, V, const N: usize> Testable<V, N> for K {}

/// What is done with each kind in each dimension.
pub trait Visit {
    /// One kind in one dimension.
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K);
}

/// Visits one kind in 1 to 4 dimensions.
pub fn every_dimension<K>(visitor: &mut impl Visit, name: &str, noise: K)
where
    K: Kernel<1> + Kernel<2> + Kernel<3> + Kernel<4> + Copy + Sync,
{
    visitor.visit::<f32, K, 1>(&format!("{name} 1-D"), noise);
    visitor.visit::<Vec2, K, 2>(&format!("{name} 2-D"), noise);
    visitor.visit::<Vec3, K, 3>(&format!("{name} 3-D"), noise);
    visitor.visit::<Vec4, K, 4>(&format!("{name} 4-D"), noise);
}

/// Visits every kind on the integer hash in 1 to 4 dimensions.
pub fn every_kind(visitor: &mut impl Visit) {
    every_dimension(visitor, "Perlin 1985", Perlin1985::default());
    every_dimension(visitor, "Perlin 2002", Perlin2002::default());
    every_dimension(visitor, "simplex", Simplex::CONTINUOUS);
    every_dimension(visitor, "wide simplex", Simplex::WIDE);
    every_dimension(visitor, "Gaussian", Gaussian::default());
}

/// Visits the kinds that are not of gradients alone, in 1 to 4 dimensions.
pub fn every_further_kind(visitor: &mut impl Visit) {
    every_dimension(visitor, "white", White::default());
    every_dimension(visitor, "value", Value::default());
    every_dimension(visitor, "value, Catmull-Rom", ValueCatmullRom::default());
    every_dimension(visitor, "value-gradient", ValueGradient::default());
    every_dimension(visitor, "sparse", Sparse::default());
}

/// Visits every kind on a permutation table in 1 to 4 dimensions.
pub fn every_kind_by_permutation(visitor: &mut impl Visit) {
    let table = PermutationTable::new(1);
    every_dimension(visitor, "Perlin 1985 by permutation", Perlin1985(table));
    every_dimension(visitor, "Perlin 2002 by permutation", Perlin2002(table));
    every_dimension(visitor, "simplex by permutation", Simplex::CONTINUOUS.with_lattice(table));
    every_dimension(visitor, "wide simplex by permutation", Simplex::WIDE.with_lattice(table));
    every_dimension(visitor, "Gaussian by permutation", Gaussian(table));
}
