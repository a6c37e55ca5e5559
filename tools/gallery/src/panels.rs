//! Panels of densities over the disk of normals, and images side by side.

use asperity_render::image::{Image, tone::ember, tone::hex};
use asperity_render::{light::background, materials::SharedNdf, scenes::peak};
use glam::Vec3;

use crate::figure::{Context, Panel};
use asperity::failure::Result;

/// Renders a function over the disk of normals, `n_y` up, with `√(value/peak)` in the colors of
/// [`ember`].
pub(crate) fn disk(context: &Context<'_>, peak: f32, value: impl Fn(Vec3) -> f32 + Sync) -> Result<Image> {
    /// Radius of the disk, relative to half of the image.
    const RADIUS: f32 = 0.86;
    let side = context.size as f32;
    let (half, rim) = (0.5 * side * RADIUS, hex(0x8b_8d96));
    context.render(context.square(), |px, py| {
        let (x, y) = ((px - 0.5 * side) / half, (0.5 * side - py) / half);
        let r2 = x * x + y * y;
        if r2 < 1.0 {
            ember((value(Vec3::new(x, y, (1.0 - r2).sqrt())) / peak).max(0.0).sqrt())
        } else if (r2.sqrt() - 1.0) * half < side / 384.0 {
            rim
        } else {
            background(px / side, py / side)
        }
    })
}

/// Renders the density over the map of normals.
pub(crate) fn density_panel(context: &Context<'_>, ndf: &SharedNdf, stem: &str, name: &str) -> Result<Panel> {
    let image = disk(context, peak(|m| ndf.d(m)), |m| ndf.d(m))?;
    let alt = format!("The density {name} over the disk of normals, brightest at its peak.");
    Ok(Panel::new(stem, format!("the NDF: {name}"), alt, image))
}

/// Places images of equal height in a row.
pub(crate) fn side_by_side(pictures: &[Image], gap: u32, between: Vec3) -> Image {
    let [width, height] = pictures.first().map_or([1, 1], |picture| [picture.width, picture.height]);
    let step = width + gap;
    let across = (step * pictures.len() as u32).saturating_sub(gap);
    Image::from_fn(across, height, |x, y| {
        let picture = &pictures[(x / step) as usize];
        if x % step < width { picture.pixels[(y * width + x % step) as usize] } else { between }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::quality::Quality;
    use asperity_render::integrator::pixels::Watch;

    #[test]
    fn disk_has_n_y_up() {
        let goal = Quality::Draft.fineness().goal();
        let context =
            Context { size: 64, samples_per_pixel: 1, goal, seed: 1, drivers: false, watch: Watch::unseen() };
        let image = disk(&context, 1.0, |m| m.y.max(0.0)).unwrap();
        let row = |y: usize| image.pixels[64 * y + 32].x;
        assert!(row(8) > 4.0 * row(56));
    }

    #[test]
    fn side_by_side_places_images_in_a_row() {
        let plain = |value| Image::from_fn(2, 2, |_, _| Vec3::splat(value));
        let row = side_by_side(&[plain(1.0), plain(2.0)], 1, Vec3::ZERO);
        assert_eq!([row.width, row.height], [5, 2]);
        assert_eq!([5, 6, 7, 8, 9].map(|k| row.pixels[k].x), [1.0, 1.0, 0.0, 2.0, 2.0]);
    }
}
