//! Expressions of noises and transforms, in no particular number of dimensions.

use std::sync::Arc;

use asperity_noise::Warp;
use asperity_noise::ops::{Add, Blend, Clamp, Frequency, Multiply, Power, ScaleBias, Unit};

use crate::build::{Place, Space, sum_of};
use crate::jet::{Plain, Shared};
use crate::kind::Kind;
use crate::point::At;
use crate::sum::Sum;

/// A noise, a sum of octaves, or a transform of other nodes.
#[derive(Clone, Debug)]
pub enum Node {
    /// A kind, or the sum of its octaves, with periods and an anchor or without.
    Noise {
        /// The kind.
        kind: Kind,
        /// The sum; one octave if `None`.
        sum: Option<Sum>,
        /// The periods, one for all axes or one for each.
        periods: Option<Vec<u32>>,
        /// The anchor, one number for all axes or one for each.
        anchor: Option<Vec<f64>>,
    },
    /// A sum of octaves of a transform.
    Sum(Arc<Self>, Sum),
    /// a + b.
    Add(Arc<Self>, Arc<Self>),
    /// a b.
    Multiply(Arc<Self>, Arc<Self>),
    /// a + t (b − a).
    Blend(Arc<Self>, Arc<Self>, Arc<Self>),
    /// A field clamped to two bounds.
    Clamp(Arc<Self>, f32, f32),
    /// factor · a + offset.
    ScaleBias(Arc<Self>, f32, f32),
    /// aⁿ.
    Power(Arc<Self>, u8),
    /// A field mapped from its range to [0, 1].
    Unit(Arc<Self>),
    /// A field at displaced points. One field displaces all axes, with another seed for each, or every
    /// axis has its own field.
    Warp(Arc<Self>, Vec<Arc<Self>>, f32),
    /// A field at points times a frequency.
    Frequency(Arc<Self>, f32),
}

impl Node {
    /// Creates the field in N dimensions.
    ///
    /// # Errors
    ///
    /// If a noise does not exist in N dimensions, or has no such periods there.
    pub fn build<const N: usize>(&self) -> Result<Shared<N>, String>
    where
        At<N>: Space<N>,
    {
        let of = |node: &Self| node.build::<N>();
        Ok(match self {
            Self::Noise { kind, sum, periods, anchor } => {
                let place = match (periods, anchor) {
                    (Some(periods), _) => Place::Tile(periods),
                    (None, Some(anchor)) => Place::Anchor(anchor),
                    (None, None) => Place::Origin,
                };
                <At<N> as Space<N>>::noise(kind, sum.as_ref(), place)?
            }
            Self::Sum(field, sum) => sum_of(of(field)?, sum)?,
            Self::Add(a, b) => Arc::new(Add(of(a)?, of(b)?)),
            Self::Multiply(a, b) => Arc::new(Multiply(of(a)?, of(b)?)),
            Self::Blend(a, b, t) => Arc::new(Plain(Blend(of(a)?, of(b)?, of(t)?))),
            Self::Clamp(a, low, high) => Arc::new(Clamp(of(a)?, *low, *high)),
            Self::ScaleBias(a, factor, offset) => Arc::new(ScaleBias(of(a)?, *factor, *offset)),
            Self::Power(a, exponent) => Arc::new(Plain(Power(of(a)?, *exponent))),
            Self::Unit(a) => Arc::new(Plain(Unit(of(a)?))),
            Self::Warp(a, by, strength) => {
                let nodes: Vec<Self> = match &by[..] {
                    [by] => (0..).take(N).map(|axis| by.reseeded(axis)).collect(),
                    _ => by.iter().map(|node| Self::clone(node)).collect(),
                };
                let fields = nodes.iter().map(of).collect::<Result<Vec<_>, _>>()?;
                let by: [Shared<N>; N] = fields
                    .try_into()
                    .map_err(|_| format!("`by` must be one field or {N} in {N}-D, got {}", nodes.len()))?;
                Arc::new(Plain(Warp::new(of(a)?, by, *strength).map_err(|error| error.to_string())?))
            }
            Self::Frequency(a, frequency) => Arc::new(Frequency(of(a)?, *frequency)),
        })
    }

    /// Returns the node with other seeds; 0 selects the node itself.
    #[must_use]
    pub fn reseeded(&self, by: u32) -> Self {
        let of = |node: &Arc<Self>| Arc::new(node.reseeded(by));
        match self {
            Self::Noise { kind, sum, periods, anchor } => Self::Noise {
                kind: kind.reseeded(by),
                sum: *sum,
                periods: periods.clone(),
                anchor: anchor.clone(),
            },
            Self::Sum(a, sum) => Self::Sum(of(a), *sum),
            Self::Add(a, b) => Self::Add(of(a), of(b)),
            Self::Multiply(a, b) => Self::Multiply(of(a), of(b)),
            Self::Blend(a, b, t) => Self::Blend(of(a), of(b), of(t)),
            Self::Clamp(a, low, high) => Self::Clamp(of(a), *low, *high),
            Self::ScaleBias(a, factor, offset) => Self::ScaleBias(of(a), *factor, *offset),
            Self::Power(a, exponent) => Self::Power(of(a), *exponent),
            Self::Unit(a) => Self::Unit(of(a)),
            Self::Warp(a, by, strength) => Self::Warp(of(a), by.iter().map(of).collect(), *strength),
            Self::Frequency(a, frequency) => Self::Frequency(of(a), *frequency),
        }
    }

    /// Returns whether a noise of the node repeats.
    #[must_use]
    pub fn is_tiled(&self) -> bool {
        match self {
            Self::Noise { periods, .. } => periods.is_some(),
            Self::Add(a, b) | Self::Multiply(a, b) => a.is_tiled() || b.is_tiled(),
            Self::Blend(a, b, t) => a.is_tiled() || b.is_tiled() || t.is_tiled(),
            Self::Sum(a, _)
            | Self::Clamp(a, ..)
            | Self::ScaleBias(a, ..)
            | Self::Power(a, _)
            | Self::Unit(a)
            | Self::Warp(a, ..)
            | Self::Frequency(a, _) => a.is_tiled(),
        }
    }
}
