//! The layout of a normal table: positions, contents and memory formats of its entries.

use glam::Vec2;

use crate::normal_table::chart::Chart;
use crate::normal_table::spacing::Spacing;
use crate::numeric::binary16::from_half;

/// Layout of a [`NormalLut`](crate::NormalLut): its index and its entries.
///
/// The default, Gaussian coordinates and stereographic entries, is recommended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TableLayout {
    /// Spacing of the entries along both coordinates.
    pub spacing: Spacing,
    /// The two numbers of a normal that they store.
    pub chart: Chart,
}

/// An entry of a normal table: a point of its [`Chart`], as two floats or two half floats.
pub trait TableEntry: Copy + sealed::Sealed + 'static {
    /// The point of the chart.
    #[must_use]
    fn point(self) -> Vec2;
}

impl TableEntry for [f32; 2] {
    #[inline]
    fn point(self) -> Vec2 {
        Vec2::from_array(self)
    }
}

impl TableEntry for [u16; 2] {
    #[inline]
    fn point(self) -> Vec2 {
        Vec2::from_array(self.map(from_half))
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for [f32; 2] {}
    impl Sealed for [u16; 2] {}
}
