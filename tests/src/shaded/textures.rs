//! Every texture of the lecture, in the light that shows it.

use asperity_shading::glam::Vec3;
use asperity_shading::{Brick, Lambert, Marble, StarWallpaper, bumped_normal, surface_gradient};

use super::Subject;
use super::light::on_facets;

/// Every texture.
#[must_use]
pub fn textures() -> Vec<Subject> {
    vec![brick(), bumped_brick(), stars(), marble()]
}

const VALID: &str = "parameters in range";

fn wall() -> Brick {
    Brick::new(0.5, 0.25, 0.04).expect(VALID)
}

fn brick() -> Subject {
    let wall = wall();
    Subject::new("brick", 8.0, move |pixel, _| {
        Vec3::new(0.5, 0.15, 0.14).lerp(Vec3::splat(0.5), wall.filtered(pixel.at, pixel.widths()).brick)
    })
}

fn bumped_brick() -> Subject {
    let wall = wall();
    let clay = Lambert::new(Vec3::splat(0.6)).expect(VALID);
    Subject::new("bumped brick", 8.0, move |pixel, sky| {
        let mut sum = Vec3::ZERO;
        wall.facets(pixel.at, pixel.widths(), |share, _, slope| {
            let gradient = surface_gradient(Vec3::Z, [Vec3::X, Vec3::Y], 0.02 * slope);
            let facet = [(share, bumped_normal(Vec3::Z, gradient))];
            sum += on_facets(sky, &clay, facet.into_iter(), pixel.view());
        });
        sum
    })
}

fn stars() -> Subject {
    let stars = StarWallpaper::new(5, [0.1, 0.3], 1.0, 0.55, 1).expect(VALID);
    Subject::new("stars", 8.0, move |pixel, _| {
        pixel.over(|tap, footprint| Vec3::splat(stars.coverage(tap.at, footprint.width())))
    })
}

fn marble() -> Subject {
    let marble = Marble::default();
    Subject::new("marble", 8.0, move |pixel, _| {
        pixel.over(|tap, footprint| marble.colour(tap.at.extend(0.3), footprint))
    })
}
