//! # asperity-fif
//!
//! Fractal interpolation functions: curves that pass through given points and consist of smaller copies of themselves.
//! They are evaluated to a stated tolerance, integrated exactly, bounded rigorously, and multiplied to height fields
//! whose normals are exact and whose ray hits are guaranteed.
//!
//! ```
//! use asperity_fif::glam::DVec3;
//! use asperity_fif::{FixedFif, FixedSmooth, HeightField, Ray};
//!
//! // A rough function through three points; its integral is smooth, and so is the product of two integrals.
//! let f = FixedFif::<2, 2>::affine(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], &[0.5, 0.5])?;
//! let f_hat = FixedSmooth::<2, 3, 2>::integral(f, 0.0)?;
//! let surface = HeightField::new(f_hat, f_hat);
//! let ray = Ray { origin: DVec3::new(-1.0, -1.0, 3.0), direction: DVec3::new(1.0, 1.0, -1.0) };
//! let hit = surface.first_hit(&ray).unwrap();
//! assert!((hit.t - 2.0).abs() < 1e-12 && hit.normal.unwrap().z > 0.0);
//! # Ok::<(), asperity_fif::SystemError>(())
//! ```
//!
//! ## What is here
//!
//! | item | is |
//! |---|---|
//! | [`Fif`], [`FixedFif`], [`FifBuf`], [`FifView`] | a validated system of maps, in an array, a vector, or borrowed |
//! | [`Fif::affine`], [`Fif::hermite`], [`Fif::new`], [`Fif::with_ordinates`] | its constructors, which refuse with a [`SystemError`] |
//! | [`Fif::from_maps`], [`Fif::sum`], [`Fif::scaled`] | the same from maps, and from other systems |
//! | [`Fif::evaluate`], [`Fif::value_at_address`] | `value ± bound` at a point and at an address |
//! | [`Fast`], [`FixedFast`], [`FastBuf`] | values on equally spaced knots in a few nanoseconds, from a table |
//! | [`Fast32`] | the same in `f32`, in SIMD lanes for many points |
//! | [`Uneven`] | the same on any knots |
//! | [`FastJets`] | value, slope, integral and higher derivatives of a smooth function at once |
//! | [`Fif::grid`] | values at all nodes of an even grid |
//! | [`Fif::algorithm_two`], [`Fif::chaos_game`] | the source's algorithms as printed, with their errors |
//! | [`Fif::address`] | the maps that close in on a point |
//! | [`Map::compose`] | the composite of two maps |
//! | [`Fif::integral`], [`Fif::derivative`], [`Fif::total_integral`] | calculus, within the same class of functions |
//! | [`Fif::integral_over`], [`Fif::mean`], [`Fif::nth_integral`] | over any interval, an [`Estimate`] with its error and conditioning |
//! | [`Fif::moment`], [`Fif::moment_over`], [`Fif::norm_squared`] | `∫ xᵏ fᵖ`, over the domain or any interval |
//! | [`Fif::inner_product`], [`Fif::supremum_norm`], [`Fif::differentiability`] | `∫ f g` on the same knots, `max ∣f∣`, the number of derivatives |
//! | [`Fif::range`], [`Fif::enclosure`] | rigorous bounds |
//! | [`Fif::extrema`], [`Fif::extrema_over`] | the least and the greatest value, and where they lie |
//! | [`Fif::modulus`], [`Fif::conditioning`] | how much `f` moves when `x` does |
//! | [`Fif::dimension`] | the box dimension of the graph |
//! | [`Smooth`], [`FixedSmooth`], [`SmoothBuf`] | a function with its derivative |
//! | [`HeightField`] | `f(x) g(y)`: height, gradient, unit normal |
//! | [`HeightField::curvature`] | mean and Gaussian [`Curvature`] |
//! | [`HeightField::area_means`] | means of heights and slopes over a rectangle, in closed form |
//! | [`HeightField::normal_distribution`] | the density of the normals over a rectangle, as an image |
//! | [`HeightField::first_hit`] | the first point of a [`Ray`] on it |
//! | [`HeightField::first_hit_within`], [`HeightField::hits_any`], [`HeightField::first_hits`] | the same to a tolerance, any hit, and many rays |
//! | [`Cached`] | an axis with a table of bounds: faster hits |
//! | [`TorusSurface`], [`FixedTorus`], [`TorusBuf`], [`TorusView`] | a periodic surface without grain, through heights with gradients |
//! | [`TorusSurface::bounds`], [`TorusSurface::extrema_over`], [`TorusSurface::mean`] | its rigorous bounds and means |
//! | [`FoldedSurface`], [`FixedFolded`], [`FoldedBuf`], [`FoldedView`] | the like on a grid of unequal cells, not periodic |
//! | [`FoldedSurface::bounds`], [`FoldedSurface::extrema_over`], [`FoldedSurface::mean`] | its rigorous bounds and its mean |
//! | [`Surface`] | any surface over a rectangle: its bounds, and rays against it |
//! | [`Surface::first_hit`], [`Surface::first_hit_within`], [`Surface::hits_any`], [`Surface::first_hits`] | the first point of a ray on it, to a tolerance, any hit, many rays |
//! | [`Pyramid`] | a surface with a table of bounds: faster hits |
//! | [`TorusSurface::narrowed`], [`FoldedSurface::narrowed`] | narrower global ranges, before searches and rays |
//! | [`Recurrent`] | systems whose maps copy parts of the graph, each its own |
//! | [`Interval`], [`Bounded`] | enclosures |
//! | [`fit`] | factors and knots for given data, with what they miss by |
//! | [`paper`] | the functions of the source |
//!
//! ## Contract
//!
//! - A system is checked once, by its constructor. After that nothing fails and nothing panics: points outside the domain
//!   are clamped, NaN gives NaN, and a ray that is no ray hits nothing.
//! - Everything is `f64`. In `f32` the address of a point loses a bit or more per level: an affine function on 8 uneven
//!   nodes with factor 0.6 is wrong by 6·10⁻³.
//! - Loops are bounded: [`MAX_DEPTH`] maps per evaluation, a number of cells per search, of boxes per ray. Where a limit
//!   binds, the returned bound or bracket is wider and still true.
//! - Values use only `+ − × ÷` and comparisons in a fixed order (normals, extrema and fits also square roots), so they have
//!   the same bits wherever `f64` is IEEE 754. A modulus and a dimension use powers and logarithms of the float backend.
//!
//! ## Features
//!
//! | feature | gives |
//! |---|---|
//! | `std` (default) | roots, powers and logarithms of the standard library |
//! | `libm` | those of `libm`, for targets without a standard library; wins over `std` |
//! | `alloc` (default) | [`FifBuf`], [`SmoothBuf`], [`FastBuf`], [`Fast32`], [`Uneven`], [`FastJets`], [`Cached`], [`Pyramid`], [`Recurrent`], [`fit`] |
//! | `serde` | systems written to files, and read through the checks of [`Fif::with_ordinates`]; needs `alloc` |
//! | `simd` (default) | batches of [`Fast32`] and [`FastJets`] in SIMD lanes, with the same bits |
//!
//! One of `std` and `libm` is needed. Without `alloc` everything else works in arrays and borrowed slices.
//!
//! ## Sources
//!
//! W. O. Cochran, R. R. Lewis, J. C. Hart, *The Normal of a Fractal Surface*, 2000; M. F. Barnsley, *Fractal functions
//! and interpolation*, Constructive Approximation 2, 1986; M. F. Barnsley, J. H. Elton, D. P. Hardin, *Recurrent iterated
//! function systems*, Constructive Approximation 5, 1989. Where the first is corrected, the item says so.
#![no_std]

