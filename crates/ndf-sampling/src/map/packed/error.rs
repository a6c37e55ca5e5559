//! Error for arrays that are not packed maps.

use asperity_core::error_enum;

error_enum! {
    /// Error for an array that is not a packed map.
    pub enum PackedMapError {
        /// The first number is not the format number.
        Format { value: f32 } => "not a packed map: bad magic number {value}";
        /// A number of the header, at `index`, has the bits `value`, which are not a valid size.
        Header { index: usize, value: u32 } => "header number {index} must be a valid size, got {value}";
        /// The array has no header, or its length does not match the header.
        Length { expected: u64, got: usize } => "array must have {expected} numbers, got {got}";
    }
}
