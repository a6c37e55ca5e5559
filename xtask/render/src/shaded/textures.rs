//! Every texture of the lecture, in the light that shows it.

use asperity_shading::bump::Facet;
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::noise::removed_share;
use asperity_shading::{
    Bevel, Brick, Edge, Gas, Lambert, Marble, PerturbedTexture, StarWallpaper, bumped_normal, march,
    surface_gradient,
};

use crate::shaded::Subject;
use crate::shaded::light::on_facets;

/// Every texture.
#[must_use]
pub fn textures() -> Vec<Subject> {
    vec![brick(), bumped_brick(), bevel(), stars(), perturbed(), marble(), gas()]
}

const VALID: &str = "parameters in range";

fn wall() -> Brick {
    Brick::new(0.5, 0.25, 0.04).expect(VALID)
}

fn brick() -> Subject {
    let wall = wall();
    Subject::new("brick", 8.0, move |pixel, _| {
        Vec3::splat(0.5).lerp(Vec3::new(0.5, 0.15, 0.14), wall.filtered(pixel.at, pixel.widths()).brick)
    })
}

fn bumped_brick() -> Subject {
    let wall = wall();
    let clay = Lambert::new(Vec3::splat(0.6)).expect(VALID);
    Subject::new("bumped brick", 8.0, move |pixel, sky| {
        let mut sum = Vec3::ZERO;
        wall.facets(pixel.at, pixel.widths(), |share, _, slope| {
            let gradient = surface_gradient(Vec3::Z, [Vec3::X, Vec3::Y], 0.02 * slope);
            let facet = [Facet::new(share, bumped_normal(Vec3::Z, gradient))];
            sum += on_facets(sky, &clay, facet.into_iter(), pixel.view());
        });
        sum
    })
}

/// Square tiles with a ridge along their edges.
fn bevel() -> Subject {
    let bevel = Bevel::new(0.03, 0.2, 0.2, 0.9).expect(VALID);
    let clay = Lambert::new(Vec3::splat(0.6)).expect(VALID);
    let tile = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    Subject::new("bevel", 8.0, move |pixel, sky| {
        pixel.over(|tap, footprint| {
            let mut sum = Vec3::ZERO;
            let mut lit = |share: f32, slope: Vec2| {
                let normal = bumped_normal(Vec3::Z, slope.extend(0.0));
                sum += on_facets(sky, &clay, [Facet::new(share, normal)].into_iter(), tap.view());
            };
            let width = footprint.width();
            let far = removed_share(width, 1.0);
            if far < 1.0 {
                let Edge { distance, away } =
                    Edge::nearest(&tile, tap.at - tap.at.floor()).expect("four edges");
                let [low, high] = [distance - 0.5 * width, distance + 0.5 * width];
                // What lies beyond the edge is the next tile's ridge.
                let beyond = if width > 0.0 { (-low / width).max(0.0) } else { 0.0 };
                bevel.facets(low.max(0.0), high, |share, slope| {
                    lit((1.0 - far) * (1.0 - beyond) * share, slope * away);
                });
                if beyond > 0.0 {
                    bevel.facets(0.0, -low, |share, slope| lit((1.0 - far) * beyond * share, -slope * away));
                }
            }
            if far > 0.0 {
                // The whole tile, in rings about its middle.
                for k in 0..16_u8 {
                    let d = |k: u8| f32::from(k) / 32.0;
                    let ring = (1.0 - 2.0 * d(k)).powi(2) - (1.0 - 2.0 * d(k + 1)).powi(2);
                    bevel.facets(d(k), d(k + 1), |share, slope| {
                        for away in [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y] {
                            lit(0.25 * far * ring * share, slope * away);
                        }
                    });
                }
            }
            sum
        })
    })
}

/// A wall that runs.
fn perturbed() -> Subject {
    let wall = wall();
    let running = PerturbedTexture { scale: 0.5, strength: Vec2::new(0.15, 0.08), ..Default::default() };
    Subject::new("perturbed texture", 8.0, move |pixel, _| {
        pixel.over(|tap, footprint| {
            let (at, spread) = running.filtered(tap.at.extend(0.3), tap.at, footprint);
            let width = Vec2::splat(footprint.width());
            let widths = (width * width + 12.0 * spread * spread).map(f32::sqrt);
            Vec3::splat(0.5).lerp(Vec3::new(0.5, 0.15, 0.14), wall.filtered(at, widths).brick)
        })
    })
}

/// A slab of gas over dark ground, seen from above.
fn gas() -> Subject {
    let gas = Gas::default();
    Subject::new("gas", 8.0, move |pixel, _| {
        pixel.over(|tap, footprint| {
            let at = tap.at.extend(0.0);
            let extinction = |p: Vec3| gas.clamped_density(p, footprint.width());
            let seen = march(at, Vec3::Z, [0.0, 1.0], 0.25, 0.5, extinction, |_| Vec3::ONE);
            seen.light + 0.05 * seen.transmittance * Vec3::ONE
        })
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
