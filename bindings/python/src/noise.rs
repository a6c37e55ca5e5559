//! Noises, sums and transforms as nodes of an expression, and their arrays.

use std::sync::Arc;

use asperity_fields::noise::{FbmSpectrum, Grid, Normalization, Rotation};
use asperity_fields::{
    AnyShape, At, Kind, Node, Output, Parameters, Shared, Space, Sum, list, parts, points,
};
use numpy::{PyReadonlyArray2, PyReadwriteArray1, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::batch::value_error;
use crate::parallel;

/// The number of points of one piece of work; of a grid, at least.
const PIECE: usize = 4096;

/// The number of points of one piece of a grid, at most: rows of a piece share work.
const LARGEST: usize = 1 << 16;

/// Fewer points are evaluated without starting a thread.
const SMALL: usize = 8192;

/// Flat arrays for the results: values, gradients and Hessians, the latter two if wanted.
///
/// NumPy asks for large pages, so that a fresh array is filled faster than one of Rust.
type Arrays<'py> = Vec<PyReadwriteArray1<'py, f32>>;

/// The most nested terms: every transform has a buffer on the stack.
const DEEPEST: usize = 128;

/// Deeper fields are not evaluated on the calling thread, whose stack may be small.
const SHALLOW: usize = 16;

/// The most terms, as all are evaluated at every point.
const MOST_TERMS: usize = 4096;

/// A noise, a sum of octaves, or a transform of other fields.
#[pyclass(frozen, module = "asperity._asperity")]
pub(crate) struct Field {
    node: Arc<Node>,
    /// The number of nested terms.
    depth: usize,
    /// The number of terms; a field that is used twice counts twice.
    terms: usize,
}

impl Field {
    fn node(&self) -> Arc<Node> {
        Arc::clone(&self.node)
    }

    fn new(node: Node) -> Self {
        Self { node: Arc::new(node), depth: 1, terms: 1 }
    }

    /// A transform of other fields.
    fn over<'a>(node: Node, fields: impl IntoIterator<Item = &'a Self>) -> PyResult<Self> {
        let (mut depth, mut terms) = (1, 1_usize);
        for field in fields {
            depth = depth.max(field.depth + 1);
            terms = terms.saturating_add(field.terms);
        }
        if depth > DEEPEST {
            return Err(value_error(format!(
                "a noise must have at most {DEEPEST} nested terms, got {depth}"
            )));
        }
        if terms > MOST_TERMS {
            return Err(value_error(format!("a noise must have at most {MOST_TERMS} terms, got {terms}")));
        }
        Ok(Self { node: Arc::new(node), depth, terms })
    }

    /// The sum of octaves of the field. Footprint and anchor are in units of the points.
    fn summed(&self, mut sum: Sum, period: Option<Vec<u32>>, anchor: Option<Vec<f64>>) -> PyResult<Self> {
        if self.node.is_tiled() {
            return Err(value_error("the field of a sum must not be tiled: pass `period` to the sum"));
        }
        match &*self.node {
            // The octaves of a kind have their own seeds, also at another frequency.
            Node::Frequency(field, frequency) => {
                sum.footprint *= frequency.abs();
                let anchor = anchor.map(|anchor| anchor.iter().map(|x| x * f64::from(*frequency)).collect());
                let inner = Self { node: Arc::clone(field), depth: self.depth - 1, terms: self.terms - 1 };
                let field = inner.summed(sum, period, anchor)?;
                Self::over(Node::Frequency(field.node(), *frequency), [&field])
            }
            Node::Noise { kind, sum: None, anchor: None, .. } => {
                Ok(Self::new(Node::Noise { kind: *kind, sum: Some(sum), periods: period, anchor }))
            }
            _ if period.is_some() || anchor.is_some() => {
                Err(value_error("only a sum of a kind of noise has a `period` or an `anchor`"))
            }
            _ => Self::over(Node::Sum(self.node(), sum), [self]),
        }
    }
}

