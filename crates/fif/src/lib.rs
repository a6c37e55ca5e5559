//! Fractal interpolation functions (FIFs): curves, integrals, height fields and ray intersection.
//!
//! A FIF is a curve through given points that consists of smaller copies of itself. A map
//! takes the whole curve to one piece: it scales heights by α and adds a polynomial q of x. The
//! vertical scalings α control the roughness. The address
//! of x is the sequence of pieces, level by level, that contain x. This crate evaluates FIFs to a
//! given tolerance with an error bound. It computes exact integrals and guaranteed ranges. The
//! product of two FIFs is a height field, with exact normals if both are differentiable. A ray that
//! crosses the surface always returns a hit, and [`Hit::certain`] is true if it is proved to be the
//! first.
//!
//! ```
//! use asperity_fif::{FixedFif, HeightField, Intersect, Ray, glam::DVec3};
//!
//! // A rough function through three points. Its integral is smooth, and so is the product of two integrals.
//! // Two pieces; the polynomial of each map has two coefficients (degree + 1).
//! let f = FixedFif::<2, 2>::affine(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], &[0.5, 0.5])?;
//! let f_hat: FixedFif<2, 3> = f.integral(0.0)?;
//! let surface = HeightField::new(f_hat, f_hat);
//! let ray = Ray { origin: DVec3::new(-1.0, -1.0, 3.0), direction: DVec3::new(1.0, 1.0, -1.0) };
//! let hit = surface.intersect(&ray).unwrap();
//! assert!((hit.t - 2.0).abs() < 1e-12 && hit.normal.unwrap().z > 0.0);
//! # Ok::<(), asperity_fif::FifError>(())
//! ```
//!
//! # Conventions
//!
//! - Constructors validate their arguments. Evaluation never panics. Points outside the domain are
//!   clamped, NaN returns NaN, and invalid rays (zero or non-finite direction) return `None`.
//! - All computations use `f64`, except [`Table32`]. Direct evaluation in `f32` would lose at
//!   least one bit of the address per level. For example, an affine function on 8 uneven knots with
//!   scaling 0.6 would have an error of 6·10⁻³.
//! - Loops are bounded by 4096 maps per evaluation, and by maximum numbers of cells per search and
//!   boxes per ray. When a limit is reached, the returned bound or bracket is wider and still
//!   valid.
//! - Reproducibility: values use only `+ − × ÷` and comparisons in a fixed order. Normals, extrema
//!   and fits also use square roots. Therefore the bits are the same wherever `f64` is IEEE 754.
//!   Moduli and dimensions use powers and logarithms of `std` or `libm`.
//!
//! # Features
//!
//! | feature | effect |
//! |---|---|
//! | `std` (default) | roots, powers and logarithms of the standard library |
//! | `libm` | roots, powers and logarithms of `libm`, for targets without a standard library; takes precedence over `std` |
//! | `alloc` (default) | [`Fif`], [`Table`], [`PeriodicSurface`], [`FoldedSurface`], [`RoughFoldedSurface`], [`Tabulated`], [`RecurrentFif`], [`fit`], and the tables of `tabulated()` |
//! | `bytemuck` | `Pod` for the structs of [`gpu`] |
//! | `mint` | conversion between the vectors of [`glam`] and `mint`, for engines with other vectors |
//! | `serde` | serialization of FIFs, validated by [`Fif::with_ordinates`]; needs `alloc` |
//! | `approx` | comparisons of intervals, values with bounds, jets, rays and hits to a tolerance |
//! | `simd` (default) | batches of [`Table32`] and of jets with SIMD, with the same bits |
//!
//! Either `std` or `libm` is required. Without `alloc`, [`FixedFif`], [`FifRef`], [`HeightField`]
//! and ray intersection are available.
//!
//! # References
//!
//! - W. O. Cochran, R. R. Lewis, J. C. Hart, *The Normal of a Fractal Surface*, 2000. The affected
//!   items document corrections of this paper.
//! - M. F. Barnsley, *Fractal functions and interpolation*, Constructive Approximation 2, 1986.
//! - M. F. Barnsley, J. H. Elton, D. P. Hardin, *Recurrent iterated function systems*, Constructive
//!   Approximation 5, 1989.
#![no_std]

#[cfg(any(feature = "alloc", test))]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("asperity-fif needs a float backend: enable the feature `std` or `libm`");

mod analysis;
#[cfg(feature = "approx")]
mod approx;
mod calculus;
pub mod cochran_2000;
mod evaluate;
#[cfg(feature = "alloc")]
pub mod fit;
pub mod gpu;
mod numeric;

mod ray;
#[cfg(feature = "alloc")]
mod recurrent;
pub mod surface;
pub mod system;
#[cfg(feature = "alloc")]
mod table;

pub use analysis::oscillation::{Scaling, box_dimension, oscillation_exponent};
pub use analysis::{extrema::Extrema, modulus::Modulus};
pub use asperity_core::{BatchError, Interval};
pub use glam;
pub use numeric::estimate::{Bounded, Estimate};
pub use ray::intersect::Intersect;
pub use ray::ray::{Hit, Ray};
#[cfg(feature = "alloc")]
pub use ray::tabulated::Tabulated;
#[cfg(feature = "alloc")]
pub use recurrent::recurrent::RecurrentFif;
pub use surface::bounds::{Surface, SurfaceBounds};
pub use surface::height_field::area::{AreaMeans, SlopeMeans};
pub use surface::height_field::{curvature::Curvature, height_field::HeightField};
#[cfg(feature = "alloc")]
pub use surface::{
    extrema::SurfaceExtrema,
    self_affine::{
        folded::FoldedSurface, rough_folded::RoughFoldedSurface, self_affine::SelfAffine,
        torus::PeriodicSurface,
    },
};
#[cfg(feature = "alloc")]
pub use system::fif::Fif;
pub use system::fif::{FifRef, FixedFif, System};
pub use system::{error::FifError, map::Map};
#[cfg(feature = "alloc")]
pub use table::{jet::jet::Jet, table::Table, uniform_f32::Table32};
