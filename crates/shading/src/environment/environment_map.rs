//! An environment map with importance sampling by brightness.

#[cfg(feature = "alloc")]
use alloc::{vec, vec::Vec};
use core::ops::Deref;

use glam::{Vec2, Vec3};

use crate::environment::distribution_2d::{Tables, fill, table_len};
use crate::environment::interface::{Environment, uniform_sphere};
use crate::environment::latitude_longitude::LatitudeLongitude;
#[cfg(feature = "alloc")]
use crate::environment::latitude_longitude::MAX_TEXELS;
use crate::error::ShadingError;
#[cfg(feature = "alloc")]
use crate::image::texel_count;
use crate::image::{Entries, check_len};

/// A latitude–longitude image with a table for importance sampling.
///
/// [`new`](Self::new) and [`from_fn`](Self::from_fn) own both,
/// [`from_borrowed`](Self::from_borrowed) borrows them.
///
/// ```text
/// p(ω) = l(φ, z)/∫ l dω,   l bilinear in longitude and in height z between the centers of the texels
/// ```
///
/// - **Lookup:** see [`LatitudeLongitude`].
/// - **Density:** `l` is the mean of the three channels. Along a row the density is proportional to
///   the brightness. Between rows it is linear in z where the lookup is linear in the angle, which
///   keeps everything in closed form: the marginal CDF over z and the conditional CDF over
///   longitude are quadratic between centers, and inverted exactly. The density is positive
///   wherever the image is bright. Its integral is 1. A black image is sampled uniformly.
/// - **Accuracy:** sums are computed in `f64` and stored in `f32`. A texel with less than 10⁻⁷ of
///   the light of its row may get too few samples.
///
/// The marginal and conditional CDFs are those of Pharr, Jakob, Humphreys 2023, *Physically Based
/// Rendering*, 4th edition, §12.5, with bilinear instead of constant texels.
///
#[cfg_attr(feature = "alloc", doc = "```")]
#[cfg_attr(not(feature = "alloc"), doc = "```ignore")]
/// use asperity_shading::{Environment, EnvironmentMap, glam::{Vec2, Vec3}};
///
/// let sky = EnvironmentMap::from_fn(64, 32, |w| Vec3::new(0.3, 0.5, 1.0) * w.z.max(0.1))?;
/// assert!(sky.radiance(Vec3::Z).z > sky.radiance(Vec3::X).z);
/// assert!(sky.pdf(sky.sample(Vec2::new(0.2, 0.7))) > 0.0);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[doc(alias = "hdri")]
#[doc(alias = "ibl")]
#[doc(alias = "skybox")]
#[doc(alias = "equirectangular")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnvironmentMap<S = Entries<Vec3>, T = Entries<f32>> {
    image: LatitudeLongitude<S>,
    table: T,
    total: f32,
}

impl<'a> EnvironmentMap<&'a [Vec3], &'a [f32]> {
    /// The length of the table of an image of this size; 0 for an invalid size.
    #[must_use]
    pub const fn table_len(width: usize, height: usize) -> usize {
        match table_len(width, height) {
            Ok(len) => len,
            Err(_) => 0,
        }
    }

    /// Creates the environment of borrowed texels and fills `table`.
    ///
    /// # Errors
    /// See [`LatitudeLongitude::new`]; also a table whose length is not
    /// [`table_len`](Self::table_len).
    ///
    /// ```
    /// use asperity_shading::{Environment, EnvironmentMap, glam::{Vec2, Vec3}};
    ///
    /// // A sky with a sun.
    /// let mut texels = [Vec3::new(0.2, 0.4, 0.9); 16 * 8];
    /// texels[2 * 16 + 8] = Vec3::splat(5000.0);
    /// let mut table = [0.0; EnvironmentMap::table_len(16, 8)];
    /// let sky = EnvironmentMap::from_borrowed(16, 8, &texels, &mut table)?;
    ///
    /// let towards_sun = sky.sample(Vec2::new(0.5, 0.5));
    /// assert!(sky.radiance(towards_sun).x > 100.0);
    /// // The uniform density is 0.08 sr⁻¹.
    /// assert!(sky.pdf(towards_sun) > 1.0 && sky.pdf(Vec3::NEG_Z) < 0.001);
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    pub fn from_borrowed(
        width: usize,
        height: usize,
        texels: &'a [Vec3],
        table: &'a mut [f32],
    ) -> Result<Self, ShadingError> {
        let image = LatitudeLongitude::new(width, height, texels)?;
        check_len("table", table_len(width, height)?, table.len())?;
        let total = fill(image, table);
        Ok(Self { image, table, total })
    }
}

#[cfg(feature = "alloc")]
impl EnvironmentMap<Vec<Vec3>, Vec<f32>> {
    /// Creates the environment of these texels, in the layout of [`LatitudeLongitude`].
    ///
    /// # Errors
    /// See [`LatitudeLongitude::new`].
    pub fn new(width: usize, height: usize, texels: Vec<Vec3>) -> Result<Self, ShadingError> {
        let image = LatitudeLongitude::new(width, height, texels)?;
        let mut table = vec![0.0; table_len(width, height)?];
        let total = fill(image.view(), &mut table);
        Ok(Self { image, table, total })
    }

