//! Domain warping: a field evaluated at points displaced by other fields.

use crate::{
    contract::field::Field,
    error::NoiseError,
    point::Point,
    row::points::{Buffer, Points, Target, buffers},
    sample::Sample,
};

/// A field evaluated at displaced points: f(q), q = p + s·w(p).
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/warp.md"))]
///
/// ```text
/// ∂q/∂p = I + s ∂w/∂p,   ∇(f ∘ q) = (∂q/∂p)ᵀ ∇f(q)
/// ```
///
/// w has one field per axis. They should be independent: sums of octaves with different seeds are,
/// but single noises with different seeds have a common lattice. Any field can be warped, including
/// another warp. The value is 0 where s·w is not finite.
///
/// Ebert (ed.) 1994, "Texturing and Modeling": textures perturbed by noise.
///
/// ```
/// use asperity_noise::{Field, Fbm, Perlin, Simplex, FbmSpectrum, Warp, glam::Vec2};
///
/// let by = [1, 2].map(|seed| Fbm::new(Simplex::new(seed), FbmSpectrum::CLOUD).with_octaves(4.0));
/// let warp = Warp::new(Perlin::new(3), by, 0.25)?;
///
/// let p = Vec2::new(0.4, -1.7);
/// let [q, f] = [warp.displacement(p).point, p].map(|p| Perlin::new(3).value(p));
/// assert!(warp.value(p) == q && q != f);
/// # Ok::<(), asperity_noise::NoiseError>(())
/// ```
#[doc(alias("domain warp", "distortion", "turbulence"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warp<F, W, const N: usize> {
    field: F,
    by: [W; N],
    strength: f32,
}

/// The displaced point of a [`Warp`], with the Jacobian of the displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Displacement<V: Point> {
    /// q = p + s·w(p).
    pub point: V,
    /// ∂q/∂p by rows: row i is the gradient of coordinate i of q.
    pub jacobian: V::Matrix,
}

impl<F, W, const N: usize> Warp<F, W, N> {
    /// Creates `field` warped by `strength` times the fields `by`.
    ///
    /// # Errors
    ///
    /// If `strength` is not finite.
    pub fn new(field: F, by: [W; N], strength: f32) -> Result<Self, NoiseError> {
        if strength.is_finite() {
            Ok(Self { field, by, strength })
        } else {
            Err(NoiseError::Invalid { parameter: "strength", value: strength, rule: "finite" })
        }
    }

    /// Returns s.
    #[must_use]
    pub const fn strength(&self) -> f32 {
        self.strength
    }

    /// Returns q and ∂q/∂p at a point.
    #[must_use]
    pub fn displacement<V>(&self, p: V) -> Displacement<V>
    where
        V: Point<Coordinates = [f32; N], Matrix = [[f32; N]; N]>,
        W: Field<V>,
    {
        let (q, jacobian) = self.displaced(p);
        Displacement { point: V::from_coordinates(q), jacobian }
    }

    #[inline(always)]
    fn displaced<V: Point<Coordinates = [f32; N]>>(&self, p: V) -> ([f32; N], [[f32; N]; N])
    where
        W: Field<V>,
    {
        let (mut q, mut jacobian) = (p.coordinates(), [[0.0; N]; N]);
        for row in 0..N {
            let Sample { value, gradient } = self.by[row].sample(p);
            let gradient = gradient.coordinates();
            q[row] += self.strength * value;
            for column in 0..N {
                let unit = if row == column { 1.0 } else { 0.0 };
                jacobian[row][column] = unit + self.strength * gradient[column];
            }
        }
        (q, jacobian)
    }
}

/// The number of points that are displaced at once.
const BLOCK: usize = 256;

impl<V: Point<Coordinates = [f32; N]>, F: Field<V>, W: Field<V>, const N: usize> Field<V> for Warp<F, W, N> {
    #[inline]
    fn sample(&self, p: V) -> Sample<V> {
        let (q, jacobian) = self.displaced(p);
        let Sample { value, gradient } = self.field.sample(V::from_coordinates(q));
        let inner = gradient.coordinates();
        let gradient = V::from_axes(|column| {
            (1..N).fold(jacobian[0][column] * inner[0], |sum, row| sum + jacobian[row][column] * inner[row])
        });
        Sample { value, gradient }
    }

    #[inline]
    fn value(&self, p: V) -> f32 {
        let mut q = p.coordinates();
        for axis in 0..N {
            q[axis] += self.strength * self.by[axis].value(p);
        }
        self.field.value(V::from_coordinates(q))
    }

    fn range(&self) -> [f32; 2] {
        self.field.range()
    }

    fn fill(&self, points: &Points<'_, V>, mut target: Target<'_, V>) {
        let (instructions, wanted) = (target.instructions, target.gradients.is_some());
        let mut moved = buffers::<V, BLOCK>();
        let mut by: [Buffer<V, BLOCK>; N] = core::array::from_fn(|_| Buffer::empty());
        let mut inner = Buffer::<V, BLOCK>::empty();
        for block in points.blocks(BLOCK) {
            let (points, width, count) = (points.part(&block), block.width(), block.len());
            points.write(moved.as_mut());
            for ((by, w), list) in by.iter_mut().zip(&self.by).zip(moved.as_mut()) {
                w.fill(&points, by.target(instructions, width, wanted));
                for (x, w) in list.iter_mut().zip(&by.values) {
                    *x += self.strength * w;
                }
            }
            self.field.fill(&Points::buffered(&moved, count), inner.target(instructions, count, wanted));
            let mut target = target.part(&block);
            for row in 0..block.rows.len() {
                let part = row * width..(row + 1) * width;
                let (values, gradients) = target.row(row, width);
                values.copy_from_slice(&inner.values[part.clone()]);
                let Some(mut gradients) = gradients else { continue };
                for (column, gradient) in gradients.as_mut().iter_mut().enumerate() {
                    for row in 0..N {
                        let unit = if row == column { 1.0 } else { 0.0 };
                        let slopes = &by[row].gradients.as_ref()[column][part.clone()];
                        let outer = &inner.gradients.as_ref()[row][part.clone()];
                        for ((sum, slope), outer) in gradient.iter_mut().zip(slopes).zip(outer) {
                            let product = (unit + self.strength * slope) * outer;
                            *sum = if row == 0 { product } else { *sum + product };
                        }
                    }
                }
            }
        }
    }
}
