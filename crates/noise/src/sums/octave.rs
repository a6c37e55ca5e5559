//! The affine map of one octave: seed, offset, and rotation times frequency.

use asperity_core::SplitMix64;

use crate::{
    contract::kernel::{Kernel, OctavesAt},
    lanes::{Arithmetic, LaneSample, Lanes, Scalar},
    lattice::variates::{gaussian_quaternion, unit_direction},
    point::Dimension,
    sums::spectrum::{FbmSpectrum, MAX_OCTAVES},
};

/// Whether octaves are rotated relative to each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Rotation {
    /// Every octave has its own random rotation.
    ///
    /// Lattices coincide nowhere, and the sum has no preferred direction.
    #[default]
    Random,
    /// No octave is rotated. The lattices are parallel, so grids reuse work along rows.
    ///
    /// The axes of the lattice are visible in the sum, and two sums of different seeds peak more
    /// often along the same planes.
    Aligned,
}

/// The seed of an octave's lattice and the affine map into it.
///
/// A common lattice makes octaves or channels dependent even if their seeds differ: their variances
/// peak at the same points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layer<const N: usize> {
    pub(crate) seed: u32,
    pub(crate) rotation: Rotation,
    /// Rotation times frequency, by rows.
    pub(crate) matrix: [[f32; N]; N],
    pub(crate) offset: [f32; N],
    /// The origin of the octave's cells if the sum is anchored.
    pub(crate) cell: [i32; N],
}

impl<const N: usize> Layer<N> {
    /// All layers of a spectrum.
    pub(crate) fn all(spectrum: &FbmSpectrum, rotation: Rotation, seed: u32) -> [Self; MAX_OCTAVES as usize] {
        let mut i = 0;
        [(); MAX_OCTAVES as usize].map(|()| {
            let word = |k: u64| SplitMix64::nth((u64::from(seed) << 32) | u64::from(i) << 3 | k);
            let frequency = if i < spectrum.max_octaves() { spectrum.frequency(i) } else { 0.0 };
            let matrix = match rotation {
                Rotation::Random => random_rotation([word(1), word(2)].map(|word| (word >> 32) as u32)),
                Rotation::Aligned => identity(),
            };
            let (low, high) = (word(3), word(4));
            let mut shift = 0;
            let layer = Self {
                seed: (word(0) >> 32) as u32,
                rotation,
                matrix: matrix.map(|row: [f32; N]| row.map(|x| x * frequency)),
                cell: [0; N],
                offset: [(); N].map(|()| {
                    shift += 20;
                    if shift <= 60 { fraction(low >> (shift - 20)) } else { fraction(high) }
                }),
            };
            i += 1;
            layer
        })
    }

    /// The noise of the octave: `noise`, or `own` if the octave has its own lattice.
    #[inline(always)]
    pub(crate) fn noise<'a, K: Kernel<N>>(&self, noise: &'a K, own: &'a mut Option<K>) -> &'a K {
        // Sums on tileable lattices are aligned, and other lattices ignore the frequency.
        *own = noise.of_octave(self.matrix[0][0], &self.cell);
        own.as_ref().unwrap_or(noise)
    }

    /// The octave's map, the same in every lane.
    #[inline(always)]
    fn map<S: Lanes>(&self, s: S) -> Map<S, N> {
        let mut map =
            Map { rotation: self.rotation, matrix: [[s.float(0.0); N]; N], offset: [s.float(0.0); N] };
        for row in 0..N {
            map.offset[row] = s.float(self.offset[row]);
            for k in 0..N {
                map.matrix[row][k] = s.float(self.matrix[row][k]);
            }
        }
        map
    }

    /// The octave's own coordinates of points.
    #[inline(always)]
    pub(crate) fn points<S: Lanes>(&self, s: S, p: [S::F; N]) -> [S::F; N] {
        self.map(s).points(p)
    }

    /// Mᵀ g: rotates a gradient back to the coordinates of the sum.
    #[inline(always)]
    pub(crate) fn pull_back<S: Lanes>(&self, s: S, g: [S::F; N]) -> [S::F; N] {
        self.map(s).pull_back(g)
    }