#[cfg(any(feature = "alloc", test))]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-fif needs a float backend: enable the feature `std` or `libm`");

mod algorithm_two;
mod area;
mod axis;
mod axis_cover;
#[cfg(feature = "alloc")]
mod axis_tables;
mod batch;
mod bounds;
#[cfg(feature = "alloc")]
mod cached;
mod cell;
mod chaos_game;
mod chord;
mod combine;
mod composites;
mod curvature;
mod descent;
mod dimension;
mod estimate;
mod evaluate;
mod fast;
#[cfg(feature = "alloc")]
mod fast32;
#[cfg(feature = "alloc")]
pub mod fit;
#[cfg(feature = "alloc")]
mod fit_error;
#[cfg(feature = "alloc")]
mod fit_knots;
#[cfg(feature = "alloc")]
mod fit_refine;
mod folded;
mod folded_error;
mod folded_evaluate;
mod folded_limits;
mod folded_node;
mod folded_ranges;
mod grid;
mod height_field;
mod hermite_patch;
mod homogeneous;
mod inner_product;
mod integral;
mod interval;
#[cfg(feature = "alloc")]
mod jet;
#[cfg(all(feature = "alloc", feature = "simd"))]
mod jet_lanes;
#[cfg(feature = "alloc")]
mod jet_orders;
#[cfg(feature = "alloc")]
mod jet_sums;
#[cfg(feature = "alloc")]
mod jet_table;
#[cfg(feature = "alloc")]
mod jets;
#[cfg(all(feature = "alloc", feature = "simd"))]
mod lanes;
mod map;
mod math;
mod matrix;
mod moment_basis;
mod moments;
#[cfg(feature = "alloc")]
mod normal_distribution;
mod orbit;
pub mod paper;
mod polynomial;
#[cfg(feature = "alloc")]
mod primitive;
#[cfg(feature = "alloc")]
mod pyramid;
mod range_box;
#[cfg(feature = "alloc")]
mod range_table;
mod ray;
#[cfg(feature = "alloc")]
mod ray_batch;
#[cfg(feature = "alloc")]
mod recurrent;
#[cfg(feature = "alloc")]
mod recurrent_error;
#[cfg(feature = "alloc")]
mod recurrent_evaluate;
#[cfg(feature = "alloc")]
mod recurrent_means;
mod regularity;
#[cfg(feature = "alloc")]
mod root_search;
mod search;
#[cfg(feature = "serde")]
mod serialise;
mod series;
mod storage;
mod stretch;
mod surface;
mod surface_extrema;
mod surface_ray;
mod system;
mod system_error;
mod tiling;
mod torus;
mod torus_error;
mod torus_evaluate;
mod torus_limits;
mod torus_node;
mod torus_ranges;
#[cfg(feature = "alloc")]
mod tracer;
mod turn;
#[cfg(feature = "alloc")]
mod uneven;

