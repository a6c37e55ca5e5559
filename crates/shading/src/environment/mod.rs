//! Light from all around: images by latitude and longitude, their samples, and look-ups that are filtered beforehand.

mod distribution_2d;
#[cfg(feature = "alloc")]
mod environment_map;
mod environment_ref;
mod interface;
mod irradiance;
mod latitude_longitude;
mod low_discrepancy;
mod multiple_importance;
mod prefiltered;
#[cfg(feature = "alloc")]
mod prefiltered_map;
mod split_sum;

#[cfg(feature = "alloc")]
pub use environment_map::EnvironmentMap;
pub use environment_ref::EnvironmentRef;
pub use interface::Environment;
pub use irradiance::Irradiance;
pub use latitude_longitude::LatitudeLongitude;
pub use low_discrepancy::low_discrepancy_points;
pub use multiple_importance::{LightSample, light_samples, reflected_radiance};
pub use prefiltered::{PrefilteredLevel, PrefilteredRef, prefiltered_radiance};
#[cfg(feature = "alloc")]
pub use prefiltered_map::PrefilteredMap;
pub use split_sum::{SplitSum, split_sum};
