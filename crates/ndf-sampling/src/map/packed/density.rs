//! Densities of normals of a packed map, in stages.

use crate::map::packed::block::{Staged, Work, entries, of, of_mut, sides};
use crate::map::packed::grid::Grid;
use crate::map::packed::packed_map::PackedMapRef;
use asperity_core::lanes::Lanes;

/// `D`.
pub(crate) struct Density;

/// Numbers between its stages, in whole cache lines.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Corners<const L: usize> {
    input: [[f32; L]; 2],
    output: [[f32; L]; 2],
    /// Index of the first texel.
    at: [u32; L],
    /// The positions between these texels and the next.
    between: [[f32; L]; 2],
    texels: [[f32; 4]; L],
}

impl<const L: usize> Work<L> for Corners<L> {
    const ZERO: Self = Self {
        input: [[0.0; L]; 2],
        output: [[0.0; L]; 2],
        at: [0; L],
        between: [[0.0; L]; 2],
        texels: [[0.0; 4]; L],
    };

    #[inline(always)]
    fn input(&mut self) -> &mut [[f32; L]; 2] {
        &mut self.input
    }
    #[inline(always)]
    fn output(&self) -> &[[f32; L]; 2] {
        &self.output
    }
}

impl Staged<1> for Density {
    type Group<const L: usize> = Corners<L>;
    const FEW: usize = 12;

    #[inline(always)]
    fn apply<P: Lanes, const L: usize, const SIDES: usize>(
        map: &PackedMapRef<'_>,
        p: P,
        groups: &mut [Corners<L>],
    ) {
        for group in groups.iter_mut() {
            map.texel(p, group);
        }
        let [left, right] = sides::<SIDES>(map.texels, map.grid.texel_stride);
        for group in groups.iter_mut() {
            for k in 0..L {
                let at = group.at[k];
                if SIDES == 1 {
                    let Some(texel) = left.get(at as usize) else { continue };
                    group.output[1][k] = *texel;
                } else {
                    let (Some(left), Some(right)) = (entries(left, at), entries(right, at)) else { continue };
                    let ([a, b], [c, d]) = (*left, *right);
                    group.texels[k] = [a, b, c, d];
                }
            }
        }
        for group in groups.iter_mut() {
            values::<P, L, SIDES>(p, group);
        }
    }
}

impl PackedMapRef<'_> {
    /// The texel and the position between it and the next.
    #[inline(always)]
    fn texel<P: Lanes, const L: usize>(&self, p: P, group: &mut Corners<L>) {
        let Grid { density, origin, last, texel_stride, .. } = self.grid;
        for from in (0..L).step_by(P::LEN) {
            let mut places = [p.float(0.0); 2];
            for axis in 0..2 {
                let n = p.load(of(p, &group.input[axis], from));
                let place = p.at_least(n * p.float(density[axis]) + p.float(origin[axis]), 0.0);
                places[axis] = p.min(place, p.float(last[axis]));
            }
            let [x, y] = places;
            let (column, row) = (p.truncated(x), p.truncated(y));
            p.store_words(column * p.word(texel_stride) + row, of_mut(p, &mut group.at, from));
            p.store(x - p.real(column), of_mut(p, &mut group.between[0], from));
            p.store(y - p.real(row), of_mut(p, &mut group.between[1], from));
        }
    }
}

/// The values there.
#[inline(always)]
fn values<P: Lanes, const L: usize, const SIDES: usize>(p: P, group: &mut Corners<L>) {
    for from in (0..L).step_by(P::LEN) {
        let value = if SIDES == 1 {
            p.load(of(p, &group.output[1], from))
        } else {
            let [a, b, c, d] = p.fields4(of(p, &group.texels, from));
            let (t, q) = (p.load(of(p, &group.between[0], from)), p.load(of(p, &group.between[1], from)));
            let (begin, end) = (a + t * (c - a), b + t * (d - b));
            begin + q * (end - begin)
        };
        let (x, y) = (p.load(of(p, &group.input[0], from)), p.load(of(p, &group.input[1], from)));
        // A unit normal at the rim may be outside the disk by the rounding of its coordinates.
        let inside = p.less(x * x + y * y, p.float(1.0 + 1e-6));
        p.store(p.select(inside, value, p.float(0.0)), of_mut(p, &mut group.output[0], from));
    }
}
