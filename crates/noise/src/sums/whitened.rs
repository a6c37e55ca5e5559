//! The whitened gradients of the octaves of Gaussian noise at a point.

use asperity_core::lanes::Task;

use crate::{
    contract::compiled::{in_dimension, is_compiled},
    contract::kernel::within_reach,
    kinds::cell::at_ends::parts_of_groups,
    kinds::cell::corner::CellNoise,
    kinds::cell::gradient_covariance::whitened,
    kinds::cell::kernel::parts,
    kinds::gaussian::GaussianNoise,
    lanes::level::run_at_point,
    lanes::{LANES, Lanes, Scalar, lane_of, splat},
    lattice::lattice::{IS_FULL, Lattice, REACH, cell, is_within},
    sums::octave::Layers,
    sums::spectrum::MAX_OCTAVES,
};

const OCTAVES: usize = MAX_OCTAVES as usize;

/// The whitened gradients of the first octaves at a point.
pub(crate) struct Whitening<'a, const N: usize> {
    pub(crate) layers: &'a Layers<[f32; N]>,
    pub(crate) p: [f32; N],
    pub(crate) tangents: [[f32; N]; 2],
    pub(crate) count: usize,
    /// Both components of every octave, 0 where the tangents or the point are invalid.
    pub(crate) z: &'a mut [[f32; OCTAVES]; 2],
}

impl<const N: usize> Whitening<'_, N> {
    #[inline]
    pub(crate) fn run<L: Lattice>(mut self, noise: &GaussianNoise<L>) {
        if const { IS_FULL && is_compiled::<L>(N) } {
            return (form::<N>().0)(&mut self, &CellNoise::<N>::standard(noise));
        }
        self.at_best(noise);
    }

    #[inline(always)]
    fn at_best<L: Lattice>(&mut self, noise: &GaussianNoise<L>) {
        if run_at_point(InLanes(self, noise)).is_none() {
            InLanes(self, noise).run(Scalar);
        }
    }
}

/// The evaluation on the standard lattice, compiled in this crate for up to three dimensions.
struct Form<const N: usize>(fn(&mut Whitening<'_, N>, &GaussianNoise));

#[inline(always)]
fn form<const N: usize>() -> &'static Form<N> {
    static LINE: Form<1> = Form::OF_CRATE;
    static PLANE: Form<2> = Form::OF_CRATE;
    static SPACE: Form<3> = Form::OF_CRATE;
    in_dimension::<_, N>([&LINE, &PLANE, &SPACE]).unwrap_or(const { &Form(|_, _| ()) })
}

impl<const N: usize> Form<N> {
    const OF_CRATE: Self = Self(if IS_FULL { |octaves, noise| octaves.at_best(noise) } else { |_, _| () });
}

struct InLanes<'a, 'b, L, const N: usize>(&'a mut Whitening<'b, N>, &'a GaussianNoise<L>);

impl<L: Lattice, const N: usize> Task for InLanes<'_, '_, L, N> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self(&mut Whitening { layers, p: at, tangents: [u, v], count, ref mut z }, noise) = self;
        for first in (0..count.min(OCTAVES)).step_by(S::LEN) {
            let octaves = layers.lanes(s, first);
            let mut p = octaves.points(splat(s, at));
            let mut known = None;
            if !is_within(s, &p, REACH) {
                let (near, lanes) = within_reach(s, p, REACH);
                (p, known) = (near, Some(lanes));
            }
            let gradient = gradients(s, noise, layers, p, first, count - first);
            let tangents = [octaves.directions(splat(s, u)), octaves.directions(splat(s, v))];
            for axis in 0..N {
                p[axis] = cell(s, p[axis]).1;
            }
            for (z, mut lanes) in z.iter_mut().zip(whitened(s, p, gradient, tangents)) {
                if let Some(known) = known {
                    lanes = s.keep(known, lanes);
                }
                let is_finite = s.at_or_below(s.abs(lanes), s.float(f32::MAX));
                s.store(s.keep(is_finite, lanes), z.get_mut(first..).unwrap_or_default());
            }
        }
    }
}

/// The gradients of a register of octaves from `first` on, `count` of which are used.
#[inline(always)]
fn gradients<S: Lanes, L: Lattice, const N: usize>(
    s: S,
    noise: &GaussianNoise<L>,
    layers: &Layers<[f32; N]>,
    p: [S::F; N],
    first: usize,
    count: usize,
) -> [S::F; N] {
    let keys = layers.keys(s, first);
    if S::LEN > 1 && L::SHARED && (N == 1 || 2 * count > S::LEN) {
        return parts::<_, S::Keyed, N, true>(s.keyed(keys), noise, p, 0).0.1;
    }
    let mut gradients = [[0.0; LANES]; N];
    if S::LEN > 1 && L::SHARED {
        // Four lanes for each octave, one per corner of a face.
        let groups = S::LEN / 4;
        for start in (0..count).step_by(groups) {
            let mut at = p;
            for axis in 0..N {
                at[axis] = s.floats(
                    #[inline(always)]
                    |lane| s.lane(p[axis], (start + lane / 4) % S::LEN),
                );
            }
            let keys = s.words(
                #[inline(always)]
                |lane| s.lane_word(keys, (start + lane / 4) % S::LEN),
            );
            let (_, gradient) = parts_of_groups(s.keyed(keys), noise, at, 0).0;
            for axis in 0..N {
                for group in 0..groups {
                    gradients[axis][(start + group) % LANES] = s.lane(gradient[axis], 4 * group);
                }
            }
        }
    } else {
        let mut own = None;
        for lane in 0..count.min(S::LEN) {
            let layer = layers.layer(first + lane);
            let octave = layer.noise(noise, &mut own);
            let (_, gradient) =
                parts::<_, Scalar, N, true>(Scalar, octave, lane_of(s, &p, lane), layer.seed).0;
            for axis in 0..N {
                gradients[axis][lane % LANES] = gradient[axis];
            }
        }
    }
    let mut lanes = p;
    for axis in 0..N {
        lanes[axis] = s.load(&gradients[axis]);
    }
    lanes
}
