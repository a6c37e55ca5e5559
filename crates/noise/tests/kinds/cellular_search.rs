//! Cellular noise compared with a brute-force search for feature points in `f64`.

use core::array::from_fn;

use approx::assert_abs_diff_eq;
use asperity_core::SplitMix64;
use asperity_noise::{
    Cellular, CellularOutput, Field, Grid, IntegerHash, Lattice, Metric, Point,
    glam::{Vec2, Vec3, Vec4},
    simd::{Batch, Level},
};

use super::words::{further, uniform};

const METRICS: [Metric; 3] = [Metric::Euclidean, Metric::Manhattan, Metric::Chebyshev];

/// A feature point found by a brute-force search in `f64`.
#[derive(Clone, Copy)]
struct Found<const N: usize> {
    distance: f64,
    offset: [f64; N],
    word: u32,
}

/// The three nearest feature points in all cells up to `window` away.
fn wide_search<L: Lattice, const N: usize>(
    noise: &Cellular<L>,
    (lattice, seed): (&L, u32),
    p: [f32; N],
    window: i32,
) -> [Found<N>; 3] {
    let mut nearest = [Found { distance: f64::INFINITY, offset: [0.0; N], word: 0 }; 3];
    let side = 2 * window + 1;
    for index in 0..side.pow(N as u32) {
        let cell: [i32; N] =
            from_fn(|axis| f64::from(p[axis]).floor() as i32 + index / side.pow(axis as u32) % side - window);
        let word = lattice.word(cell, seed);
        let second = further(word, 1);
        let fields = [word >> 16, word & 0xffff, second >> 16, second & 0xffff];
        let offset: [f64; N] = from_fn(|axis| {
            let u = (f64::from(fields[axis]) + 0.5) / 65_536.0;
            f64::from(p[axis]) - (f64::from(cell[axis]) + 0.5 + f64::from(noise.jitter()) * (u - 0.5))
        });
        let distance = match noise.metric() {
            Metric::Euclidean => offset.iter().map(|d| d * d).sum::<f64>().sqrt(),
            Metric::Manhattan => offset.iter().map(|d| d.abs()).sum(),
            Metric::Chebyshev => offset.iter().fold(0.0, |largest, d| d.abs().max(largest)),
        };
        let rank = nearest.iter().position(|other| distance < other.distance);
        if let Some(rank) = rank {
            nearest[rank..].rotate_right(1);
            nearest[rank] = Found { distance, offset, word };
        }
    }
    nearest
}

