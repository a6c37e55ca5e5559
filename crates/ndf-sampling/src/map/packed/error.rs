//! Refusals of arrays that are no packed maps.

use asperity_core::error_enum;

error_enum! {
    /// Refusal of an array that is no packed map.
    pub enum PackedMapError {
        /// The first number is not that of this format.
        Format {
            /// Its value.
            value: f32,
        } => "number 0 must be the format of packed maps, got {value}",
        /// A number of the header is no size.
        Header {
            /// Which one.
            index: usize,
            /// Its bits.
            value: u32,
        } => "number {index} must be a size, got {value}",
        /// The array has no header, or is not as long as its header says.
        Length {
            /// Length that it should have.
            expected: u64,
            /// Length that it has.
            got: usize,
        } => "array must have {expected} numbers, got {got}",
    }
}
