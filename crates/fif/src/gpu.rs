//! Tables and surfaces as uniforms of shaders.
//!
//! The shaders are in the crate `asperity-wgsl`. The feature `bytemuck` implements `Pod` for the
//! structs. Their declarations in WGSL are generated from the same definitions.
//!
//! The rows of all functions are in one table, as are the ranges of all axes and the nodes of all
//! surfaces. The structs have the index of the first word of theirs.

use asperity_core::gpu_struct;

#[cfg(feature = "alloc")]
use crate::surface::height_field::curve::Curve;
#[cfg(feature = "alloc")]
use crate::surface::height_field::function::Function;
#[cfg(feature = "alloc")]
use crate::surface::self_affine::folded::FoldedSurface;
#[cfg(feature = "alloc")]
use crate::table::uniform_f32::Table32;

gpu_struct! {
    /// A function from its table. Lengths are in the unit of the domain.
    pub struct TableUniform as "FifTable" {
        /// Index in `fif_rows` of the first word.
        first: u32,
        /// Number of rows, one per digit.
        radix: u32,
        /// Composites of a value.
        steps: u32,
        /// Composites of a slope.
        slope_steps: u32,
        /// Left end of the domain.
        origin: f32,
        /// Reciprocal of the width of the domain.
        per_width: f32,
        /// Value at the left end.
        start: f32,
        /// Rise to the right end.
        rise: f32,
        /// Value at the right end.
        last: f32,
        /// Middle of the deviation from the chord.
        middle: f32,
        /// Middle of the slopes of the deviation over a row.
        slope_middle: f32,
        /// Bound of the error of a value.
        bound: f32,
    }
}

#[cfg(feature = "alloc")]
impl<const C: usize> Table32<C> {
    /// Returns the function as a uniform of a shader, whose rows begin at index `first` of the
    /// table `fif_rows`.
    ///
    /// Returns `None` for functions on unequal knots, with more than three coefficients or 2¹⁶
    /// maps, and for factors too close to one.
    ///
    /// ```
    /// use asperity_fif::cochran_2000;
    ///
    /// let f = cochran_2000::f_hat()?.table(1e-7)?.to_f32();
    /// let uniform = f.gpu(0).unwrap();
    /// assert_eq!((uniform.radix, f.gpu_rows().count()), (1024, 4096));
    /// assert_eq!(uniform.last, 2.0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn gpu(&self, first: u32) -> Option<TableUniform> {
        let rows = self.rows.as_ref().filter(|rows| rows.radix < 1 << 16)?;
        let system = self.table().system();
        let (domain, radix) = (system.domain(), rows.radix as f64);
        let (mut slope_steps, mut slope_middle) = (0, 0.0);
        if let Some(slopes) = self.table().slopes() {
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
        Some(TableUniform {
            first,
            radix: rows.radix as u32,
            steps: rows.steps,
            slope_steps,
            origin: rows.origin,
            per_width: rows.per_width,
            start: rows.chord[0],
            rise: rows.chord[1],
            last: system.evaluate(domain.hi, 0.0).value as f32,
            middle: rows.middle,
            slope_middle: slope_middle as f32,
            bound: self.bound(),
        })
    }

    /// Iterates over the rows of the function for the table `fif_rows`: factor and coefficients of
    /// every composite, four numbers each.
    pub fn gpu_rows(&self) -> impl Iterator<Item = f32> {
        self.rows.iter().flat_map(|rows| rows.table.iter().copied().flatten())
    }
}

gpu_struct! {
    /// A height field.
    pub struct HeightFieldUniform as "HeightField" {
        /// Function along x.
        x: TableUniform,
        /// Function along y.
        y: TableUniform,
    }
}

gpu_struct! {
    /// A surface that is not a product.
    pub struct FoldedSurfaceUniform as "FoldedSurface" {
        /// Index in `fif_nodes` of the first word.
        first: u32,
        /// Repetitions.
        steps: u32,
        /// Cells along both axes.
        cells: [u32; 2],
        /// Lower ends of the domain.
        origin: [f32; 2],
        /// Reciprocals of the widths of the domain.
        per_width: [f32; 2],
        /// Middle of the repeated term.
        middle: f32,
        /// Middle of its slopes along x, per width of the domain.
        slope_x: f32,
        /// Middle of its slopes along y.
        slope_y: f32,
        /// Vertical factor.
        factor: f32,
    }
}

