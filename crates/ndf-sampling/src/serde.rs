//! Serialization of NDFs by the crate `serde`.

/// Implements serialization of the constructor's arguments, read through the constructor.
///
/// Expands to nothing without the feature `serde`.
macro_rules! written {
    ($type:ty, |$value:ident| { $($field:ident: $get:expr),+ }) => {
        #[cfg(feature = "serde")]
        const _: () = {
            #[derive(::serde::Serialize, ::serde::Deserialize)]
            #[serde(deny_unknown_fields)]
            struct Arguments {
                $($field: f32,)+
            }

            impl ::serde::Serialize for $type {
                fn serialize<S: ::serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                    let $value = self;
                    ::serde::Serialize::serialize(&Arguments { $($field: $get),+ }, serializer)
                }
            }

            impl<'de> ::serde::Deserialize<'de> for $type {
                fn deserialize<D: ::serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                    let Arguments { $($field),+ } = ::serde::Deserialize::deserialize(deserializer)?;
                    Self::new($($field),+).map_err(::serde::de::Error::custom)
                }
            }
        };
    };
}
pub(crate) use written;