/// The outputs at a point compared with a wide search.
///
/// Also compares their gradients, and the cell if no other feature point is equally near.
fn compare<V, L, const N: usize>(noise: Cellular<L>, words: (&L, u32), p: [f32; N], window: i32)
where
    V: Point<Coordinates = [f32; N]>,
    L: Lattice + Copy,
{
    let nearest = wide_search(&noise, words, p, window);
    let [first, second, third] = nearest.map(|found| found.distance);
    let what = || format!("{:?} {p:?} of jitter {}", noise.metric(), noise.jitter());
    for (basis, expected) in [
        (CellularOutput::F1, first),
        (CellularOutput::F2, second),
        (CellularOutput::F2MinusF1, second - first),
    ] {
        let noise = noise.with_output(basis);
        let sample = noise.sample(V::from_coordinates(p));
        // Offsets are rounded by up to 2.4e-7 each, and their roots by little. The largest error
        // was 7e-7.
        assert!((f64::from(sample.value) - expected).abs() < 1.5e-6, "{basis:?} {}: {sample:?}", what());
        assert_eq!(noise.value(V::from_coordinates(p)), sample.value, "{basis:?} {}", what());
        let [low, high] = Field::<V>::range(&noise);
        assert!((low..=high).contains(&sample.value), "{basis:?} {}: {sample:?}", what());
        let slope = |found: &Found<N>, axis: usize| match noise.metric() {
            Metric::Euclidean => found.offset[axis] / found.distance,
            Metric::Manhattan => found.offset[axis].signum(),
            Metric::Chebyshev if found.offset[axis].abs() == found.distance => found.offset[axis].signum(),
            Metric::Chebyshev => 0.0,
        };
        // Near creases and near feature points the last bits decide.
        let apart = |found: &Found<N>| {
            let offsets = found.offset.map(f64::abs);
            let ties = (0..N).any(|i| (0..i).any(|j| (offsets[i] - offsets[j]).abs() < 1e-5));
            offsets.iter().all(|&offset| offset > 1e-3) && !(noise.metric() == Metric::Chebyshev && ties)
        };
        let clear = second - first > 1e-5 && (basis == CellularOutput::F1 || third - second > 1e-5);
        if clear && nearest[..2].iter().all(apart) {
            for (axis, slope_here) in sample.gradient.coordinates().into_iter().enumerate() {
                let expected = match basis {
                    CellularOutput::F1 => slope(&nearest[0], axis),
                    CellularOutput::F2 => slope(&nearest[1], axis),
                    _ => slope(&nearest[1], axis) - slope(&nearest[0], axis),
                };
                // An offset of 1e-3 is rounded by 2.4e-7.
                assert_abs_diff_eq!(f64::from(slope_here), expected, epsilon = 6e-4);
            }
        }
    }
    if second - first > 1e-5 {
        let cell = noise.with_output(CellularOutput::Cell).value(V::from_coordinates(p));
        assert_eq!(cell, uniform(further(nearest[0].word, 2)), "{}", what());
    }
}

/// Random positions, a third of them next to borders, in cells near the origin and far from it.
fn random_point<const N: usize>(counter: &mut u64) -> [f32; N] {
    from_fn(|_| {
        *counter += 1;
        let word = SplitMix64::nth(*counter);
        let t = (word >> 40) as f32 / 16_777_216.0;
        let t = match word % 6 {
            0 => 1e-3 * t,
            1 => 1.0 - 1e-3 * t,
            _ => t,
        };
        ((word >> 8 & 63) as i32 - 32) as f32 + t
    })
}

fn compare_at_random<V: Point<Coordinates = [f32; N]>, const N: usize>(count: u32, window: i32) {
    for metric in METRICS {
        let mut counter = 1 << 32;
        for i in 0..count {
            let jitter = [1.0, 1.0, 1.0, 0.6, 0.25][i as usize % 5];
            let noise = Cellular::new(i).with_metric(metric).with_jitter(jitter).expect("in range");
            compare::<V, IntegerHash, N>(noise, (&IntegerHash, i), random_point(&mut counter), window);
        }
    }
}

#[test]
fn cellular_search_at_random_points() {
    compare_at_random::<f32, 1>(2000, 4);
    compare_at_random::<Vec2, 2>(2000, 4);
    compare_at_random::<Vec3, 3>(400, 4);
    compare_at_random::<Vec4, 4>(60, 4);
}

/// Grids, whose rows find their feature points together, compared with a wide search.
fn compare_grids<V: Point<Coordinates = [f32; N]>, const N: usize>(size: &V::Array<usize>, window: i32) {
    for (metric, step) in METRICS.into_iter().zip([0.05, -0.031, 0.12]) {
        for basis in [CellularOutput::F1, CellularOutput::F2] {
            let noise = Cellular::new(7).with_metric(metric).with_output(basis);
            let grid = Grid {
                origin: V::from_axes(|axis| 0.31 - 1.4 * axis as f32),
                step: V::from_axes(|axis| if axis == 0 { step } else { 0.07 }),
                size: V::array(|axis| size.as_ref()[axis]),
            };
            let mut values = vec![0.0; grid.len()];
            Batch::with_level(Level::Scalar).grid_values(&noise, &grid, &mut values).expect("one length");
            for (i, &value) in values.iter().enumerate() {
                let mut rest = i;
                let p = grid.point(V::array(|axis| {
                    let along = rest % size.as_ref()[axis];
                    rest /= size.as_ref()[axis];
                    along
                }));
                let nearest = wide_search(&noise, (&IntegerHash, 7), p.coordinates(), window);
                let expected = nearest[usize::from(basis == CellularOutput::F2)].distance;
                // As above.
                assert!((f64::from(value) - expected).abs() < 1.5e-6, "{noise:?} {p:?}");
            }
        }
    }
}

