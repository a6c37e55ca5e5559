//! Every texture and material on a plane to the horizon: one sample a pixel, plain and filtered, against 1024.

use asperity_render::image::Image;
use asperity_render::shaded::{Horizon, Seen, Sky, errors, materials, textures};
use glam::Vec3;

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};

const PICTURE: Horizon = Horizon { width: 60, height: 40 };

/// Pixels of the page for each of the picture's, and between its parts.
const SIDE: u32 = 6;
const GAP: u32 = 8;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let sky = Sky::about(Vec3::new(-0.48, 0.6, 0.64));
    let (mut panels, mut rows) = (Vec::new(), Vec::new());
    for subject in textures().into_iter().chain(materials()) {
        let seen = context.rows(PICTURE.height as usize, |y| {
            (0..PICTURE.width).map(|x| PICTURE.seen([x, y as u32], &subject, &sky)).collect::<Vec<_>>()
        })?;
        let [plain, filtered] = errors(&seen);
        let ratio = format!("{:.2}", filtered / plain);
        let name = subject.name;
        panels.push(Panel::raster(
            name.replace(", ", "-").replace(' ', "-"),
            format!("{name}: {ratio}"),
            format!("A plane of {name} to the horizon, plain, filtered, and by 1024 samples"),
            triple(&seen),
        ));
        rows.push([name.to_owned(), format!("{plain:.4}"), format!("{filtered:.4}"), ratio]);
    }
    let picture = format!("{} × {} pixels, 1024 samples in the mean", PICTURE.width, PICTURE.height);
    Ok(Drawn::new(2, panels)
        .fact("picture", picture)
        .fact("filter", "exact boxes, or up to 32 taps along the pixel's ellipse")
        .table(["surface", "error of a plain sample", "of a filtered one", "ratio"], rows))
}

/// The three pictures side by side, as bright as their mean allows, with visible pixels.
fn triple(seen: &[Seen]) -> Image {
    let mut light: Vec<f32> = seen.iter().map(|pixel| pixel.mean.max_element()).collect();
    light.sort_by(f32::total_cmp);
    let bright = light.get(light.len() * 19 / 20).copied().unwrap_or(1.0).max(1e-6);
    let (width, height) = (PICTURE.width * SIDE, PICTURE.height * SIDE);
    Image::from_fn(3 * width + 2 * GAP, height, |x, y| {
        let (part, x) = (x / (width + GAP), x % (width + GAP));
        let place = (y / SIDE) * PICTURE.width + x / SIDE;
        match seen.get(place as usize) {
            Some(pixel) if x < width => {
                [pixel.plain, pixel.filtered, pixel.mean][part.min(2) as usize] * (0.75 / bright)
            }
            _ => Vec3::ONE,
        }
    })
}
