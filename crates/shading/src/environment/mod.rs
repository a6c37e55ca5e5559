//! Light from all around: images by latitude and longitude, their samples, and look-ups that are filtered beforehand.

#[cfg(feature = "alloc")]
mod environment_map;
mod environment_ref;
mod error;
mod importance;
mod latitude_longitude;
mod light;

#[cfg(feature = "alloc")]
pub use environment_map::EnvironmentMap;
pub use environment_ref::EnvironmentRef;
pub use error::EnvironmentError;
pub use latitude_longitude::LatitudeLongitude;
pub use light::Environment;
