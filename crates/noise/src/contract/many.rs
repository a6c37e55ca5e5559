//! Lists and grids of points, checked and evaluated at one SIMD level.

use core::ops::Range;

use asperity_core::BatchError;

use crate::{
    lanes::level::Level,
    point::Point,
    row::grid::Grid,
    row::points::{Buffer, Points, Target, buffers},
    sample::Sample,
};

/// A filler of a list or a grid.
///
/// By reference, so that the batches of one field are not compiled once more for another.
type Fill<'f, V> = &'f dyn Fn(&Points<'_, V>, Target<'_, V>);

/// The number of points per pass where coordinates are stored point by point.
const LIST: usize = 128;

/// Evaluates values at points, given a function that fills a list.
pub(crate) fn values<V: Point>(
    level: Level,
    fill: Fill<'_, V>,
    points: &[V],
    values: &mut [f32],
) -> Result<(), BatchError> {
    BatchError::check("values", points.len(), values.len())?;
    let instructions = level.instructions();
    let mut lists = buffers::<V, LIST>();
    for (points, values) in points.chunks(LIST).zip(values.chunks_mut(LIST)) {
        write::<V>(points, &mut lists);
        let stride = points.len();
        fill(&Points::buffered(&lists, stride), Target { instructions, values, gradients: None, stride });
    }
    Ok(())
}

/// Evaluates values and gradients at points, given a function that fills a list.
pub(crate) fn samples<V: Point>(
    level: Level,
    fill: Fill<'_, V>,
    points: &[V],
    samples: &mut [Sample<V>],
) -> Result<(), BatchError> {
    BatchError::check("samples", points.len(), samples.len())?;
    let instructions = level.instructions();
    let (mut lists, mut buffer) = (buffers::<V, LIST>(), Buffer::<V, LIST>::empty());
    for (points, samples) in points.chunks(LIST).zip(samples.chunks_mut(LIST)) {
        write::<V>(points, &mut lists);
        fill(&Points::buffered(&lists, points.len()), buffer.target(instructions, samples.len(), true));
        for (i, sample) in samples.iter_mut().enumerate() {
            let gradient = V::from_axes(|axis| buffer.gradients.as_ref()[axis][i]);
            *sample = Sample { value: buffer.values[i], gradient };
        }
    }
    Ok(())
}

/// Evaluates values on a grid, and gradients if there is space for them.
pub(crate) fn grid<'a, V: Point>(
    level: Level,
    fill: Fill<'_, V>,
    grid: &Grid<V>,
    values: &'a mut [f32],
    gradients: Option<V::Array<&'a mut [f32]>>,
) -> Result<(), BatchError> {
    check_all::<V>(grid.len(), values, gradients.as_ref())?;
    let (instructions, stride) = (level.instructions(), grid.width());
    fill(&Points::of_rows(grid, 0..grid.rows()), Target { instructions, values, gradients, stride });
    Ok(())
}

/// Evaluates values on rows of a grid, and gradients if there is space for them.
pub(crate) fn rows<'a, V: Point>(
    fill: Fill<'_, V>,
    grid: &Grid<V>,
    rows: Range<usize>,
    values: &'a mut [f32],
    gradients: Option<V::Array<&'a mut [f32]>>,
) -> Result<(), BatchError> {
    let rows = rows.start.min(grid.rows())..rows.end.min(grid.rows());
    let (instructions, stride) = (Level::best().instructions(), grid.width());
    check_all::<V>(rows.len() * stride, values, gradients.as_ref())?;
    fill(&Points::of_rows(grid, rows), Target { instructions, values, gradients, stride });
    Ok(())
}

/// Evaluates values at points given by one list per axis, and gradients if there is space for them.
pub(crate) fn lists<'a, V: Point>(
    level: Level,
    fill: Fill<'_, V>,
    points: V::Array<&[f32]>,
    values: &'a mut [f32],
    gradients: Option<V::Array<&'a mut [f32]>>,
) -> Result<(), BatchError> {
    points.as_ref().iter().try_for_each(|list| BatchError::check("values", list.len(), values.len()))?;
    check_all::<V>(values.len(), values, gradients.as_ref())?;
    let (instructions, stride) = (level.instructions(), values.len());
    fill(&Points::lists(points), Target { instructions, values, gradients, stride });
    Ok(())
}

/// Transposes points to one list of coordinates per axis.
#[inline]
fn write<V: Point>(points: &[V], lists: &mut V::Array<[f32; LIST]>) {
    for (i, p) in points.iter().take(LIST).enumerate() {
        for (list, x) in lists.as_mut().iter_mut().zip(p.coordinates().as_ref()) {
            list[i] = *x;
        }
    }
}

fn check_all<V: Point>(
    points: usize,
    values: &[f32],
    gradients: Option<&V::Array<&mut [f32]>>,
) -> Result<(), BatchError> {
    BatchError::check("values", points, values.len())?;
    let gradients = gradients.map(AsRef::as_ref).unwrap_or_default();
    gradients.iter().try_for_each(|component| BatchError::check("gradients", points, component.len()))
}
