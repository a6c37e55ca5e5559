//! The distribution of the normals of a height field over a rectangle, as an image.

use alloc::vec::Vec;
use asperity_core::Interval;
use glam::DVec2;

use crate::surface::bounds::upward_normal;
use crate::surface::height_field::curve::Curve;
use crate::surface::height_field::function::Function;
use crate::surface::height_field::height_field::HeightField;
use crate::system::error::FifError;

/// The largest count of normals per texel that is exact in `f32`: 2²⁴.
const MOST: usize = 4096;

impl<F: Function, G: Function> HeightField<F, G> {
    /// The density of the unit normals over the rectangle `x × y`, per `dn_x dn_y`.
    ///
    /// The result is an image in rows of `width` columns.
    ///
    /// ```text
    /// texel j·width + i covers [i, i+1]/width × [j, j+1]/height of ((n_x + 1)/2, (n_y + 1)/2);   Σ texels · 4/(width·height) = 1
    /// ```
    ///
    /// The first row has `n_y = −1`. This is the layout of a map of normals that are counted over
    /// the macro surface, so the texels can be passed to an importance sampler of NDFs given as
    /// images.
    ///
    /// The normals are those at `samples × samples` points, one in each cell of a uniform grid on
    /// the rectangle. A texel is exact up to the fraction of the cells cut by its border. Along an
    /// axis with a rough slope, such as the integral of `g` of the source, it is as accurate as
    /// `samples` independent ones: 512 yield the mean slope within 0.03.
    ///
    /// ```
    /// use asperity_fif::{HeightField, Interval, cochran_2000};
    /// let whole = Interval::new(0.0, 2.0);
    /// let mut texels = [0.0; 32 * 32];
    /// HeightField::new(cochran_2000::f_hat()?, cochran_2000::f_hat()?).normal_distribution([whole, whole], 64, [32, 32], &mut texels)?;
    /// let total: f32 = texels.iter().sum();
    /// assert!((total * 4.0 / 1024.0 - 1.0).abs() < 1e-5);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FifError`]: an axis without slopes, a wrong length, no samples, an invalid
    /// rectangle.
    pub fn normal_distribution(
        &self,
        [x, y]: [Interval; 2],
        samples: usize,
        [width, height]: [usize; 2],
        texels: &mut [f32],
    ) -> Result<(), FifError> {
        let len = texels.len();
        if len == 0 || width.checked_mul(height) != Some(len) {
            return Err(FifError::Length {
                parameter: "texels",
                expected: width.saturating_mul(height).max(1),
                got: len,
            });
        }
        if !(1..=MOST).contains(&samples) {
            return Err(FifError::OutOfRange { parameter: "samples", value: samples, min: 1, max: MOST });
        }
        let (f, g) = (points(&self.x, x, samples)?, points(&self.y, y, samples)?);
        texels.fill(0.0);
        let column = |n: f64, count: usize| ((0.5 * (n + 1.0) * count as f64) as usize).min(count - 1);
        for &[g, g_slope] in &g {
            for &[f, f_slope] in &f {
                let normal = upward_normal(DVec2::new(f_slope * g, f * g_slope));
                let (i, j) = (column(normal.x, width), column(normal.y, height));
                if let Some(texel) = texels.get_mut(j * width + i) {
                    *texel += 1.0;
                }
            }
        }
        let density = 0.25 * len as f64 / (samples * samples) as f64;
        for texel in texels {
            *texel = (f64::from(*texel) * density) as f32;
        }
        Ok(())
    }
}

/// Value and slope at one point of each of `samples` equal cells.
fn points<F: Function>(axis: &Curve<F>, over: Interval, samples: usize) -> Result<Vec<[f64; 2]>, FifError> {
    // Not the centers: on equally spaced knots these are knots of some level, where all finer
    // levels of the function vanish.
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let over = over.intersection(axis.domain());
    // NaN overlaps nothing.
    let meets = over.lo <= over.hi;
    if !meets {
        return Err(FifError::Empty);
    }
    (0..samples)
        .map(|i| {
            let x = over.lo + over.width() * ((i as f64 + GOLDEN) / samples as f64);
            let slope = axis.slope(x).ok_or(FifError::Rough)?;
            Ok([axis.evaluate(x, 0.0).value, slope])
        })
        .collect()
}
