//! Fractal interpolation functions from tables: values and slopes, height fields, folded surfaces
//! and ray intersection.
//!
//! The rows of all functions are in one table and the ranges of all axes in another. Uniforms
//! contain the offsets of a function.

#[cfg(feature = "alloc")]
use asperity_fif::{FoldedSurface, Table32, surface::Curve, surface::Function};

use crate::part::{Binding, Element, Part, part};

/// Numbers in a row of the textures of rows and of ranges.
pub const WIDTH: u32 = 1024;

/// Whether a coordinate is not NaN: `fif_is_number`.
pub static NUMBER: Part = part!("fif/number");

/// Values of a function from its table: `fif_table_value`, with the bits of
/// [`Table32::value`](asperity_fif::Table32::value).
///
/// Bound to the table `fif_rows` of [`table_rows`]. The [`TableUniform`] selects the function.
pub static TABLE: Part = part!("fif/table/uniform", NUMBER).with_bindings(&[Binding::Table {
    name: "fif_rows",
    element: Element::Float,
    width: WIDTH,
}]);

/// Values and slopes of a smooth function from its table: `fif_table_jet`, as
/// [`Table::jet`](asperity_fif::Table::jet).
pub static JET: Part = part!("fif/table/jet", TABLE);

/// The normal of a gradient: `upward_normal`.
pub static NORMAL: Part = part!("fif/surface/normal");

/// Height and gradient of `f(x) g(y)`: [`HeightField`](asperity_fif::HeightField).
pub static HEIGHT_FIELD: Part = part!("fif/surface/height_field", JET);

/// Height and gradient of a surface that is not a product: `folded_height` and `folded_jet`, as
/// [`asperity_fif::FoldedSurface`].
///
/// Bound to the table `fif_nodes` of [`folded_nodes`]. The [`FoldedUniform`] selects the surface.
pub static FOLDED: Part = part!("fif/surface/folded", NUMBER).with_bindings(&[Binding::Table {
    name: "fif_nodes",
    element: Element::Float,
    width: WIDTH,
}]);

/// Ray intersection with a height field: `height_field_first_hit`, as
/// [`Intersect::intersect_within`](asperity_fif::Intersect::intersect_within).
///
/// Bound to the table `fif_ranges` of [`ranges`]. The [`RangesUniform`] selects the axis.
pub static FIRST_HIT: Part = part!("fif/ray/first_hit", HEIGHT_FIELD).with_bindings(&[Binding::Table {
    name: "fif_ranges",
    element: Element::Float,
    width: WIDTH,
}]);

/// Words of the structure `FifTable`: constants of a function, and the offset of its rows.
///
/// | words | contents |
/// |---|---|
/// | 0–3 | index of the first word of its rows in `fif_rows`, number of rows, composites of a value, of a slope |
/// | 4, 5 | left end of the domain, reciprocal of its width |
/// | 6–8 | value at the left end, rise to the right end, value at the right end |
/// | 9, 10 | middle of the deviation from the chord, and of its slopes over a row |
/// | 11 | bound of the error of a value |
///
/// The first four are integers, the others `f32`. Lengths are in the unit of the domain. A height
/// field has two of them, for x and y.
///
/// ```
/// use asperity_fif::cochran_2000;
/// use asperity_wgsl::fif::{TableUniform, table_rows};
///
/// let f = cochran_2000::f_hat()?.table(1e-7)?.to_f32();
/// let uniform = TableUniform::new(&f, 0).unwrap();
/// let rows: Vec<f32> = table_rows(&f).collect();
/// assert_eq!((uniform.words()[1], rows.len()), (1024, 4096));
/// assert_eq!(uniform.words()[8], 2.0_f32.to_bits()); // the value at the right end
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TableUniform {
    words: [u32; Self::WORDS],
}

#[cfg(feature = "alloc")]
impl TableUniform {
    /// Number of the words.
    pub const WORDS: usize = 12;