// Rows of a grid reuse their search from 256 points on.
#[test]
fn cellular_search_along_rows() {
    compare_grids::<f32, 1>(&[600], 3);
    compare_grids::<Vec2, 2>(&[70, 20], 4);
    compare_grids::<Vec3, 3>(&[40, 3, 3], 3);
    compare_grids::<Vec4, 4>(&[24, 11, 1, 1], 3);
}

/// Feature points as far from the origin as their cells allow, except in planted cells, where they
/// are as near.
#[derive(Clone, Copy)]
struct Planted<'a> {
    /// Words of feature points in each corner of a cell.
    words: &'a [u32; 16],
    cells: [[i32; 4]; 2],
}

impl Lattice for Planted<'_> {
    fn word<const N: usize>(&self, cell: [i32; N], _: u32) -> u32 {
        let near = self.cells.iter().any(|planted| planted[..N] == cell);
        let corner = (0..N).fold(0, |corner, axis| corner | usize::from((cell[axis] >= 0) != near) << axis);
        self.words[corner]
    }
}

/// Words whose feature points are within 1/16 of each corner of their cells.
fn words_of_corners() -> [u32; 16] {
    from_fn(|corner| {
        let ends = |field: u32, axis: usize| field >> 12 == if corner >> axis & 1 == 1 { 15 } else { 0 };
        let of = |axis: usize, low: u32| if corner >> axis & 1 == 1 { 0xf000 | low } else { low };
        let word = |i: u32| of(0, i >> 12) << 16 | of(1, i & 0xfff);
        let fits = |&word: &u32| {
            let second = further(word, 1);
            ends(second >> 16, 2) && ends(second & 0xffff, 3)
        };
        (0..1 << 24).map(word).find(fits).expect("a word")
    })
}

fn compare_with_planted<V: Point<Coordinates = [f32; N]>, const N: usize>(count: u32) {
    let words = words_of_corners();
    for metric in METRICS {
        let mut counter = 2 << 32;
        for i in 0..count {
            // Up to N + 1 cells away along one axis, and next to the origin or two cells away along
            // the others.
            let cells = from_fn(|k| {
                let mut next = |bound: u64| {
                    counter += 1;
                    (SplitMix64::nth(counter) >> 20) % bound
                };
                let axis = next(N as u64) as usize;
                let far = next(N as u64 + 1) as i32 + 1;
                from_fn(|other| {
                    let away = if other == axis { far } else { next(5) as i32 / 4 };
                    if k == 0 || next(2) == 0 { away } else { -1 - away }
                })
            });
            let p = from_fn(|_| {
                counter += 1;
                let t = (SplitMix64::nth(counter) >> 40) as f32 / 16_777_216.0;
                if i % 4 == 0 { t - 0.5 } else { 0.02 * t - 0.01 }
            });
            let lattice = Planted { words: &words, cells };
            let noise = Cellular::new(0).with_metric(metric).with_lattice(lattice);
            compare::<V, _, N>(noise, (&lattice, 0), p, N as i32 + 1);
        }
    }
}

#[test]
fn cellular_search_far_feature_points() {
    compare_with_planted::<f32, 1>(100);
    compare_with_planted::<Vec2, 2>(400);
    compare_with_planted::<Vec3, 3>(200);
    compare_with_planted::<Vec4, 4>(60);
}