    /// The frequency along each axis of an aligned layer.
    #[inline(always)]
    pub(crate) fn frequencies(&self) -> [f32; N] {
        let mut frequencies = self.offset;
        for axis in 0..N {
            frequencies[axis] = self.matrix[axis][axis];
        }
        frequencies
    }

    /// sum + factor · sample, with the gradient rotated back.
    #[inline(always)]
    pub(crate) fn accumulate<S: Lanes>(
        &self,
        s: S,
        sum: &mut LaneSample<S, N>,
        factor: S::F,
        (value, gradient): LaneSample<S, N>,
    ) {
        sum.0 = sum.0 + factor * value;
        let gradient = self.pull_back(s, gradient);
        for axis in 0..N {
            sum.1[axis] = sum.1[axis] + factor * gradient[axis];
        }
    }
}

/// The affine map into an octave in each lane.
pub(crate) struct Map<S: Lanes, const N: usize> {
    rotation: Rotation,
    matrix: [[S::F; N]; N],
    offset: [S::F; N],
}

impl<S: Lanes, const N: usize> Map<S, N> {
    /// The octave's own coordinates of points.
    #[inline(always)]
    pub(crate) fn points(&self, p: [S::F; N]) -> [S::F; N] {
        let mut q = self.product::<false>(p);
        for axis in 0..N {
            q[axis] = q[axis] + self.offset[axis];
        }
        q
    }

    /// M v: a direction in the octave's own coordinates.
    #[inline(always)]
    pub(crate) fn directions(&self, v: [S::F; N]) -> [S::F; N] {
        self.product::<false>(v)
    }

    /// Mᵀ g: rotates a gradient back to the coordinates of the sum.
    #[inline(always)]
    pub(crate) fn pull_back(&self, g: [S::F; N]) -> [S::F; N] {
        self.product::<true>(g)
    }

    /// M v, or Mᵀ v if `TRANSPOSED`; skips entries off the diagonal in an aligned layer, which are
    /// 0.
    #[inline(always)]
    fn product<const TRANSPOSED: bool>(&self, v: [S::F; N]) -> [S::F; N] {
        let mut product = v;
        if self.rotation == Rotation::Aligned {
            for axis in 0..N {
                product[axis] = self.matrix[axis][axis] * v[axis];
            }
            return product;
        }
        for row in 0..N {
            for k in 0..N {
                let entry = if TRANSPOSED { self.matrix[k][row] } else { self.matrix[row][k] };
                let part = entry * v[k];
                product[row] = if k == 0 { part } else { product[row] + part };
            }
        }
        product
    }
}

/// The affine map into the lattice of an octave, and the key for its random words.
///
/// ```text
/// nᵢ(p) = n(M p + o),   its words those of the lattice at cell + ⌊M p + o⌋ mod 2³²
/// ```
///
/// Octaves of a tileable noise also have their own periods, which are not part of this struct.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Octave<const N: usize> {
    /// M, rotation times frequency, by rows, in cells of the octave per unit of the sum's
    /// coordinates.
    pub(crate) matrix: [[f32; N]; N],
    /// o in cells; NaN if an anchor is too far away, and the octave is 0.
    pub(crate) offset: [f32; N],
    /// The origin of the cells: 0, or the cell of the anchor modulo 2³².
    pub(crate) cell: [i32; N],
    /// Key that the lattice derives from the octave's seed.
    pub(crate) key: u32,
}

/// The layers of all octaves of a sum, stored as one array per component.
///
/// Layers beyond the spectrum's maximum exist and are unused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layers<C: Dimension> {
    pub(crate) rotation: Rotation,
    seeds: [u32; OCTAVES],
    /// The keys that the lattice derives from the seeds.
    keys: [u32; OCTAVES],
    matrix: C::Each<C::Each<[f32; OCTAVES]>>,
    offset: C::Each<[f32; OCTAVES]>,
    cell: [C::Each<i32>; OCTAVES],
}

const OCTAVES: usize = MAX_OCTAVES as usize;

impl<const N: usize> Layers<[f32; N]> {
    /// The layers of octaves of a noise.
    pub(crate) fn of<K: Kernel<N>>(noise: &K, layers: &[Layer<N>; OCTAVES]) -> Self {
        let mut keys = [0; OCTAVES];
        for i in 0..OCTAVES {
            keys[i] = noise.key(layers[i].seed);
        }
        Self::with_keys(layers, keys)
    }

