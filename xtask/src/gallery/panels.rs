//! Panels of densities over the disk of normals and pictures side by side.

use asperity_render::{image::Image, integrator::hemisphere::hemisphere, materials::SharedNdf, scenes::peak};
use glam::Vec3;

use crate::failure::Result;
use crate::gallery::figure::{Context, Panel};

/// A function over the disk of normals, in colours up to its peak.
pub(crate) fn disk(context: &Context<'_>, peak: f32, value: impl Fn(Vec3) -> f32 + Sync) -> Result<Image> {
    hemisphere(context.square(), peak, context.progress, context.interrupted, value)
}

/// The density over the map of normals.
pub(crate) fn density_panel(context: &Context<'_>, ndf: &SharedNdf, stem: &str, name: &str) -> Result<Panel> {
    let image = disk(context, peak(|m| ndf.density(m)), |m| ndf.density(m))?;
    let alt = format!("The density {name} over the disk of normals, brightest at its peak.");
    Ok(Panel::new(stem, format!("the NDF: {name}"), alt, image))
}

/// Pictures of equal heights in a row.
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

    #[test]
    fn pictures_stand_side_by_side() {
        let plain = |value| Image::from_fn(2, 2, |_, _| Vec3::splat(value));
        let row = side_by_side(&[plain(1.0), plain(2.0)], 1, Vec3::ZERO);
        assert_eq!([row.width, row.height], [5, 2]);
        assert_eq!([0, 1, 2, 3, 4].map(|x| row.at(x, 1).x), [1.0, 1.0, 0.0, 2.0, 2.0]);
    }
}
