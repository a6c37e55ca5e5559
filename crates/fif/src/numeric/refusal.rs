//! Error types: an enum whose variants carry their messages.

/// Defines an error enum. A message names the parameter, its rule and the fields of its variant; `from E` adds the variant
/// `System` for a refusal by a layer below.
macro_rules! refusals {
    ($(#[$meta:meta])* $name:ident $(from $rule:ident)? {
        $($(#[$doc:meta])* $variant:ident $({ $($field:ident: $type:ty),* })? => $message:literal $(, $part:expr)*;)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        #[allow(missing_docs, reason = "the line and the message of a variant name its fields")]
        pub enum $name {
            $($(#[$doc])* $variant $({ $($field: $type),* })?,)*
            $(
                /// A rule of every system of maps is broken.
                System { error: $rule },
            )?
        }

        impl core::fmt::Display for $name {
            #[allow(unused_variables, reason = "a message need not print every field")]
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                match *self {
                    $(Self::$variant $({ $($field),* })? => write!(f, $message $(, $part)*),)*
                    $(Self::System { error } => <$rule as core::fmt::Display>::fmt(&error, f),)?
                }
            }
        }

        impl core::error::Error for $name {
            $(
                fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
                    match self {
                        Self::System { error } => {
                            let error: &$rule = error;
                            Some(error)
                        }
                        _ => None,
                    }
                }
            )?
        }

        $(
            impl From<$rule> for $name {
                fn from(error: $rule) -> Self {
                    Self::System { error }
                }
            }
        )?
    };
}

pub(crate) use refusals;
