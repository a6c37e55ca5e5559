//! Environment light: latitude–longitude images, importance sampling, and prefiltered lookups.

mod distribution_2d;
mod environment_map;
mod interface;
mod irradiance;
mod latitude_longitude;
mod multiple_importance;
mod prefiltered;
mod split_sum;

pub use crate::low_discrepancy::low_discrepancy_points;
pub use environment_map::EnvironmentMap;
pub use interface::Environment;
pub use irradiance::Irradiance;
pub use latitude_longitude::LatitudeLongitude;
pub use multiple_importance::{LightSample, light_samples, reflected_radiance};
pub use prefiltered::{PrefilteredLevel, PrefilteredMap, prefiltered_radiance};
pub use split_sum::{SplitSum, split_sum};
