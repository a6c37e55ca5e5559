//! Refusals of arrays that are no packed maps.

use asperity_core::error_enum;

error_enum! {
    /// Refusal of an array that is no packed map.
    pub enum PackedMapError {
        /// The first number is not that of this format.
        Format { value: f32 } => "number 0 must be the format of packed maps, got {value}";
        /// A number of the header, at `index`, has the bits `value`, which are no size.
        Header { index: usize, value: u32 } => "number {index} must be a size, got {value}";
        /// The array has no header, or is not as long as its header says.
        Length { expected: u64, got: usize } => "array must have {expected} numbers, got {got}";
    }
}
