//! The layout of a table of normals: where its entries lie, what they hold, and their forms in memory.

use glam::{Vec2, Vec3};

use crate::frame::Frame;
use crate::normal_table::chart::Chart;
use crate::normal_table::spacing::Spacing;
use crate::numeric::binary16::from_half;

/// Layout of a [`NormalTable`](crate::NormalTable): its index and its entries.
///
/// The default, Gaussian coordinates and stereographic entries, is the recommended one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct TableLayout {
    /// Spacing of the entries along both coordinates.
    pub spacing: Spacing,
    /// Which two numbers of the normals they hold.
    pub chart: Chart,
}

/// An entry of a table of normals: a point of its [`Chart`], as two floats or as the bits of two half floats.
pub trait TableEntry: Copy + sealed::Sealed {
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

/// The frame of a normal and a tangent in half floats, as `NormalTable::half_frames` packs them, orthonormal again.
///
/// The last number of each is ignored. Total: what is no direction gives the frame of the other, or [`Frame::IDENTITY`].
///
/// ```
/// use asperity_ndf_sampling::{Frame, glam::Vec3, normal_table::{to_half, unpack_frame}};
///
/// let frame = Frame::from_normal(Vec3::new(0.36, 0.48, 0.8));
/// let texel = |v: Vec3| [v.x, v.y, v.z, 1.0].map(to_half);
/// let unpacked = unpack_frame(texel(frame.normal), texel(frame.tangent));
/// assert!(unpacked.bitangent.abs_diff_eq(frame.bitangent, 6e-4));
/// assert!(unpacked.normal.dot(unpacked.tangent).abs() < 1e-6);
/// ```
#[must_use]
pub fn unpack_frame(normal: [u16; 4], tangent: [u16; 4]) -> Frame {
    let vector = |[x, y, z, _]: [u16; 4]| Vec3::from_array([x, y, z].map(from_half));
    Frame::from_normal_tangent(vector(normal), vector(tangent))
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for [f32; 2] {}
    impl Sealed for [u16; 2] {}
}
