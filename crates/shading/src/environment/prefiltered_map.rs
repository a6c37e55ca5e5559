//! A stack of images, one for each roughness, that owns them.

use alloc::vec::Vec;

use glam::Vec3;

use crate::direction::reflect;
use crate::environment::interface::Environment;
use crate::environment::latitude_longitude::LatitudeLongitude;
use crate::environment::prefiltered::{PrefilteredLevel, blend, check_alphas, prefiltered_radiance, split};
use crate::environment::split_sum::SplitSum;
use crate::parameter::{ParameterError, within};

/// The most rows of a level.
const MAX_ROWS: f32 = 8192.0;

/// A [`PrefilteredRef`](super::PrefilteredRef) that is made from an environment and owns its images.
///
/// ```
/// use asperity_shading::environment::{PrefilteredMap, SplitSum};
/// use asperity_shading::{EnvironmentMap, glam::Vec3};
///
/// let sky = EnvironmentMap::from_fn(64, 32, |w| Vec3::splat(if w.z > 0.0 { 1.0 } else { 0.0 }))?;
/// // Roughness and rows of each level.
/// let stack = PrefilteredMap::new(&sky, &[(0.0, 32), (0.2, 16), (0.6, 8)], 32)?;
/// assert!(stack.radiance(Vec3::X, 0.0).x < 0.6 && stack.radiance(Vec3::new(0.8, 0.0, -0.6), 0.6).x > 0.01);
/// let gold = stack.reflected(&SplitSum::new(), Vec3::new(1.0, 0.8, 0.3), 0.1, Vec3::Z, Vec3::new(0.6, 0.0, 0.8));
/// assert!(gold.x > gold.z);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PrefilteredMap {
    levels: Vec<Level>,
}

#[derive(Clone, Debug, PartialEq)]
struct Level {
    alpha: f32,
    rows: usize,
    texels: Vec<Vec3>,
    poles: [Vec3; 2],
}

impl PrefilteredMap {
    /// The stack of an environment: for each level its roughness and its rows, half as many as columns.
    ///
    /// Each texel is a sum over `points` pairs of samples. A level should have at least `2/α` rows, or those of the environment.
    ///
    /// # Errors
    /// [`ParameterError`] unless there are levels of 1 to 8192 `rows` whose roughness `alpha` is within [0, 1] and increases.
    pub fn new<E: Environment + ?Sized>(
        environment: &E,
        levels: &[(f32, usize)],
        points: u32,
    ) -> Result<Self, ParameterError> {
        check_alphas(levels.iter().map(|level| level.0))?;
        for &(_, rows) in levels {
            within("rows", rows as f32, [1.0, MAX_ROWS])?;
        }
        let level = |&(alpha, rows): &(f32, usize)| {
            let texel = |k: usize| {
                let direction = LatitudeLongitude::direction(2 * rows, rows, k % (2 * rows), k / (2 * rows));
                prefiltered_radiance(environment, alpha, direction, points)
            };
            let texels = (0..2 * rows * rows).map(texel).collect();
            let poles =
                [Vec3::Z, Vec3::NEG_Z].map(|pole| prefiltered_radiance(environment, alpha, pole, points));
            Level { alpha, rows, texels, poles }
        };
        Ok(Self { levels: levels.iter().map(level).collect() })
    }

    /// The levels, borrowed, from smooth to rough.
    pub fn levels(&self) -> impl Iterator<Item = PrefilteredLevel<'_>> {
        self.levels.iter().map(|level| PrefilteredLevel {
            alpha: level.alpha,
            image: LatitudeLongitude::from_parts(2 * level.rows, level.rows, &level.texels, level.poles),
        })
    }

    /// Prefiltered radiance by direction and roughness: [`PrefilteredRef::radiance`](super::PrefilteredRef::radiance).
    #[must_use]
    pub fn radiance(&self, direction: Vec3, alpha: f32) -> Vec3 {
        blend(self.levels(), direction, alpha)
    }

    /// Radiance of a GGX mirror: [`PrefilteredRef::reflected`](super::PrefilteredRef::reflected).
    #[must_use]
    pub fn reflected(&self, table: &SplitSum, f0: Vec3, alpha: f32, normal: Vec3, view: Vec3) -> Vec3 {
        self.radiance(reflect(view, normal), alpha) * split(table, f0, alpha, normal.dot(view))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::environment::environment_map::EnvironmentMap;
    use crate::environment::prefiltered::PrefilteredRef;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn it_is_what_it_borrows() {
        let sky = EnvironmentMap::from_fn(16, 8, |w| (w + 1.0) * 0.5).unwrap();
        let map = PrefilteredMap::new(&sky, &[(0.0, 8), (0.3, 4), (1.0, 2)], 16).unwrap();
        let levels: Vec<_> = map.levels().collect();
        let borrowed = PrefilteredRef::new(&levels).unwrap();
        let table = SplitSum::new();
        for alpha in [0.0, 0.2, 0.5, 1.0] {
            for w in [Vec3::X, Vec3::new(-0.36, 0.48, 0.8), Vec3::NEG_Z] {
                assert_eq!(map.radiance(w, alpha), borrowed.radiance(w, alpha));
                let reflected = map.reflected(&table, Vec3::ONE, alpha, Vec3::Z, w);
                assert_eq!(reflected, borrowed.reflected(&table, Vec3::ONE, alpha, Vec3::Z, w));
            }
        }
        assert_abs_diff_eq!(map.radiance(Vec3::Z, 0.0), sky.radiance(Vec3::Z), epsilon = 1e-6);
        for rows in [0, 8193] {
            let refused = PrefilteredMap::new(&sky, &[(0.0, 8), (0.3, rows)], 16).unwrap_err();
            assert_eq!(refused.parameter(), "rows", "{rows}");
        }
    }
}