pub use area::{AreaMeans, AxisMeans, LineMeans, SlopeMeans};
pub use axis::{Axis, Smooth};
pub use batch::BatchError;
pub use bounds::Extrema;
#[cfg(feature = "alloc")]
pub use cached::Cached;
pub use chaos_game::ChaosGame;
pub use combine::CombineError;
pub use composites::{Composite, TableError, TableStorage};
pub use curvature::Curvature;
pub use estimate::Estimate;
pub use evaluate::MAX_DEPTH;
#[cfg(feature = "alloc")]
pub use fast::FastBuf;
pub use fast::{Fast, FixedFast};
#[cfg(feature = "alloc")]
pub use fast32::Fast32;
pub use folded::FoldedSurface;
pub use folded_error::FoldedError;
#[cfg(feature = "alloc")]
pub use folded_node::FoldedBuf;
pub use folded_node::{FixedFolded, FoldedNode, FoldedStorage, FoldedView};
pub use glam;
pub use grid::GridError;
pub use height_field::HeightField;
pub use interval::{Bounded, Interval};
#[cfg(feature = "alloc")]
pub use jet::Jet;
#[cfg(feature = "alloc")]
pub use jets::FastJets;
pub use map::{Map, Piece};
pub use moment_basis::{MAX_MOMENT_DEGREE, MAX_POWER, MomentError};
#[cfg(feature = "alloc")]
pub use normal_distribution::NormalDistributionError;
#[cfg(feature = "alloc")]
pub use pyramid::Pyramid;
pub use ray::{Hit, Ray};
#[cfg(feature = "alloc")]
pub use recurrent::Recurrent;
#[cfg(feature = "alloc")]
pub use recurrent_error::RecurrentError;
pub use regularity::Modulus;
#[cfg(feature = "alloc")]
pub use storage::{FifBuf, SmoothBuf};
pub use storage::{FifView, FixedFif, FixedSmooth, Storage};
pub use surface::{Surface, SurfaceBounds};
pub use surface_extrema::SurfaceExtrema;
pub use system::{Fif, JOIN_TOLERANCE};
pub use system_error::{End, List, SystemError};
pub use torus::TorusSurface;
pub use torus_error::TorusError;
#[cfg(feature = "alloc")]
pub use torus_node::TorusBuf;
pub use torus_node::{FixedTorus, TorusNode, TorusStorage, TorusView};
#[cfg(feature = "alloc")]
pub use uneven::Uneven;
