//! Directions to the edges of a cube, selected by the upper bits of a lattice word.

use crate::lanes::{LANES, Lanes};

/// The searched max Σ W_c max_g g·(p − c) of edge directions g and quintic weights W.
pub(crate) const EDGE_MAXIMUM: [f32; 4] = [0.5, 0.934_535_6, 1.036_353_8, 1.536_582_3];

/// √2 times cos and sin of 22.5°.
const LONG: f32 = 1.306_563;
const SHORT: f32 = 0.541_196_1;

/// The top bit of a word, the sign of a float.
const SIGN: u32 = 0x8000_0000;

/// Signed numbers from here on are in their second and in their last third.
const SECOND_THIRD: i32 = i32::MIN + 1_431_655_766;
const LAST_THIRD: i32 = SECOND_THIRD + 1_431_655_765;

/// Bit `31 − N` of a word as a sign.
#[inline(always)]
fn sign<S: Lanes, const N: u32>(s: S, word: S::U) -> S::U {
    if N == 0 { word & s.word(SIGN) } else { s.shl::<N>(word) & s.word(SIGN) }
}

/// The signs of the components of an edge direction in 3-D or 4-D, except the component that is 0.
#[derive(Clone, Copy)]
pub(crate) struct Edge<S: Lanes, const N: usize> {
    word: S::U,
    /// In 3-D, whether the direction is not the first component, and whether it is not the third.
    others: [S::M; 2],
}

impl<S: Lanes, const N: usize> Edge<S, N> {
    #[inline(always)]
    pub(crate) fn new(s: S, word: S::U) -> Self {
        let third = s.shl::<3>(word);
        let first = s.signed_less(s.word((SECOND_THIRD - 1) as u32), third);
        Self { word, others: [first, s.signed_less(third, s.word(LAST_THIRD as u32))] }
    }

    /// A component times `x`.
    #[inline(always)]
    pub(crate) fn times(&self, s: S, axis: usize, x: S::F) -> S::F {
        let signed = s.flip(
            x,
            match axis {
                0 => sign::<S, 0>(s, self.word),
                1 => sign::<S, 1>(s, self.word),
                2 => sign::<S, 2>(s, self.word),
                _ => sign::<S, 3>(s, self.word),
            },
        );
        let [first, third] = self.others;
        if N == 4 {
            let none = s.equal(self.word & s.word(3 << 26), s.word((axis as u32) << 26));
            return s.drop(none, signed);
        }
        match axis {
            0 => s.keep(first, signed),
            1 => s.drop(s.both(first, third), signed),
            _ => s.keep(third, signed),
        }
    }
}

/// A length of directions, and the directions of 2-D times it: both components by index, twice.
pub(crate) struct Lengths {
    length: f32,
    plane: [[f32; LANES]; 2],
}

impl Lengths {
    pub(crate) const fn new(length: f32) -> Self {
        let mut plane = [[0.0; LANES]; 2];
        let mut i = 0;
        while i < LANES {
            let [x, y, ..] = edges_2()[i % 8];
            (plane[0][i], plane[1][i]) = (x * length, y * length);
            i += 1;
        }
        Self { length, plane }
    }
}

/// A direction to an edge, times a length; one of 16, 8, 12 or 32 in 1 to 4 dimensions.
///
/// The directions are ±⅛ … ±1 in 1-D, vectors of length √2 at odd multiples of 22.5° in 2-D, (±1,
/// ±1, 0) and its rotations in 3-D, and (0, ±1, ±1, ±1) and its rotations in 4-D. They are equally
/// likely, selected by the upper four, three, 29 or six bits; in 3-D within 4e-9.
#[inline(always)]
pub(crate) fn edge_direction<S: Lanes, const N: usize>(s: S, word: S::U, lengths: &Lengths) -> [S::F; N] {
    let length = lengths.length;
    if S::TABLES && N > 1 {
        return edge_entry(s, word, length);
    }
    let one = s.float(length);
    let mut g = [one; N];
    match N {
        1 => {
            let steps = s.real(s.shr::<28>(word) & s.word(7)) + s.float(1.0);
            g[0] = s.flip(steps * s.float(length * 0.125), word & s.word(SIGN));
        }
        2 => {
            let index = s.shr::<29>(word);
            let [xs, ys] = &lengths.plane;
            if let (Some(x), Some(y)) = (s.looked_up(xs, index), s.looked_up(ys, index)) {
                (g[0], g[1]) = (x, y);
                return g;
            }
            let steep = s.signed_less(word, s.word(0));
            let [x, y] = s.exchanged(steep, s.float(LONG * length), s.float(SHORT * length));
            g[0] = s.flip(x, sign::<S, 1>(s, word));
            g[1] = s.flip(y, sign::<S, 2>(s, word));
        }
        _ => {
            let edge = Edge::<S, N>::new(s, word);
            for axis in 0..N {
                g[axis] = edge.times(s, axis, one);
            }
        }
    }
    g
}

