//! Builds every evaluation form from a function of one point, as a user of the library would.

use std::{hint::black_box, ops::Add};

use crate::{
    inputs::{DIFFERENCE, Grid, POINTS, points, samples},
    measure::Contender,
    row::{Order, Row},
};

/// The float type of a library.
pub(crate) trait Real: Copy + From<f32> + Add<Output = Self> + 'static {}

impl Real for f32 {}
impl Real for f64 {}

/// Contender for a library without derivatives; gradients are forward differences of N + 1 calls.
pub(crate) fn values<T: Real, const N: usize>(
    library: &'static str,
    row: Row,
    step: f32,
    f: impl Fn([T; N]) -> f32 + 'static,
) -> Contender {
    if row.gradients {
        return derivatives(library, row, step, move |p: [T; N]| {
            let value = f(p);
            let slope = std::array::from_fn(|axis| {
                let mut moved = p;
                moved[axis] = moved[axis] + T::from(DIFFERENCE);
                (f(moved) - value) * (1.0 / DIFFERENCE)
            });
            (value, slope)
        });
    }
    let mut values = vec![0.0; samples::<N>(row.order)];
    contender(library, row, step, f, move |index, value| values[index] = value)
}

/// Contender for a library with derivatives.
pub(crate) fn derivatives<T: Real, const N: usize>(
    library: &'static str,
    row: Row,
    step: f32,
    f: impl Fn([T; N]) -> (f32, [f32; N]) + 'static,
) -> Contender {
    let mut values = vec![0.0; samples::<N>(row.order)];
    let mut slopes: [Vec<f32>; N] = std::array::from_fn(|_| values.clone());
    contender(library, row, step, f, move |index, (value, slope): (f32, [f32; N])| {
        values[index] = value;
        for (out, slope) in slopes.iter_mut().zip(slope) {
            out[index] = slope;
        }
    })
}

fn contender<T: Real, R, const N: usize>(
    library: &'static str,
    row: Row,
    step: f32,
    f: impl Fn([T; N]) -> R + 'static,
    mut store: impl FnMut(usize, R) + 'static,
) -> Contender {
    // Hide the configuration from the optimizer, because it is not constant in a real program.
    let f = black_box(f);
    let points = points::<N>();
    let at = move |index: usize| std::array::from_fn(|axis| T::from(points[axis][index]));
    let pass: Box<dyn FnMut()> = match row.order {
        Order::Grid => {
            let grid = Grid::<N>::new(step);
            Box::new(move || {
                over(&grid, |index, p| store(index, f(p.map(T::from))));
                black_box(&mut store);
            })
        }
        Order::Points => Box::new(move || {
            (0..POINTS).for_each(|index| store(index, f(at(index))));
            black_box(&mut store);
        }),
        // Sequential calls: each result goes through memory, so that calls do not overlap.
        Order::Calls => {
            let points: Vec<[T; N]> = (0..POINTS).map(at).collect();
            Box::new(move || {
                for &p in &points {
                    black_box(f(p));
                }
            })
        }
    };
    Contender { library, level: "scalar", samples: samples::<N>(row.order), pass }
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
    fn grid_is_visited_once_first_axis_fastest() {
        let grid = Grid { origin: [1.0, 2.0, 3.0], step: 0.5, size: [2, 3, 4] };
        let mut seen = Vec::new();
        over(&grid, |index, p| seen.push((index, p)));
        assert_eq!(seen.len(), 24);
        assert!(seen.iter().enumerate().all(|(at, (index, _))| at == *index));
        assert_eq!([1, 2, 23].map(|k| seen[k].1), [[1.5, 2.0, 3.0], [1.0, 2.5, 3.0], [1.5, 3.0, 4.5]]);
    }

    #[test]
    fn differences_take_n_plus_one_calls() {
        for row in crate::row::all().into_iter().filter(|row| row.dimension == 3) {
            let count = Rc::new(Cell::new(0));
            let counted = Rc::clone(&count);
            let mut contender = values::<f64, 3>("", row, 0.05, move |p| {
                counted.set(counted.get() + 1);
                p[0] as f32
            });
            (contender.pass)();
            assert_eq!(count.get(), contender.samples * if row.gradients { 4 } else { 1 }, "{row}");
        }
    }
}