#[pymethods]
impl Field {
    /// A kind of noise by name.
    #[staticmethod]
    #[pyo3(signature = (name, seed, *, period=None, anchor=None, weight=0.5, impulses=1, output="f1",
        metric="euclidean", jitter=1.0, classic=false))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn kind(
        name: &str,
        seed: u32,
        period: Option<Vec<u32>>,
        anchor: Option<Vec<f64>>,
        weight: f32,
        impulses: u32,
        output: &str,
        metric: &str,
        jitter: f32,
        classic: bool,
    ) -> PyResult<Self> {
        let parameters = Parameters { seed, weight, impulses, output, metric, jitter, classic };
        let kind = Kind::new(name, &parameters).map_err(value_error)?;
        Ok(Self::new(Node::Noise { kind, sum: None, periods: period, anchor }))
    }

    /// A sum of octaves of this field.
    #[pyo3(signature = (*, octaves, lacunarity, gain, max_octaves, shape, normalization, rotation, feedback,
        footprint, period, anchor))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn fbm(
        &self,
        octaves: Option<f32>,
        lacunarity: f32,
        gain: f32,
        max_octaves: u32,
        shape: &str,
        normalization: Option<&str>,
        rotation: &str,
        feedback: Option<f32>,
        footprint: f32,
        period: Option<Vec<u32>>,
        anchor: Option<Vec<f64>>,
    ) -> PyResult<Self> {
        let sum = Sum {
            spectrum: FbmSpectrum::new(lacunarity, gain, max_octaves).map_err(value_error)?,
            octaves: octaves.unwrap_or(f32::INFINITY),
            shape: AnyShape::new(shape).map_err(value_error)?,
            normalization: match normalization {
                None => None,
                Some("unit_variance") => Some(Normalization::UnitVariance),
                Some("unit_range") => Some(Normalization::UnitRange),
                Some(other) => {
                    return Err(value_error(format!(
                        "`normalization` must be unit_variance or unit_range, got `{other}`"
                    )));
                }
            },
            rotation: match rotation {
                "random" => Rotation::Random,
                "aligned" => Rotation::Aligned,
                other => {
                    return Err(value_error(format!("`rotation` must be random or aligned, got `{other}`")));
                }
            },
            feedback,
            footprint,
        };
        self.summed(sum, period, anchor)
    }

    fn add(&self, other: &Self) -> PyResult<Self> {
        Self::over(Node::Add(self.node(), other.node()), [self, other])
    }

    fn multiply(&self, other: &Self) -> PyResult<Self> {
        Self::over(Node::Multiply(self.node(), other.node()), [self, other])
    }

    fn blend(&self, other: &Self, weight: &Self) -> PyResult<Self> {
        Self::over(Node::Blend(self.node(), other.node(), weight.node()), [self, other, weight])
    }

    fn clamp(&self, low: f32, high: f32) -> PyResult<Self> {
        Self::over(Node::Clamp(self.node(), low, high), [self])
    }

    fn scale_bias(&self, factor: f32, offset: f32) -> PyResult<Self> {
        Self::over(Node::ScaleBias(self.node(), factor, offset), [self])
    }

    fn power(&self, exponent: u8) -> PyResult<Self> {
        Self::over(Node::Power(self.node(), exponent), [self])
    }

    fn unit(&self) -> PyResult<Self> {
        Self::over(Node::Unit(self.node()), [self])
    }

    fn at_frequency(&self, frequency: f32) -> PyResult<Self> {
        Self::over(Node::Frequency(self.node(), frequency), [self])
    }

    fn warp(&self, by: Vec<PyRef<'_, Self>>, strength: f32) -> PyResult<Self> {
        if !strength.is_finite() {
            return Err(value_error(format!("`strength` must be finite, got {strength}")));
        }
        let node = Node::Warp(self.node(), by.iter().map(|field| field.node()).collect(), strength);
        Self::over(node, by.iter().map(|field| &**field).chain([self]))
    }

    /// The field with other seeds.
    fn reseeded(&self, by: u32) -> Self {
        Self { node: Arc::new(self.node.reseeded(by)), ..*self }
    }

    /// Lower and upper bound of the values.
    fn range(&self, dimension: usize) -> PyResult<(f32, f32)> {
        fn range<const N: usize>(node: &Node) -> PyResult<(f32, f32)>
        where
            At<N>: Space<N>,
        {
            let [low, high] = node.build::<N>().map_err(value_error)?.range();
            Ok((low, high))
        }
        match dimension {
            1 => range::<1>(&self.node),
            2 => range::<2>(&self.node),
            3 => range::<3>(&self.node),
            4 => range::<4>(&self.node),
            _ => Err(dimension_error(dimension)),
        }
    }

    /// Evaluates at the rows of an array.
    fn evaluate(
        &self,
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f32>,
        results: Arrays<'_>,
        threads: Option<isize>,
    ) -> PyResult<()> {
        let dimension = points.shape()[1];
        let numbers = points.as_slice().map_err(value_error)?;
        match dimension {
            1 => evaluate::<1>(py, self, numbers, results, threads),
            2 => evaluate::<2>(py, self, numbers, results, threads),
            3 => evaluate::<3>(py, self, numbers, results, threads),
            4 => evaluate::<4>(py, self, numbers, results, threads),
            _ => Err(dimension_error(dimension)),
        }
    }

    /// Evaluates on a grid, with the first axis fastest.
    fn grid(
        &self,
        py: Python<'_>,
        size: Vec<usize>,
        step: Vec<f32>,
        origin: Vec<f32>,
        results: Arrays<'_>,
        threads: Option<isize>,
    ) -> PyResult<()> {
        match size.len() {
            1 => grid::<1>(py, self, &size, [&origin, &step], results, threads),
            2 => grid::<2>(py, self, &size, [&origin, &step], results, threads),
            3 => grid::<3>(py, self, &size, [&origin, &step], results, threads),
            4 => grid::<4>(py, self, &size, [&origin, &step], results, threads),
            dimension => Err(dimension_error(dimension)),
        }
    }
}

