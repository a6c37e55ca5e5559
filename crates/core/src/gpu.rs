//! Structs with the same layout in Rust and in WGSL.

/// A type with the same layout in Rust and in the uniform address space of WGSL.
///
/// Implemented by numbers, vectors as arrays, arrays, and structs of
/// [`gpu_struct!`](crate::gpu_struct).
pub trait GpuType {
    /// The name of the type in WGSL; of an array, of its elements.
    const NAME: &'static str;
    /// Number of elements of an array, as text; empty for other types.
    const COUNT: &'static str = "";
    /// Alignment in WGSL, in bytes.
    const ALIGN: usize;
}

macro_rules! types {
    ($($type:ty: $name:literal $align:literal),*) => {$(
        impl GpuType for $type {
            const NAME: &'static str = $name;
            const ALIGN: usize = $align;
        }
    )*};
}

types!(
    f32: "f32" 4, u32: "u32" 4, i32: "i32" 4,
    [f32; 2]: "vec2<f32>" 8, [f32; 3]: "vec3<f32>" 16, [f32; 4]: "vec4<f32>" 16,
    [u32; 2]: "vec2<u32>" 8, [u32; 3]: "vec3<u32>" 16, [u32; 4]: "vec4<u32>" 16,
    [i32; 2]: "vec2<i32>" 8, [i32; 3]: "vec3<i32>" 16, [i32; 4]: "vec4<i32>" 16
);

/// Elements of arrays in uniforms, whose size is a multiple of 16 bytes.
pub trait GpuElement: GpuType {}

impl GpuElement for [f32; 4] {}

macro_rules! arrays {
    ($($count:literal $text:literal),*) => {$(
        impl<T: GpuElement> GpuType for [T; $count] {
            const NAME: &'static str = T::NAME;
            const COUNT: &'static str = $text;
            const ALIGN: usize = T::ALIGN;
        }
    )*};
}

arrays!(4 "4", 8 "8", 16 "16");

/// Returns the length of the joined pieces.
#[must_use]
pub const fn joined_len(pieces: &[&str]) -> usize {
    let (mut length, mut i) = (0, 0);
    while i < pieces.len() {
        length += pieces[i].len();
        i += 1;
    }
    length
}

/// Joins pieces of text at compile time, where `N` is their [`joined_len`].
///
/// ```
/// use asperity_core::gpu::{joined, joined_len};
///
/// const PIECES: &[&str] = &["fn f", "() {}"];
/// const TEXT: [u8; joined_len(PIECES)] = joined(PIECES);
/// assert_eq!(&TEXT, b"fn f() {}");
/// ```
#[must_use]
pub const fn joined<const N: usize>(pieces: &[&str]) -> [u8; N] {
    let (mut text, mut i) = ([0; N], 0);
    let mut rest: &mut [u8] = &mut text;
    while i < pieces.len() {
        // Compilers run a loop over bytes slowly.
        let (place, after) = rest.split_at_mut(pieces[i].len());
        place.copy_from_slice(pieces[i].as_bytes());
        (rest, i) = (after, i + 1);
    }
    text
}

/// Defines a struct in Rust and in WGSL, with the same fields, comments and layout.
///
/// The calling crate needs a feature `bytemuck` with that dependency. A layout that differs between
/// the two languages does not compile. `.. padding: [u32; 2]` after the last field fills the struct
/// up to the size that it has in WGSL, or up to 16 bytes, as `std140` does.
///
/// ```
/// asperity_core::gpu_struct! {
///     /// A view.
///     pub struct ViewUniform as "View" {
///         /// Position of the eye.
///         eye: [f32; 3],
///         /// Width of a pixel.
///         pixel: f32,
///     }
/// }
///
/// assert_eq!(
///     ViewUniform::WGSL,
///     "struct View {\n    // Position of the eye.\n    eye: vec3<f32>,\n    // Width of a pixel.\n    pixel: f32,\n}\n"
/// );
/// ```
///
/// ```compile_fail
/// asperity_core::gpu_struct! {
///     /// WGSL aligns `eye` to 16 bytes.
///     pub struct ViewUniform as "View" {
///         /// Width of a pixel.
///         pixel: f32,
///         /// Position of the eye.
///         eye: [f32; 3],
///     }
/// }
/// ```
#[macro_export]
macro_rules! gpu_struct {
    ($(#[$meta:meta])* pub struct $name:ident as $wgsl:literal {
        $($(#[doc = $doc:literal])* $field:ident: $type:ty,)*
        $(.. $padding:ident: $words:ty)?
    }) => {
        $(#[$meta])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        #[cfg_attr(feature = "bytemuck", derive(::bytemuck::Pod, ::bytemuck::Zeroable))]
        pub struct $name {
            $($(#[doc = $doc])* pub $field: $type,)*
            $(
                /// Unused, and absent in WGSL.
                pub $padding: $words,
            )?
        }

        impl $name {
            #[doc = concat!("The declaration of the structure `", $wgsl, "` in WGSL.")]
            pub const WGSL: &'static str = {
                const PIECES: &[&str] = &[
                    concat!("struct ", $wgsl, " {\n"),
                    $(
                        concat!($("    //", $doc, "\n",)* "    ", stringify!($field), ": "),
                        $crate::gpu::array::<$type>(true),
                        <$type as $crate::gpu::GpuType>::NAME,
                        $crate::gpu::array::<$type>(false),
                        <$type as $crate::gpu::GpuType>::COUNT,
                        if <$type as $crate::gpu::GpuType>::COUNT.is_empty() { ",\n" } else { ">,\n" },
                    )*
                    "}\n",
                ];
                const TEXT: [u8; $crate::gpu::joined_len(PIECES)] = $crate::gpu::joined(PIECES);
                match ::core::str::from_utf8(&TEXT) {
                    Ok(text) => text,
                    Err(_) => unreachable!(),
                }
            };
        }

        impl $crate::gpu::GpuType for $name {
            const NAME: &'static str = $wgsl;
            const ALIGN: usize = {
                let mut align = 4;
                $(if <$type as $crate::gpu::GpuType>::ALIGN > align {
                    align = <$type as $crate::gpu::GpuType>::ALIGN;
                })*
                align
            };
        }

        impl $crate::gpu::GpuElement for $name {}

        const _: () = {
            let mut _end = 0_usize;
            $(
                _end = _end.next_multiple_of(<$type as $crate::gpu::GpuType>::ALIGN);
                assert!(_end == ::core::mem::offset_of!($name, $field));
                _end += ::core::mem::size_of::<$type>();
            )*
            let size = ::core::mem::size_of::<$name>();
            let aligned = _end.next_multiple_of(<$name as $crate::gpu::GpuType>::ALIGN);
            assert!(size == aligned || size == _end.next_multiple_of(16));
        };
    };
}

/// The text before or after the elements of an array's type; empty for other types.
#[must_use]
pub const fn array<T: GpuType>(before: bool) -> &'static str {
    match (T::COUNT.is_empty(), before) {
        (true, _) => "",
        (false, true) => "array<",
        (false, false) => ", ",
    }
}