    /// Packs a table whose rows begin at index `first` of `fif_rows`.
    ///
    /// Returns `None` for functions on unequal knots, with more than three coefficients or 2¹⁶
    /// maps, and for factors too close to one.
    #[must_use]
    pub fn new<const C: usize>(table: &Table32<C>, first: u32) -> Option<Self> {
        let rows = table.rows().filter(|rows| rows.radix < 1 << 16)?;
        let system = table.table().system();
        let (domain, radix) = (system.domain(), rows.radix as f64);
        let last = system.evaluate(domain.hi, 0.0).value as f32;
        let (mut slope_steps, mut slope_middle) = (0, 0.0);
        if let Some(slopes) = table.table().slopes() {
            let rise = f64::from(rows.chord[1]);
            slope_middle = (slopes.middle() * domain.width() - rise) / radix;
            // The contribution of omitted digits to the slope is below its rounding. 64 bits hold
            // this number of digits.
            let steepest = rows.table.iter().fold(0.0, |most: f64, row| most.max(f64::from(row[0].abs())));
            let (mut left, enough) = (0.5 * slopes.width(), slopes.magnitude() / 33_554_432.0);
            let mut place = 1.0;
            while slope_steps == 0 || (left > enough && place < 18_446_744_073_709_551_616.0) {
                (left, place) = (left * steepest * radix, place * radix);
                slope_steps += 1;
            }
        }
        let floats = [
            rows.origin,
            rows.per_width,
            rows.chord[0],
            rows.chord[1],
            last,
            rows.middle,
            slope_middle as f32,
            table.bound(),
        ];
        let mut words = [first, rows.radix as u32, rows.steps, slope_steps, 0, 0, 0, 0, 0, 0, 0, 0];
        for (word, float) in words.iter_mut().skip(4).zip(floats) {
            *word = float.to_bits();
        }
        Some(Self { words })
    }

    /// Returns the words, in the layout of `FifTable`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.words
    }
}

/// Iterates over the rows of a table for `fif_rows`: factor and coefficients of every composite,
/// four numbers each.
#[cfg(feature = "alloc")]
pub fn table_rows<const C: usize>(table: &Table32<C>) -> impl Iterator<Item = f32> {
    table.rows().into_iter().flat_map(|rows| rows.table.iter().copied().flatten())
}

/// Words of the structure `FoldedSurface`: constants of a surface, and the offset of its nodes.
///
/// | words | contents |
/// |---|---|
/// | 0, 1 | index of the first word of its nodes in `fif_nodes`, repetitions |
/// | 2, 3 | cells along both axes |
/// | 4–7 | lower ends of the domain, reciprocals of its widths |
/// | 8–10 | middles of the repeated term, and of its slopes per width of the domain |
/// | 11 | vertical factor |
///
/// The first four are integers, the others `f32`.
///
/// ```
/// use asperity_fif::FoldedSurface;
/// use asperity_wgsl::fif::{FoldedUniform, folded_nodes};
///
/// let (knots, z) = ([0.0, 1.0, 2.0], [0.0, 1.0, 0.0, 0.5, 2.0, 0.5, 0.0, 1.0, 0.0]);
/// let surface = FoldedSurface::new(&knots, &knots, 0.25, &z, &[[0.0; 2]; 9])?;
/// let uniform = FoldedUniform::new(&surface, 0);
/// assert_eq!(uniform.words()[2..4], [2, 2]);
/// assert_eq!(folded_nodes(&surface).nth(4 * 8 + 2), Some(2.0)); // the height of the fifth node
/// # Ok::<(), asperity_fif::FifError>(())
/// ```
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FoldedUniform {
    words: [u32; Self::WORDS],
}

#[cfg(feature = "alloc")]
impl FoldedUniform {
    /// Number of the words.
    pub const WORDS: usize = 12;

    /// Packs a surface whose nodes begin at index `first` of `fif_nodes`.
    #[must_use]
    pub fn new(surface: &FoldedSurface, first: u32) -> Self {
        /// The maximum number of terms of slopes that decrease slowly; later terms are smaller than
        /// pixels long before.
        const MOST: u32 = 256;
        let (contraction, middles) = surface.remainder();
        // The omitted terms are below the rounding of slopes.
        let (mut left, mut steps) = (1.0, 0);
        while steps == 0 || (left > 1.0 / 33_554_432.0 && steps < MOST) {
            left *= contraction;
            steps += 1;
        }
        let ([columns, rows], [x, y], [middle, slope_x, slope_y]) =
            (surface.cells(), surface.domain(), middles);
        let per_width = [x, y].map(|side| 1.0 / side.width());
        let floats = [x.lo, y.lo, per_width[0], per_width[1], middle, slope_x, slope_y, surface.factor()];
        let mut words = [first, steps, columns as u32, rows as u32, 0, 0, 0, 0, 0, 0, 0, 0];
        for (word, float) in words.iter_mut().skip(4).zip(floats) {
            *word = (float as f32).to_bits();
        }
        Self { words }
    }

