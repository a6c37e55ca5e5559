//! An environment that owns its image and the table of its samples.

use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use crate::environment::distribution_2d::{fill, table_len};
use crate::environment::environment_ref::EnvironmentRef;
use crate::environment::interface::Environment;
use crate::environment::latitude_longitude::{LatitudeLongitude, MAX_TEXELS};
use crate::image::{ImageError, texel_count};

/// An [`EnvironmentRef`] that owns its texels and its table.
///
/// ```
/// use asperity_shading::{Environment, EnvironmentMap, glam::{Vec2, Vec3}};
///
/// let sky = EnvironmentMap::from_fn(64, 32, |w| Vec3::new(0.3, 0.5, 1.0) * w.z.max(0.1))?;
/// assert!(sky.radiance(Vec3::Z).z > sky.radiance(Vec3::X).z);
/// assert!(sky.density(sky.sample(Vec2::new(0.2, 0.7))) > 0.0);
/// # Ok::<(), asperity_shading::ImageError>(())
/// ```
#[doc(alias = "hdri")]
#[doc(alias = "ibl")]
#[doc(alias = "skybox")]
#[doc(alias = "equirectangular")]
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentMap {
    width: usize,
    height: usize,
    texels: Vec<Vec3>,
    poles: [Vec3; 2],
    table: Vec<f32>,
    total: f32,
}

impl EnvironmentMap {
    /// The environment of these texels, laid out as in [`LatitudeLongitude`].
    ///
    /// # Errors
    /// The errors of [`LatitudeLongitude::new`].
    pub fn new(width: usize, height: usize, texels: Vec<Vec3>) -> Result<Self, ImageError> {
        let image = LatitudeLongitude::new(width, height, &texels)?;
        let mut table = vec![0.0; table_len(width, height)?];
        let total = fill(&image, &mut table);
        let poles = image.poles();
        Ok(Self { width, height, texels, poles, table, total })
    }

    /// The environment of a function of unit directions, taken at the centres of the texels.
    ///
    /// # Errors
    /// The errors of [`EnvironmentMap::new`].
    pub fn from_fn(width: usize, height: usize, mut f: impl FnMut(Vec3) -> Vec3) -> Result<Self, ImageError> {
        let mut texels = Vec::with_capacity(texel_count(width, height, MAX_TEXELS)?);
        for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column))) {
            texels.push(f(LatitudeLongitude::direction(width, height, column, row)));
        }
        Self::new(width, height, texels)
    }

    /// Borrowed view of the environment.
    #[must_use]
    pub fn as_ref(&self) -> EnvironmentRef<'_> {
        let image = LatitudeLongitude::from_parts(self.width, self.height, &self.texels, self.poles);
        EnvironmentRef::from_parts(image, &self.table, self.total)
    }
}

impl Environment for EnvironmentMap {
    #[inline]
    fn radiance(&self, direction: Vec3) -> Vec3 {
        self.as_ref().radiance(direction)
    }

    #[inline]
    fn sample(&self, u: Vec2) -> Vec3 {
        self.as_ref().sample(u)
    }

    #[inline]
    fn density(&self, direction: Vec3) -> f32 {
        self.as_ref().density(direction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_what_it_borrows() {
        let map = EnvironmentMap::from_fn(8, 4, |w| (w + 1.0) * 0.5).unwrap();
        let mut table = [0.0; EnvironmentRef::table_len(8, 4)];
        let borrowed = EnvironmentRef::new(8, 4, &map.texels, &mut table).unwrap();
        assert_eq!(map.as_ref(), borrowed);
        for w in [Vec3::X, Vec3::new(-0.3, -0.2, 0.9), Vec3::NEG_Z, Vec3::NAN] {
            assert_eq!(map.radiance(w), borrowed.radiance(w));
            assert_eq!(map.density(w), borrowed.density(w));
        }
        assert_eq!(map.sample(Vec2::splat(0.4)), borrowed.sample(Vec2::splat(0.4)));
        assert!(EnvironmentMap::from_fn(2, 2, |w| w).is_err());
    }
}
