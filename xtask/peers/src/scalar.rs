//! Makes every form of evaluation out of a function of one point, as a user of the library would.

use std::hint::black_box;

use crate::{
    inputs::{self, DIFFERENCE, Grid, POINTS},
    level::Level,
    measure::Contender,
    row::Form,
};

/// The float that a library computes in.
pub(crate) trait Real: Copy + From<f32> + 'static {}

impl Real for f32 {}
impl Real for f64 {}

/// A library that has values only; where gradients are asked for, forward differences of N + 1 calls.
pub(crate) fn values<T: Real, const N: usize>(
    library: &'static str,
    form: Form,
    step: f32,
    f: impl Fn([T; N]) -> f32 + 'static,
) -> Contender {
    // What a library is set up with is not known to the optimiser, as it would not be in a program.
    let f = black_box(f);
    match form {
        Form::Grid => grid(library, step, f),
        Form::Points => points(library, f),
        Form::Calls => calls(library, f),
        Form::GridGradients | Form::PointsGradients | Form::CallsGradients => {
            gradients(library, form, step, move |p: [T; N], moved: [T; N]| {
                let value = f(p);
                let slope = std::array::from_fn(|axis| {
                    let mut q = p;
                    q[axis] = moved[axis];
                    (f(q) - value) * (1.0 / DIFFERENCE)
                });
                (value, slope)
            })
        }
    }
}

/// A library that has gradients of its own.
pub(crate) fn derivatives<T: Real, const N: usize>(
    library: &'static str,
    form: Form,
    step: f32,
    f: impl Fn([T; N]) -> (f32, [f32; N]) + 'static,
) -> Contender {
    let f = black_box(f);
    gradients(library, form, step, move |p, _| f(p))
}

/// `f` is given a point and the coordinates of its neighbours one difference further along each axis.
fn gradients<T: Real, const N: usize>(
    library: &'static str,
    form: Form,
    step: f32,
    f: impl Fn([T; N], [T; N]) -> (f32, [f32; N]) + 'static,
) -> Contender {
    let at = move |p: [f32; N]| f(p.map(T::from), p.map(|x| T::from(x + DIFFERENCE)));
    if form == Form::CallsGradients {
        let points = together(inputs::points::<N>());
        let pass = move || {
            for &p in &points {
                black_box(at(p));
            }
        };
        return contender(library, POINTS, pass);
    }
    let grid = Grid::<N>::new(step);
    let samples = if form == Form::GridGradients { grid.samples() } else { POINTS };
    let mut values = vec![0.0; samples];
    let mut slopes: [Vec<f32>; N] = std::array::from_fn(|_| vec![0.0; samples]);
    let mut store = move |index: usize, (value, slope): (f32, [f32; N])| {
        values[index] = value;
        for (out, slope) in slopes.iter_mut().zip(slope) {
            out[index] = slope;
        }
    };
    if form == Form::GridGradients {
        contender(library, samples, move || {
            over(&grid, |index, p| store(index, at(p)));
            black_box(&mut store);
        })
    } else {
        let points = inputs::points::<N>();
        contender(library, samples, move || {
            (0..POINTS).for_each(|index| store(index, at(std::array::from_fn(|axis| points[axis][index]))));
            black_box(&mut store);
        })
    }
}

fn grid<T: Real, const N: usize>(
    library: &'static str,
    step: f32,
    f: impl Fn([T; N]) -> f32 + 'static,
) -> Contender {
    let grid = Grid::<N>::new(step);
    let mut values = vec![0.0; grid.samples()];
    contender(library, grid.samples(), move || {
        over(&grid, |index, p| values[index] = f(p.map(T::from)));
        black_box(&mut values);
    })
}

fn points<T: Real, const N: usize>(library: &'static str, f: impl Fn([T; N]) -> f32 + 'static) -> Contender {
    let points = inputs::points::<N>();
    let mut values = vec![0.0; POINTS];
    contender(library, POINTS, move || {
        for (index, value) in values.iter_mut().enumerate() {
            *value = f(std::array::from_fn(|axis| T::from(points[axis][index])));
        }
        black_box(&mut values);
    })
}

/// One call after the other: the result of each goes through memory, so that no two are computed together.
fn calls<T: Real, const N: usize>(library: &'static str, f: impl Fn([T; N]) -> f32 + 'static) -> Contender {
    let points = together(inputs::points::<N>()).into_iter().map(|p| p.map(T::from)).collect::<Vec<_>>();
    contender(library, POINTS, move || {
        for &p in &points {
            black_box(f(p));
        }
    })
}

fn contender(library: &'static str, samples: usize, pass: impl FnMut() + 'static) -> Contender {
    Contender { library, level: Level::Scalar, samples, pass: Box::new(pass) }
}

fn together<const N: usize>(points: [Vec<f32>; N]) -> Vec<[f32; N]> {
    (0..POINTS).map(|index| std::array::from_fn(|axis| points[axis][index])).collect()
}

/// Visits every sample of a grid, the first axis fastest.
#[inline]
fn over<const N: usize>(grid: &Grid<N>, mut visit: impl FnMut(usize, [f32; N])) {
    let row = grid.size[0];
    for start in (0..grid.samples()).step_by(row) {
        let mut rest = start / row;
        let mut p = grid.origin;
        for (x, side) in p.iter_mut().zip(grid.size).skip(1) {
            *x += (rest % side) as f32 * grid.step;
            rest /= side;
        }
        for i in 0..row {
            p[0] = grid.origin[0] + i as f32 * grid.step;
            visit(start + i, p);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{cell::Cell, rc::Rc};

    #[test]
    fn a_grid_is_visited_once_with_its_first_axis_fastest() {
        let grid = Grid { origin: [1.0, 2.0, 3.0], step: 0.5, size: [2, 3, 4] };
        let mut seen = Vec::new();
        over(&grid, |index, p| seen.push((index, p)));
        assert_eq!(seen.len(), 24);
        assert!(seen.iter().enumerate().all(|(at, (index, _))| at == *index));
        assert_eq!(seen[1].1, [1.5, 2.0, 3.0]);
        assert_eq!(seen[2].1, [1.0, 2.5, 3.0]);
        assert_eq!(seen[23].1, [1.5, 3.0, 4.5]);
    }

    #[test]
    fn differences_take_one_call_more_than_there_are_axes() {
        for (form, calls) in
            [(Form::Grid, 1), (Form::GridGradients, 4), (Form::PointsGradients, 4), (Form::CallsGradients, 4)]
        {
            let count = Rc::new(Cell::new(0));
            let counted = Rc::clone(&count);
            let mut contender = values::<f64, 3>("", form, 0.05, move |p| {
                counted.set(counted.get() + 1);
                p[0] as f32
            });
            (contender.pass)();
            assert_eq!(count.get(), calls * contender.samples, "{form:?}");
        }
    }
}