fn dimension_error(dimension: usize) -> PyErr {
    value_error(format!("points must have 1 to 4 coordinates, got {dimension}"))
}

fn evaluate<const N: usize>(
    py: Python<'_>,
    noise: &Field,
    numbers: &[f32],
    mut results: Arrays<'_>,
    threads: Option<isize>,
) -> PyResult<()>
where
    At<N>: Space<N>,
{
    let field = built::<N>(&noise.node, &results)?;
    let points = points::<N>(numbers);
    let pieces = points.chunks(PIECE).zip(pieces::<N>(&mut results, points.len(), PIECE)?).collect();
    let threads = parallel::count(threads)?;
    let small = points.len() <= SMALL && noise.depth <= SHALLOW;
    parallel::for_each(py, threads, small, pieces, |(points, output)| list(&*field, points, output))
}

fn grid<const N: usize>(
    py: Python<'_>,
    noise: &Field,
    size: &[usize],
    [origin, step]: [&[f32]; 2],
    mut results: Arrays<'_>,
    threads: Option<isize>,
) -> PyResult<()>
where
    At<N>: Space<N>,
{
    let field = built::<N>(&noise.node, &results)?;
    let axes = |name: &str, numbers: &[f32]| -> PyResult<At<N>> {
        let count = numbers.len();
        let message = || value_error(format!("`{name}` must have {N} numbers, got {count}"));
        numbers.try_into().map(At).map_err(|_| message())
    };
    let size: [usize; N] = size.try_into().map_err(|_| dimension_error(size.len()))?;
    let grid = Grid { origin: axes("origin", origin)?, step: axes("step", step)?, size };
    let threads = parallel::count(threads)?;
    let small = grid.len() <= SMALL && noise.depth <= SHALLOW;
    let (count, each) = parts(&grid);
    let piece = (grid.len() / (4 * threads)).clamp(PIECE, LARGEST);
    let height = if small { count.max(1) } else { piece.div_ceil(each.max(1)) };
    let starts = (0..count).step_by(height);
    let ranges = starts.map(|start| start..count.min(start + height));
    let pieces = ranges.zip(pieces::<N>(&mut results, grid.len(), height * each)?).collect();
    parallel::for_each(py, threads, small, pieces, |(range, output)| {
        asperity_fields::grid(&*field, &grid, range, output);
    })
}

fn built<const N: usize>(node: &Node, results: &Arrays<'_>) -> PyResult<Shared<N>>
where
    At<N>: Space<N>,
{
    let field = node.build::<N>().map_err(value_error)?;
    if results.len() > 2 && !field.has_hessian() {
        return Err(value_error("the field does not have Hessians"));
    }
    Ok(field)
}

/// Returns the parts of the arrays for at most `length` points each.
fn pieces<'a, const N: usize>(
    results: &'a mut Arrays<'_>,
    count: usize,
    length: usize,
) -> PyResult<impl Iterator<Item = Output<'a>>> {
    let mut arrays = [1, N, N * N].into_iter().zip(results).map(|(each, array)| {
        let array = array.as_slice_mut().map_err(value_error)?;
        match array.len() == count.saturating_mul(each) {
            true => Ok(array.chunks_mut(length.saturating_mul(each).max(1))),
            false => Err(value_error(format!("expected {each} numbers for each of {count} points"))),
        }
    });
    let mut next = || arrays.next().transpose();
    let (values, mut gradients, mut hessians) = (next()?, next()?, next()?);
    Ok(values.into_iter().flatten().map(move |values| Output {
        values,
        gradients: gradients.as_mut().and_then(Iterator::next).unwrap_or_default(),
        hessians: hessians.as_mut().and_then(Iterator::next).unwrap_or_default(),
    }))
}
