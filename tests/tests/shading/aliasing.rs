//! A plane to the horizon: one filtered sample a pixel against a thousand plain ones.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::{
    Brick, Footprint, Marble, PixelEllipse, StarWallpaper, bumped_normal, surface_gradient,
};
use asperity_tests::low_discrepancy::r2;
use rayon::prelude::*;

const WIDTH: usize = 120;
const HEIGHT: usize = 60;

/// A camera at height 1 over the plane z = 0 that looks along y, its horizon at the top of the picture.
fn plane(x: f32, y: f32) -> Vec2 {
    let distance = 0.6 * HEIGHT as f32 / (y + 0.02).max(0.02);
    Vec2::new((x - 0.5 * WIDTH as f32) / (0.6 * HEIGHT as f32) * distance, distance)
}

/// The derivatives of the point on the plane by the pixel.
fn derivatives(x: f32, y: f32) -> [Vec2; 2] {
    let h = 0.5;
    [plane(x + h, y) - plane(x - h, y), plane(x, y + h) - plane(x, (y - h).max(0.0))]
}

/// Root mean square of the difference of two pictures.
fn rmse(a: &[Vec3], b: &[Vec3]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(a, b)| f64::from((*a - *b).length_squared())).sum();
    (sum / a.len() as f64).sqrt()
}

/// The errors of one sample a pixel, plain and filtered; `shade` is given the point and the pixel's derivatives.
fn errors(shade: impl Fn(Vec2, [Vec2; 2]) -> Vec3 + Sync) -> [f64; 2] {
    let points: Vec<[f32; 2]> = (0..1024).map(r2).map(|[x, y]| [x as f32, y as f32]).collect();
    let pixels: Vec<[Vec3; 3]> = (0..WIDTH * HEIGHT)
        .into_par_iter()
        .map(|k| {
            let (x, y) = ((k % WIDTH) as f32, (k / WIDTH) as f32);
            let (cx, cy) = (x + 0.5, y + 0.5);
            let mean = points.iter().map(|p| shade(plane(x + p[0], y + p[1]), [Vec2::ZERO; 2])).sum::<Vec3>()
                / 1024.0;
            [mean, shade(plane(cx, cy), [Vec2::ZERO; 2]), shade(plane(cx, cy), derivatives(cx, cy))]
        })
        .collect();
    let picture = |k: usize| pixels.iter().map(|p| p[k]).collect::<Vec<_>>();
    [rmse(&picture(1), &picture(0)), rmse(&picture(2), &picture(0))]
}

/// The sides of the box of a pixel.
fn widths([dx, dy]: [Vec2; 2]) -> Vec2 {
    dx.abs() + dy.abs()
}

/// The mean of a texture over the taps of a pixel.
fn over([dx, dy]: [Vec2; 2], texture: impl Fn(Vec2, Footprint) -> Vec3) -> Vec3 {
    let pixel = PixelEllipse::from_derivatives(dx.extend(0.0), dy.extend(0.0));
    let (sum, count) = pixel.taps(32).fold((Vec3::ZERO, 0.0), |(sum, count), (offset, tap)| {
        (sum + texture(Vec2::new(offset.x, offset.y), tap), count + 1.0)
    });
    sum / count
}

#[test]
fn filtered_textures_alias_a_fifth_of_plain_ones() {
    let sun = Vec3::new(-0.48, 0.6, 0.64);
    let wall = Brick::new(0.5, 0.25, 0.04).unwrap();
    let stars = StarWallpaper::new(5, [0.1, 0.3], 1.0, 0.55, 1).unwrap();
    let marble = Marble::default();
    let cases: [(&str, [f64; 2]); 4] = [
        (
            "brick",
            errors(|uv, pixel| {
                Vec3::new(0.5, 0.15, 0.14).lerp(Vec3::splat(0.5), wall.filtered(uv, widths(pixel)).brick)
            }),
        ),
        (
            "bumped brick",
            errors(|uv, pixel| {
                let mut light = 0.0;
                wall.facets(uv, widths(pixel), |share, _, slope| {
                    let gradient = surface_gradient(Vec3::Z, [Vec3::X, Vec3::Y], 0.02 * slope);
                    light += share * bumped_normal(Vec3::Z, gradient).dot(sun).max(0.0);
                });
                Vec3::splat(light)
            }),
        ),
        (
            "stars",
            errors(|uv, pixel| over(pixel, |at, tap| Vec3::splat(stars.coverage(uv + at, tap.width())))),
        ),
        (
            "marble",
            errors(|uv, pixel| {
                over(pixel, |at, tap| marble.colour(Vec3::new(uv.x + at.x, uv.y + at.y, 0.3), tap))
            }),
        ),
    ];
    for (name, [plain, filtered]) in cases {
        println!("{name}: {plain:.4} plain, {filtered:.4} filtered, {:.3}", filtered / plain);
        assert!(filtered < 0.2 * plain, "{name}");
    }
}
