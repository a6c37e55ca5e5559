//! Noises, sums and transforms chosen at run time, in one to four dimensions.
//!
//! The types of `asperity-noise` are generic. A program that reads its noise from a file or a script
//! needs one type for all of them: [`Shared`].

mod build;
mod derivatives;
mod evaluate;
mod graph;
mod jet;
mod kind;
mod point;
mod sum;

pub use asperity_noise as noise;
pub use build::{Place, Space, sum_of};
pub use evaluate::{Output, grid, list, parts};
pub use graph::Node;
pub use jet::{Jet, Shared};
pub use kind::{Kind, Parameters};
pub use point::{At, points};
pub use sum::{AnyShape, Sum};