    /// Returns the words, in the layout of `FoldedSurface`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.words
    }
}

/// Iterates over the nodes of a surface for `fif_nodes`, row by row along y, eight numbers each.
///
/// The numbers are position, height and slopes, and then the same of the repeated term, with
/// lengths in units of the domain.
#[cfg(feature = "alloc")]
pub fn folded_nodes(surface: &FoldedSurface) -> impl Iterator<Item = f32> {
    surface.nodes().flatten().map(|number| number as f32)
}

/// Words of the structure `FifRanges`: an axis of a height field for ray intersection, and the
/// offset of its ranges.
///
/// | words | contents |
/// |---|---|
/// | 0, 1 | index of the first word of its ranges in `fif_ranges`, number of cells of the domain |
/// | 2, 3 | the ends of the domain |
/// | 4, 5 | the largest magnitude of values, and of slopes |
/// | 6, 7 | the largest magnitude of a coordinate, and the bound of the error of a value |
///
/// The first two are integers, the others `f32`. `HeightFieldRanges` has two of them, for x and y.
///
/// ```
/// use asperity_fif::{HeightField, cochran_2000};
/// use asperity_wgsl::fif::{RangesUniform, ranges};
///
/// let surface = HeightField::new(cochran_2000::f_hat()?, cochran_2000::f_hat()?).tabulated_with(64);
/// let f = surface.x().function().table(1e-7)?.to_f32();
/// let uniform = RangesUniform::new(surface.x(), &f, 0).unwrap();
/// assert_eq!((uniform.words()[1], ranges(surface.x()).count()), (64, 4 * 7 * 64));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RangesUniform {
    words: [u32; Self::WORDS],
}

#[cfg(feature = "alloc")]
impl RangesUniform {
    /// Number of the words.
    pub const WORDS: usize = 8;

    /// Packs an axis of a field and the table of its function, whose ranges begin at index `first`
    /// of `fif_ranges`.
    ///
    /// Returns `None` unless the field is [`tabulated`](asperity_fif::HeightField::tabulated) and
    /// the axis is smooth, on equally spaced knots.
    #[must_use]
    pub fn new<F: Function, const C: usize>(
        curve: &Curve<F>,
        table: &Table32<C>,
        first: u32,
    ) -> Option<Self> {
        let ranges = curve.ranges()?;
        let most = |k: usize| {
            let ends = ranges.runs().iter().take(ranges.cells()).map(|run| run[k].max(run[k + 1]));
            ends.fold(0.0, f32::max)
        };
        let domain = curve.domain();
        // The sum of the table and the position are rounded too, so bounds are rounded outward.
        let floats = [
            domain.lo as f32,
            domain.hi as f32,
            most(0),
            most(2),
            (domain.magnitude() as f32).next_up(),
            table.bound(),
        ];
        let mut words = [first, ranges.cells() as u32, 0, 0, 0, 0, 0, 0];
        for (word, float) in words.iter_mut().skip(2).zip(floats) {
            *word = float.to_bits();
        }
        Some(Self { words })
    }

    /// Returns the words, in the layout of `FifRanges`.
    #[must_use]
    pub const fn words(&self) -> [u32; Self::WORDS] {
        self.words
    }
}

/// Iterates over the ranges of an axis for `fif_ranges`.
///
/// For runs of 1, 2, 4, … cells from every cell on, they are the maxima of −value, value, −slope
/// and slope.
#[cfg(feature = "alloc")]
pub fn ranges<F: Function>(curve: &Curve<F>) -> impl Iterator<Item = f32> {
    curve.ranges().into_iter().flat_map(|ranges| ranges.runs().iter().copied().flatten())
}