/// g·d of a direction to an edge in 3-D, times a length.
///
/// Adds the two products that are not 0, each selected once. The sum has the bits of the sum of all
/// three except for the sign of 0.
#[inline(always)]
pub(crate) fn edge_product<S: Lanes, const N: usize>(
    s: S,
    word: S::U,
    lengths: &Lengths,
    d: &[S::F; N],
) -> S::F {
    let [first, third] = Edge::<S, 3>::new(s, word).others;
    let x = s.flip(d[0], sign::<S, 0>(s, word));
    let y = s.flip(d[1 % N], sign::<S, 1>(s, word));
    let z = s.flip(d[2 % N], sign::<S, 2>(s, word));
    let length = s.float(lengths.length);
    length * s.select(first, x, y) + length * s.select(third, z, y)
}

/// The edge directions by index: the upper bits, and in 3-D the third of the remaining bits above
/// them.
static EDGES_2: [[f32; 4]; 8] = edges_2();
static EDGES_3: [[f32; 4]; 32] = edges();
static EDGES_4: [[f32; 4]; 64] = edges();

const fn edges_2() -> [[f32; 4]; 8] {
    let mut edges = [[0.0; 4]; 8];
    let mut i = 0;
    while i < 8 {
        let [x, y] = if i & 4 == 0 { [LONG, SHORT] } else { [SHORT, LONG] };
        edges[i] = [if i & 2 == 0 { x } else { -x }, if i & 1 == 0 { y } else { -y }, 0.0, 0.0];
        i += 1;
    }
    edges
}

/// Signs by the bits of the index from the upper bits down, after the axis in 3-D, before it in
/// 4-D.
const fn edges<const COUNT: usize>() -> [[f32; 4]; COUNT] {
    let mut edges = [[0.0; 4]; COUNT];
    let mut i = 0;
    while i < COUNT {
        let (dimensions, none, signs) = if COUNT == 64 { (4, i & 3, i >> 2) } else { (3, i >> 3, i & 7) };
        let mut axis = 0;
        while axis < dimensions {
            let sign = if signs >> (dimensions - 1 - axis) & 1 == 0 { 1.0 } else { -1.0 };
            edges[i][axis] = if none == axis { 0.0 } else { sign };
            axis += 1;
        }
        i += 1;
    }
    edges
}