#[cfg(feature = "alloc")]
impl FoldedSurface {
    /// Returns the surface as a uniform of a shader, whose nodes begin at index `first` of the
    /// table `fif_nodes`.
    ///
    /// ```
    /// use asperity_fif::FoldedSurface;
    ///
    /// let (knots, z) = ([0.0, 1.0, 2.0], [0.0, 1.0, 0.0, 0.5, 2.0, 0.5, 0.0, 1.0, 0.0]);
    /// let surface = FoldedSurface::new(&knots, &knots, 0.25, &z, &[[0.0; 2]; 9])?;
    /// assert_eq!(surface.gpu(0).cells, [2, 2]);
    /// assert_eq!(surface.gpu_nodes().nth(4 * 8 + 2), Some(2.0)); // the height of the fifth node
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    #[must_use]
    pub fn gpu(&self, first: u32) -> FoldedSurfaceUniform {
        /// The maximum number of terms of slopes that decrease slowly; later terms are smaller than
        /// pixels long before.
        const MOST: u32 = 256;
        let (contraction, middles) = self.remainder();
        // The omitted terms are below the rounding of slopes.
        let (mut left, mut steps) = (1.0, 0);
        while steps == 0 || (left > 1.0 / 33_554_432.0 && steps < MOST) {
            left *= contraction;
            steps += 1;
        }
        let [middle, slope_x, slope_y] = middles.map(|middle| middle as f32);
        FoldedSurfaceUniform {
            first,
            steps,
            cells: self.cells().map(|cells| cells as u32),
            origin: self.domain().map(|side| side.lo as f32),
            per_width: self.domain().map(|side| (1.0 / side.width()) as f32),
            middle,
            slope_x,
            slope_y,
            factor: self.factor() as f32,
        }
    }

    /// Iterates over the nodes of the surface for the table `fif_nodes`, row by row along y, eight
    /// numbers each.
    ///
    /// The numbers are position, height and slopes, and then height and slopes of the repeated
    /// term, with lengths in units of the domain.
    pub fn gpu_nodes(&self) -> impl Iterator<Item = f32> {
        self.nodes().flatten().map(|number| number as f32)
    }
}

gpu_struct! {
    /// An axis of a height field for ray intersection.
    pub struct RangesUniform as "FifRanges" {
        /// Index in `fif_ranges` of the first word.
        first: u32,
        /// Cells of the domain.
        cells: u32,
        /// Lower end of the domain.
        low: f32,
        /// Upper end of the domain.
        high: f32,
        /// Maximum magnitude of values.
        magnitude: f32,
        /// Maximum magnitude of slopes.
        steepest: f32,
        /// Maximum magnitude of a coordinate.
        reach: f32,
        /// Bound of the error of a height along this axis.
        bound: f32,
    }
}

gpu_struct! {
    /// The axes of a height field for ray intersection.
    pub struct HeightFieldRangesUniform as "HeightFieldRanges" {
        /// Axis x.
        x: RangesUniform,
        /// Axis y.
        y: RangesUniform,
    }
}

#[cfg(feature = "alloc")]
impl<F: Function> Curve<F> {
    /// Returns the axis as a uniform of a shader that intersects rays, with the table of its
    /// function. Its ranges begin at index `first` of the table `fif_ranges`.
    ///
    /// Returns `None` unless the field is [`tabulated`](crate::HeightField::tabulated) and the axis
    /// is smooth, on equally spaced knots.
    ///
    /// ```
    /// use asperity_fif::{HeightField, cochran_2000};
    ///
    /// let surface = HeightField::new(cochran_2000::f_hat()?, cochran_2000::f_hat()?).tabulated_with(64);
    /// let f = surface.x().function().table(1e-7)?.to_f32();
    /// let uniform = surface.x().gpu(&f, 0).unwrap();
    /// assert_eq!((uniform.cells, surface.x().gpu_ranges().count()), (64, 4 * 7 * 64));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn gpu<const C: usize>(&self, table: &Table32<C>, first: u32) -> Option<RangesUniform> {
        let ranges = self.ranges()?;
        let most = |k: usize| {
            let ends = ranges.runs().iter().take(ranges.cells()).map(|run| run[k].max(run[k + 1]));
            ends.fold(0.0, f32::max)
        };
        let domain = self.domain();
        Some(RangesUniform {
            first,
            cells: ranges.cells() as u32,
            low: domain.lo as f32,
            high: domain.hi as f32,
            magnitude: most(0),
            steepest: most(2),
            // The sum of the table and the position are rounded too, so bounds are rounded outward.
            reach: (domain.magnitude() as f32).next_up(),
            bound: table.bound(),
        })
    }

    /// Iterates over the ranges of the axis for the table `fif_ranges`.
    ///
    /// For runs of 1, 2, 4, … cells from every cell on, they are the maxima of −value, value,
    /// −slope and slope.
    pub fn gpu_ranges(&self) -> impl Iterator<Item = f32> {
        self.ranges().into_iter().flat_map(|ranges| ranges.runs().iter().copied().flatten())
    }
}
