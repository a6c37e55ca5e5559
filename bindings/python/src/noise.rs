//! Noises, sums and transforms as nodes of an expression, and their arrays.

use std::sync::Arc;

use asperity_fields::noise::{FbmSpectrum, Grid, Normalization, Rotation};
use asperity_fields::{
    AnyShape, At, Kind, Node, Output, Parameters, Shared, Space, Sum, list, points, slabs,
};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::batch::value_error;
use crate::parallel;

/// The number of points of one piece of work.
const PIECE: usize = 4096;

/// Fewer points are evaluated without starting a thread.
const SMALL: usize = 8192;

/// Values, and gradients and Hessians if wanted, as flat arrays.
type Arrays<'py> =
    (Bound<'py, PyArray1<f32>>, Option<Bound<'py, PyArray1<f32>>>, Option<Bound<'py, PyArray1<f32>>>);

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

    /// Evaluates at the rows of an array. `order` 1 adds gradients, 2 gradients and Hessians.
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f32>,
        order: u8,
        threads: Option<isize>,
    ) -> PyResult<Arrays<'py>> {
        let dimension = points.shape()[1];
        let numbers = points.as_slice().map_err(value_error)?;
        match dimension {
            1 => evaluate::<1>(py, self, numbers, order, threads),
            2 => evaluate::<2>(py, self, numbers, order, threads),
            3 => evaluate::<3>(py, self, numbers, order, threads),
            4 => evaluate::<4>(py, self, numbers, order, threads),
            _ => Err(dimension_error(dimension)),
        }
    }

    /// Evaluates on a grid, with the first axis fastest.
    fn grid<'py>(
        &self,
        py: Python<'py>,
        size: Vec<usize>,
        step: Vec<f32>,
        origin: Vec<f32>,
        order: u8,
        threads: Option<isize>,
    ) -> PyResult<Arrays<'py>> {
        match size.len() {
            1 => grid::<1>(py, self, &size, &step, &origin, order, threads),
            2 => grid::<2>(py, self, &size, &step, &origin, order, threads),
            3 => grid::<3>(py, self, &size, &step, &origin, order, threads),
            4 => grid::<4>(py, self, &size, &step, &origin, order, threads),
            dimension => Err(dimension_error(dimension)),
        }
    }
}

fn dimension_error(dimension: usize) -> PyErr {
    value_error(format!("points must have 1 to 4 coordinates, got {dimension}"))
}

fn evaluate<'py, const N: usize>(
    py: Python<'py>,
    noise: &Field,
    numbers: &[f32],
    order: u8,
    threads: Option<isize>,
) -> PyResult<Arrays<'py>>
where
    At<N>: Space<N>,
{
    let field = built::<N>(&noise.node, order)?;
    let points = points::<N>(numbers);
    let mut buffers = Buffers::new::<N>(points.len(), order)?;
    let pieces = points.chunks(PIECE).zip(buffers.pieces::<N>(PIECE)).collect();
    let threads = parallel::count(threads)?;
    let small = points.len() <= SMALL && noise.depth <= SHALLOW;
    parallel::for_each(py, threads, small, pieces, |(points, output)| {
        list(&*field, points, output);
    })?;
    Ok(buffers.into_arrays(py))
}

fn grid<'py, const N: usize>(
    py: Python<'py>,
    noise: &Field,
    size: &[usize],
    step: &[f32],
    origin: &[f32],
    order: u8,
    threads: Option<isize>,
) -> PyResult<Arrays<'py>>
where
    At<N>: Space<N>,
{
    let field = built::<N>(&noise.node, order)?;
    let axes = |name: &str, numbers: &[f32]| -> PyResult<At<N>> {
        let count = numbers.len();
        let message = || value_error(format!("`{name}` must have {N} numbers, got {count}"));
        numbers.try_into().map(At).map_err(|_| message())
    };
    let size: [usize; N] = size.try_into().map_err(|_| dimension_error(size.len()))?;
    let grid = Grid { origin: axes("origin", origin)?, step: axes("step", step)?, size };
    let mut buffers = Buffers::new::<N>(grid.len(), order)?;
    let threads = parallel::count(threads)?;
    let small = grid.len() <= SMALL && noise.depth <= SHALLOW;
    let slab = size[..N - 1].iter().product::<usize>().max(1);
    let height = if small { size[N - 1].max(1) } else { PIECE.div_ceil(slab) };
    let starts = (0..size[N - 1]).step_by(height);
    let pieces = starts.map(|start| start..size[N - 1].min(start + height));
    let pieces = pieces.zip(buffers.pieces::<N>(height * slab)).collect();
    parallel::for_each(py, threads, small, pieces, |(part, output)| slabs(&*field, &grid, part, output))?;
    Ok(buffers.into_arrays(py))
}

fn built<const N: usize>(node: &Node, order: u8) -> PyResult<Shared<N>>
where
    At<N>: Space<N>,
{
    let field = node.build::<N>().map_err(value_error)?;
    if order > 1 && !field.has_hessian() {
        return Err(value_error("the field does not have Hessians"));
    }
    Ok(field)
}

/// Space for results.
struct Buffers {
    values: Vec<f32>,
    gradients: Vec<f32>,
    hessians: Vec<f32>,
    order: u8,
}

impl Buffers {
    fn new<const N: usize>(count: usize, order: u8) -> PyResult<Self> {
        let zeros = |wanted: bool, each: usize| -> PyResult<Vec<f32>> {
            let mut numbers = Vec::new();
            if wanted {
                let length = count.saturating_mul(each);
                numbers.try_reserve_exact(length).map_err(|_| {
                    pyo3::exceptions::PyMemoryError::new_err(format!("cannot allocate {length} numbers"))
                })?;
                numbers.resize(length, 0.0);
            }
            Ok(numbers)
        };
        Ok(Self {
            values: zeros(true, 1)?,
            gradients: zeros(order > 0, N)?,
            hessians: zeros(order > 1, N * N)?,
            order,
        })
    }

    /// Parts of the space for at most `length` points each.
    fn pieces<const N: usize>(&mut self, length: usize) -> impl Iterator<Item = Output<'_>> {
        let mut gradients = self.gradients.chunks_mut(length * N);
        let mut hessians = self.hessians.chunks_mut(length * N * N);
        self.values.chunks_mut(length).map(move |values| Output {
            values,
            gradients: gradients.next().unwrap_or_default(),
            hessians: hessians.next().unwrap_or_default(),
        })
    }

    fn into_arrays(self, py: Python<'_>) -> Arrays<'_> {
        let Self { values, gradients, hessians, order } = self;
        (
            values.into_pyarray(py),
            (order > 0).then(|| gradients.into_pyarray(py)),
            (order > 1).then(|| hessians.into_pyarray(py)),
        )
    }
}