/// [`edge_direction`] from a table.
#[inline(always)]
fn edge_entry<S: Lanes, const N: usize>(s: S, word: S::U, length: f32) -> [S::F; N] {
    let word = s.lane_word(word, 0);
    let third = (u64::from(word << 3 ^ SIGN) * 3) >> 32;
    let entry = match N {
        2 => EDGES_2[(word >> 29) as usize],
        3 => EDGES_3[((third as u32) << 3 | word >> 29) as usize & 31],
        _ => EDGES_4[(word >> 26) as usize],
    };
    let mut g = [s.float(0.0); N];
    for axis in 0..N {
        g[axis] = s.float(entry[axis % 4] * length);
    }
    g
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Arithmetic, Scalar};
    use asperity_core::{SplitMix64, lanes::Task};

    use crate::lanes::level::Level;
    use approx::assert_abs_diff_eq;

    /// Runs the `const` functions at run time.
    #[test]
    fn tables_hold_every_direction_once() {
        let plane = edges_2();
        for (i, [x, y, z, w]) in plane.into_iter().enumerate() {
            // √2 times the sine and cosine of 22.5°.
            let far = [x, y].map(|x| f64::from(x.abs()) / core::f64::consts::SQRT_2);
            let expected = if i < 4 {
                [0.923_879_532_511, 0.382_683_432_365]
            } else {
                [0.382_683_432_365, 0.923_879_532_511]
            };
            assert_abs_diff_eq!(far[0], expected[0], epsilon = 1e-7);
            assert_abs_diff_eq!(far[1], expected[1], epsilon = 1e-7);
            assert_eq!((z, w), (0.0, 0.0));
        }
        let lengths = Lengths::new(0.7);
        for (k, [x, y, ..]) in plane.into_iter().cycle().take(LANES).enumerate() {
            assert_eq!([lengths.plane[0][k], lengths.plane[1][k]], [0.7 * x, 0.7 * y]);
        }
        // In 3-D the fourth third is never looked up.
        let (space, hyperspace) = (edges::<32>(), edges::<64>());
        let zeros = |edge: &[f32; 4]| edge.iter().filter(|&&x| x == 0.0).count();
        assert!(space[..24].iter().all(|edge| zeros(edge) == 2 && edge[3] == 0.0));
        assert!(hyperspace.iter().all(|edge| zeros(edge) == 1));
        for edges in [&plane[..], &space[..24], &hyperspace[..]] {
            // Both signs of a component that is 0 give the same direction.
            let twice = edges.len() / 8 != 1;
            for edge in edges {
                let again = edges.iter().filter(|&other| other == edge).count();
                assert_eq!(again, if twice { 2 } else { 1 }, "{edge:?}");
                let mirrored = edge.map(|x| -x);
                assert!(edges.contains(&mirrored), "{edge:?}");
            }
        }
    }

    /// Words at both ends of every third, and others.
    fn words() -> impl Iterator<Item = u32> {
        let thirds =
            [0, SECOND_THIRD, LAST_THIRD].into_iter().flat_map(|third| [third - 1, third].map(|x| x as u32));
        let ends = thirds.flat_map(|third| {
            (0..8).flat_map(move |signs| [0, 1].map(|k| ((third >> 3) + k) | (signs << 29)))
        });
        ends.chain((0..10_000).map(|counter| SplitMix64::nth(counter) as u32)).chain([0, u32::MAX])
    }

    fn gradient<const N: usize>(word: u32) -> [f32; N] {
        edge_direction(Scalar, Scalar.word(word), &const { Lengths::new(1.0) })
    }

    fn scalar_product<const N: usize>(a: [f32; N], b: [f32; N]) -> f64 {
        a.iter().zip(b).map(|(&a, b)| f64::from(a) * f64::from(b)).sum()
    }

    #[test]
    fn directions_have_their_lengths() {
        for word in words() {
            let [plane, space, hyperspace] = [
                scalar_product(gradient::<2>(word), gradient::<2>(word)),
                scalar_product(gradient::<3>(word), gradient::<3>(word)),
                scalar_product(gradient::<4>(word), gradient::<4>(word)),
            ];
            assert_abs_diff_eq!(plane, 2.0, epsilon = 3e-7);
            assert_eq!([space, hyperspace], [2.0, 3.0]);
        }
    }

    #[test]
    fn edge_components_match_table() {
        fn compared<const N: usize>(word: u32) {
            let edge = Edge::<Scalar, N>::new(Scalar, Scalar.word(word));
            for (axis, expected) in gradient::<N>(word).into_iter().enumerate() {
                assert_eq!(edge.times(Scalar, axis, 1.5), 1.5 * expected, "{word:x}, axis {axis}");
            }
        }
        for word in words() {
            compared::<3>(word);
            compared::<4>(word);
        }
    }

    /// Compares directions and products in the last lane with a single lane.
    struct InLanes;

    impl Task for InLanes {
        type Output = ();

        fn run<S: Lanes>(self, s: S) {
            static LENGTHS: Lengths = Lengths::new(0.7);
            let last = |x| s.lane(x, S::LEN - 1);
            for word in words() {
                let plane = edge_direction::<Scalar, 2>(Scalar, Scalar.word(word), &LENGTHS);
                assert_eq!(edge_direction::<S, 2>(s, s.word(word), &LENGTHS).map(last), plane, "{word:x}");
                let space = edge_direction::<Scalar, 3>(Scalar, Scalar.word(word), &LENGTHS);
                let d = [1.3, -0.6, 2.9];
                let sum = space[1] * d[1] + space[2] * d[2] + space[0] * d[0];
                let product = edge_product(s, s.word(word), &LENGTHS, &d.map(|x| s.float(x)));
                assert_eq!(last(product), sum, "{word:x}");
            }
        }
    }

    #[test]
    fn edge_directions_in_lanes_match_scalar() {
        for level in Level::available() {
            level.instructions().run(InLanes);
        }
    }

    #[test]
    fn directions_have_mean_zero_and_no_preferred_axis() {
        fn moments<const N: usize>(square: f64) {
            let words = || (0..10_000).map(|counter| SplitMix64::nth(counter) as u32);
            for i in 0..N {
                let mean = words().map(|w| f64::from(gradient::<N>(w)[i])).sum::<f64>() / 1e4;
                let second = words().map(|w| f64::from(gradient::<N>(w)[i]).powi(2)).sum::<f64>() / 1e4;
                // 5 standard errors: of a mean at most √square/100, of a square at most √3
                // square/100.
                assert_abs_diff_eq!(mean, 0.0, epsilon = 0.05 * square.sqrt());
                assert_abs_diff_eq!(second, square, epsilon = 0.09 * square);
            }
        }
        moments::<2>(1.0);
        moments::<3>(2.0 / 3.0);
        moments::<4>(0.75);
    }
}