    fn with_keys(layers: &[Layer<N>; OCTAVES], keys: [u32; OCTAVES]) -> Self {
        let mut all = Self {
            rotation: layers[0].rotation,
            seeds: [0; OCTAVES],
            keys,
            matrix: [[[0.0; OCTAVES]; N]; N],
            offset: [[0.0; OCTAVES]; N],
            cell: [[0; N]; OCTAVES],
        };
        for (i, layer) in layers.iter().enumerate() {
            (all.seeds[i], all.cell[i]) = (layer.seed, layer.cell);
            for row in 0..N {
                all.offset[row][i] = layer.offset[row];
                for k in 0..N {
                    all.matrix[row][k][i] = layer.matrix[row][k];
                }
            }
        }
        all
    }

    /// Returns a layer by its number, or the last for larger numbers.
    #[inline(always)]
    pub(crate) fn layer(&self, i: usize) -> Layer<N> {
        let i = i % OCTAVES;
        let mut layer = Layer {
            seed: self.seeds[i],
            rotation: self.rotation,
            matrix: [[0.0; N]; N],
            offset: [0.0; N],
            cell: self.cell[i],
        };
        for row in 0..N {
            layer.offset[row] = self.offset[row][i];
            for k in 0..N {
                layer.matrix[row][k] = self.matrix[row][k][i];
            }
        }
        layer
    }

    /// Returns an octave by its number; numbers beyond the last wrap.
    pub(crate) fn octave(&self, i: usize) -> Octave<N> {
        let Layer { matrix, offset, cell, .. } = self.layer(i);
        Octave { matrix, offset, cell, key: self.keys[i % OCTAVES] }
    }

    /// All layers, one after the other.
    #[inline(always)]
    pub(crate) fn iter(&self) -> impl Iterator<Item = Layer<N>> {
        (0..OCTAVES).map(|i| self.layer(i))
    }

    /// The first octaves at a point given in the coordinates of every octave.
    pub(crate) const fn octaves_at<'a>(
        &'a self,
        points: &'a [[f32; OCTAVES]; N],
        count: usize,
    ) -> OctavesAt<'a, N> {
        OctavesAt { points, seeds: &self.seeds, keys: &self.keys, count }
    }

    /// A point in the coordinates of every octave.
    #[inline]
    pub(crate) fn points(&self, p: [f32; N]) -> [[f32; OCTAVES]; N] {
        let mut points = [[0.0; OCTAVES]; N];
        for axis in 0..N {
            points[axis] = [p[axis]; OCTAVES];
        }
        points = self.products::<false>(&points);
        for axis in 0..N {
            for i in 0..OCTAVES {
                points[axis][i] += self.offset[axis][i];
            }
        }
        points
    }

    /// The maps of a register of octaves from `first` on.
    #[inline(always)]
    pub(crate) fn lanes<S: Lanes>(&self, s: S, first: usize) -> Map<S, N> {
        let mut map =
            Map { rotation: self.rotation, matrix: [[s.float(0.0); N]; N], offset: [s.float(0.0); N] };
        for row in 0..N {
            map.offset[row] = s.load(self.offset[row].get(first..).unwrap_or_default());
            for k in 0..N {
                map.matrix[row][k] = s.load(self.matrix[row][k].get(first..).unwrap_or_default());
            }
        }
        map
    }

    /// The keys of a register of octaves from `first` on.
    #[inline(always)]
    pub(crate) fn keys<S: Lanes>(&self, s: S, first: usize) -> S::U {
        s.load_words(self.keys.get(first..).unwrap_or_default())
    }

    /// Mᵀ g of every octave.
    #[inline]
    pub(crate) fn pulled_back(&self, gradients: &[[f32; OCTAVES]; N]) -> [[f32; OCTAVES]; N] {
        self.products::<true>(gradients)
    }

    /// M v of every octave, or Mᵀ v if `TRANSPOSED`; skips entries off the diagonal in an aligned
    /// layer, which are 0.
    #[inline(always)]
    fn products<const TRANSPOSED: bool>(&self, v: &[[f32; OCTAVES]; N]) -> [[f32; OCTAVES]; N] {
        let mut products = [[0.0; OCTAVES]; N];
        for row in 0..N {
            let aligned = self.rotation == Rotation::Aligned;
            for k in if aligned { row..row + 1 } else { 0..N } {
                let entries = if TRANSPOSED { &self.matrix[k][row] } else { &self.matrix[row][k] };
                for i in 0..OCTAVES {
                    let part = entries[i] * v[k][i];
                    products[row][i] = if k == 0 || aligned { part } else { products[row][i] + part };
                }
            }
        }
        products
    }
}

