//! Macros of the Asperity crates.

/// Defines an error enum, its messages and its traits.
///
/// A message names the parameter, its rule and the fields of its variant.
#[macro_export]
macro_rules! error_enum {
    ($(#[$meta:meta])* pub enum $name:ident {
        $($(#[$doc:meta])* $variant:ident $({ $($field:ident: $type:ty),* })? => $message:literal $(, $part:expr)*;)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        #[allow(missing_docs, reason = "the line and the message of a variant name its fields")]
        pub enum $name {
            $($(#[$doc])* $variant $({ $($field: $type),* })?,)*
        }

        impl core::fmt::Display for $name {
            #[allow(unused_variables, reason = "a message need not print every field")]
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                match *self {
                    $(Self::$variant $({ $($field),* })? => write!(f, $message $(, $part)*),)*
                }
            }
        }

        impl core::error::Error for $name {}
    };
}

/// Implements the traits of `approx` for types, part by part, with one tolerance.
///
/// The calling crate must depend on `approx`, and its float type must implement the traits:
/// `impl_approx! { f32; Size: s => s.width, s.height; }`.
#[macro_export]
macro_rules! impl_approx {
    ($float:ty; $($type:ty: $value:ident => $($part:expr),*;)*) => {$(
        impl ::approx::AbsDiffEq for $type {
            type Epsilon = $float;

            fn default_epsilon() -> $float {
                <$float>::EPSILON
            }

            fn abs_diff_eq(&self, other: &Self, epsilon: $float) -> bool {
                true $(&& {
                    let part = |$value: &Self| $part;
                    ::approx::AbsDiffEq::abs_diff_eq(&part(self), &part(other), epsilon)
                })*
            }
        }

        impl ::approx::RelativeEq for $type {
            fn default_max_relative() -> $float {
                <$float>::EPSILON
            }

            fn relative_eq(&self, other: &Self, epsilon: $float, max_relative: $float) -> bool {
                true $(&& {
                    let part = |$value: &Self| $part;
                    ::approx::RelativeEq::relative_eq(&part(self), &part(other), epsilon, max_relative)
                })*
            }
        }

        impl ::approx::UlpsEq for $type {
            fn default_max_ulps() -> u32 {
                4
            }

            fn ulps_eq(&self, other: &Self, epsilon: $float, max_ulps: u32) -> bool {
                true $(&& {
                    let part = |$value: &Self| $part;
                    ::approx::UlpsEq::ulps_eq(&part(self), &part(other), epsilon, max_ulps)
                })*
            }
        }
    )*};
}

/// `approx::assert_abs_diff_eq!` with a message, for tests of crates that depend on `approx`.
#[macro_export]
macro_rules! assert_abs_diff_eq {
    ($given:expr, $expected:expr, epsilon = $epsilon:expr $(,)?) => {
        ::approx::assert_abs_diff_eq!($given, $expected, epsilon = $epsilon)
    };
    ($given:expr, $expected:expr, epsilon = $epsilon:expr, $($message:tt)+) => {
        match (&$given, &$expected, $epsilon) {
            (given, expected, epsilon) => assert!(
                ::approx::AbsDiffEq::abs_diff_eq(given, expected, epsilon),
                "{}: {given:?} is not {expected:?} within {epsilon:?}",
                format_args!($($message)+),
            ),
        }
    };
}

#[cfg(feature = "approx")]
pub(crate) use impl_approx;