    /// Creates the environment of a function of unit directions, evaluated at the centers of the
    /// texels.
    ///
    /// # Errors
    /// See [`EnvironmentMap::new`].
    pub fn from_fn(
        width: usize,
        height: usize,
        mut f: impl FnMut(Vec3) -> Vec3,
    ) -> Result<Self, ShadingError> {
        let mut texels = Vec::with_capacity(texel_count(width, height, MAX_TEXELS)?);
        for (row, column) in (0..height).flat_map(|row| (0..width).map(move |column| (row, column))) {
            texels.push(f(LatitudeLongitude::direction(width, height, column, row)));
        }
        Self::new(width, height, texels)
    }
}

impl<S: Deref<Target = [Vec3]>, T: Deref<Target = [f32]>> EnvironmentMap<S, T> {
    /// Borrowed view of the environment.
    #[must_use]
    pub fn view(&self) -> EnvironmentMap<&[Vec3], &[f32]> {
        EnvironmentMap { image: self.image.view(), table: &self.table, total: self.total }
    }

    /// The integral of the mean of the channels over the sphere.
    #[must_use]
    pub const fn total(&self) -> f32 {
        self.total
    }

    /// Whether there is enough light to draw samples from.
    #[inline]
    const fn is_lit(&self) -> bool {
        self.total > f32::MIN_POSITIVE
    }

    fn tables(&self) -> Tables<'_> {
        let (rows, strips) = self.table.split_at_checked(self.image.texels().len()).unwrap_or((&[], &[]));
        Tables { image: self.image.view(), rows, strips, total: self.total }
    }
}

impl<S: Deref<Target = [Vec3]>, T: Deref<Target = [f32]>> Environment for EnvironmentMap<S, T> {
    #[inline]
    fn radiance(&self, direction: Vec3) -> Vec3 {
        self.image.radiance(direction)
    }

    fn sample(&self, u: Vec2) -> Vec3 {
        if self.is_lit() { self.tables().sample(u) } else { uniform_sphere(u) }
    }

    fn pdf(&self, direction: Vec3) -> f32 {
        match self.image.place(direction) {
            Some(place) if self.is_lit() => self.tables().density(place),
            _ => self.image.pdf(direction),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use asperity_core::assert_abs_diff_eq;
    use core::f32::consts::FRAC_1_PI;
    use std::string::ToString;

    #[test]
    fn black_image_is_sampled_uniformly() {
        let (texels, mut table) = ([Vec3::ZERO; 8], [0.0; EnvironmentMap::table_len(4, 2)]);
        let night = EnvironmentMap::from_borrowed(4, 2, &texels, &mut table).unwrap();
        assert_eq!(night.pdf(night.sample(Vec2::new(0.3, 0.6))), 0.25 * FRAC_1_PI);
        assert_eq!(night.pdf(Vec3::NAN), 0.0);
    }

    #[test]
    fn samples_are_unit_and_have_density() {
        let mut texels = [Vec3::ZERO; 32];
        texels[0] = Vec3::X;
        texels[21] = Vec3::new(0.0, 3.0, 1e20);
        let odd = [f32::NAN, f32::NEG_INFINITY, -1.0, 0.0, 1e-30, 0.2, 0.5, 0.999_999_9, 1.0, f32::INFINITY];
        for (width, height) in [(8, 4), (4, 8), (1, 32), (32, 1)] {
            let mut table = [0.0; 96];
            let table = &mut table[..EnvironmentMap::table_len(width, height)];
            let map = EnvironmentMap::from_borrowed(width, height, &texels, table).unwrap();
            for (x, y) in odd.into_iter().flat_map(|x| odd.map(|y| (x, y))) {
                let w = map.sample(Vec2::new(x, y));
                assert_abs_diff_eq!(w.length(), 1.0, epsilon = 1e-6, "{width} × {height}, {x}, {y}");
                let density = map.pdf(w);
                assert!(density >= 0.0 && density.is_finite(), "{width} × {height}, {x}, {y}: {density}");
                // At u = 0 it is on the border of the light.
                if x > 1e-3 && y > 1e-3 && x < 0.9 && y < 0.9 {
                    assert!(density > 0.0, "{width} × {height}, {x}, {y}: {w}");
                }
            }
        }
    }

    #[test]
    fn uniform_light_has_uniform_density() {
        let (texels, mut table) = ([Vec3::splat(3.0); 72], [0.0; EnvironmentMap::table_len(12, 6)]);
        let map = EnvironmentMap::from_borrowed(12, 6, &texels, &mut table).unwrap();
        assert_abs_diff_eq!(map.total(), 3.0 * 4.0 / FRAC_1_PI, epsilon = 1e-4);
        for k in 0..100 {
            let w = uniform_sphere(Vec2::new(0.37 * k as f32 % 1.0, k as f32 / 99.0));
            assert_abs_diff_eq!(map.pdf(w), 0.25 * FRAC_1_PI, epsilon = 1e-7);
        }
    }

    #[test]
    fn new_rejects_a_table_of_wrong_length() {
        let texels = [Vec3::ONE; 8];
        let refused = EnvironmentMap::from_borrowed(4, 2, &texels, &mut [0.0; 12]).unwrap_err();
        assert_eq!(refused.to_string(), "`table` must have 11 elements, got 12");
        assert_eq!(EnvironmentMap::table_len(0, 7), 0);
    }
}
