//! Windows into the plane for noise figures, and values as gray.

use asperity_render::image::{Image, tone::linear};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Panel};
use crate::power_spectrum::PowerSpectrum;
use asperity::failure::Result;

/// A square window into the plane, y up, and its pixels.
#[derive(Clone, Copy)]
pub(super) struct Window {
    /// The lower left corner.
    pub(super) corner: Vec2,
    /// The side in cells of the first octave.
    pub(super) cells: f32,
    /// The side in pixels.
    pub(super) side: usize,
}

impl Window {
    /// Creates a window of the figure's size, away from the origin.
    pub(super) fn new(context: &Context<'_>, cells: f32) -> Self {
        Self { corner: Vec2::new(13.4, -7.7), cells, side: context.size as usize }
    }

    /// Returns the distance between neighboring pixels.
    pub(super) fn step(&self) -> f32 {
        self.cells / self.side as f32
    }

    /// Returns the center of the pixel in column `x` and row `y`, counted from the top left.
    pub(super) fn point(&self, x: usize, y: usize) -> Vec2 {
        self.corner + self.step() * Vec2::new(x as f32 + 0.5, (self.side - y) as f32 - 0.5)
    }

    /// Evaluates `f` at every pixel, row by row from the top, independent of the number of threads.
    pub(super) fn map<T: Send>(&self, context: &Context<'_>, f: impl Fn(Vec2) -> T + Sync) -> Result<Vec<T>> {
        context.rows(self.side, |y| (0..self.side).map(|x| f(self.point(x, y))).collect::<Vec<_>>())
    }

    /// Returns the mean power spectrum of `2 · pairs` fields over the window; `field` returns the
    /// k-th.
    pub(super) fn spectrum<F: Fn(Vec2) -> f32 + Sync>(
        &self,
        context: &Context<'_>,
        pairs: usize,
        field: impl Fn(u32) -> F + Sync,
    ) -> Result<PowerSpectrum> {
        let nothing = |_| vec![0.0; self.side * self.side];
        // An interruption is reported after the sum.
        let sample = |k: usize| self.map(context, field(k as u32)).unwrap_or_else(nothing);
        let spectrum = PowerSpectrum::mean(self.side, f64::from(self.step()), pairs, sample);
        context.checkpoint()?;
        Ok(spectrum)
    }

    /// Renders a panel of the window from the colors of its points.
    pub(super) fn draw(
        &self,
        context: &Context<'_>,
        words: [&str; 3],
        color: impl Fn(Vec2) -> Vec3 + Sync,
    ) -> Result<Panel> {
        let colors = self.map(context, color)?;
        Ok(self.panel(words, |i| colors[i]))
    }

    /// Renders a panel of the window, one color per pixel.
    pub(super) fn panel(&self, [stem, label, alt]: [&str; 3], color: impl Fn(usize) -> Vec3 + Sync) -> Panel {
        let side = self.side as u32;
        Panel::new(stem, label, alt, Image::from_fn(side, side, |x, y| color((y * side + x) as usize)))
    }
}

/// Maps a point of the plane to a tilted plane in space, which intersects no lattice plane along a
/// line.
pub(super) fn slanted(p: Vec2) -> Vec3 {
    Vec3::new(0.3, 5.2, -8.6) + Vec3::new(0.6, -0.48, 0.64) * p.x + Vec3::new(0.0, 0.8, 0.6) * p.y
}

/// Returns the gray of perceived brightness `t`: 0 is black, 1 white.
pub(super) fn gray(t: f32) -> Vec3 {
    Vec3::splat(linear(t.clamp(0.0, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_run_downward() {
        let window = Window { corner: Vec2::new(1.0, 2.0), cells: 4.0, side: 16 };
        assert_eq!(window.point(0, 0), Vec2::new(1.125, 5.875));
        assert_eq!(window.point(15, 15), Vec2::new(4.875, 2.125));
    }
}