/// Twenty bits of a word as a multiple of 2⁻²⁰ in [0, 1).
fn fraction(word: u64) -> f32 {
    (word & 0xf_ffff) as f32 / 1_048_576.0
}

fn identity<const N: usize>() -> [[f32; N]; N] {
    let mut i = 0;
    [[0.0; N]; N].map(|mut row| {
        row[i] = 1.0;
        i += 1;
        row
    })
}

/// A rotation uniform over all rotations in N dimensions, N ≤ 4.
///
/// In 3-D a unit quaternion q acts by v ↦ q v q̄. In 4-D two act by v ↦ p v q̄.
fn random_rotation<const N: usize>([first, second]: [u32; 2]) -> [[f32; N]; N] {
    let unit = |word: u32| unit_direction::<Scalar, 4>(Scalar, Scalar.word(word), 1.0);
    let mut matrix = identity::<N>();
    match N {
        1 => {}
        2 => {
            let [c, s] = unit_direction::<Scalar, 2>(Scalar, Scalar.word(first), 1.0);
            copy(&mut matrix, &[[c, -s], [s, c]]);
        }
        3 => {
            let [x, y, z, w] = gaussian_quaternion(first);
            let s = 2.0 / (x * x + y * y + z * z + w * w);
            copy(
                &mut matrix,
                &[
                    [1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
                    [s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)],
                    [s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)],
                ],
            );
        }
        _ => {
            let [[a, b, c, d], [p, q, r, t]] = [unit(first), unit(second)];
            let left = [[a, -b, -c, -d], [b, a, -d, c], [c, d, a, -b], [d, -c, b, a]];
            let right = [[p, -q, -r, -t], [q, p, t, -r], [r, -t, p, q], [t, r, -q, p]];
            let entry = |i: usize, j: usize| (0..4).fold(0.0, |sum, k| sum + left[i][k] * right[k][j]);
            copy(&mut matrix, &[0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| entry(i, j))));
        }
    }
    matrix
}

fn copy<const N: usize, const M: usize>(to: &mut [[f32; N]; N], from: &[[f32; M]; M]) {
    for (to, from) in to.iter_mut().flatten().zip(from.iter().flatten()) {
        *to = *from;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::abs_diff_eq;

    fn is_rotation<const N: usize>() {
        for seed in 0..32 {
            for layer in Layer::<N>::all(&FbmSpectrum::default(), Rotation::Random, seed).iter().take(3) {
                let (m, square) = (layer.matrix, layer.matrix[0].iter().map(|x| x * x).sum::<f32>());
                for i in 0..N {
                    for j in 0..N {
                        let dot: f32 = (0..N).map(|k| m[i][k] * m[j][k]).sum();
                        let expected = if i == j { square } else { 0.0 };
                        assert!(
                            abs_diff_eq!(dot, expected, epsilon = 3e-6 * square),
                            "{N}-D, seed {seed}: {dot}"
                        );
                    }
                }
                assert!(layer.offset.iter().all(|x| (0.0..1.0).contains(x)));
            }
        }
    }

    #[test]
    fn layers_are_rotated() {
        is_rotation::<1>();
        is_rotation::<2>();
        is_rotation::<3>();
        is_rotation::<4>();
    }

    #[test]
    fn aligned_layers_are_scaled() {
        let [first, second, ..] = Layer::<3>::all(&FbmSpectrum::default(), Rotation::Aligned, 1);
        assert_eq!(first.matrix, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        assert_eq!(second.matrix[1], [0.0, 2.17, 0.0]);
        assert_ne!((first.seed, first.offset), (second.seed, second.offset));
        assert_eq!(
            Layer { rotation: Rotation::Random, ..first }.points(Scalar, [1.5, 2.0, -3.0]),
            first.points(Scalar, [1.5, 2.0, -3.0])
        );
    }
}
