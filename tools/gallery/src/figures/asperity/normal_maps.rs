//! A wet cobblestone street up to the horizon: a hand-made normal map, filtered by the slopes
//! within each pixel.

use std::f32::consts::PI;

use asperity_render::light::lamps::{Lamp, direction};
use asperity_render::{
    image::Image, image::tone::hex, integrator::pixels::Sampling, materials::chalk,
    materials::cobbles::cobbles,
};
use asperity_shading::Frame;
use asperity_shading::level_of_detail::ResolvedBumps;
use asperity_shading::normal_map::{SlopeLobes, SlopeMoments};
use asperity_shading::{
    Beckmann, Brdf, Ndf, PixelEllipse, Schlick, SlopePyramid, TorranceSparrow, bump::Facet, reflectance::Lobe,
};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn, Panel};
use asperity::failure::Result;

/// Texels along the map, which covers a square of this many meters.
const SIZE: usize = 256;
const TILE: f32 = 1.3;
/// Number of slope groups.
const GROUPS: usize = 16;
/// Samples of the reference.
const SAMPLES: u32 = 256;
/// Maximum number of round footprints for an elongated pixel.
const TAPS: u32 = 16;
/// Roughness of the wet stone.
const ALPHA: f32 = 0.2;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let normals = cobbles(SIZE);
    let street = Street {
        groups: SlopePyramid::from_normals(SIZE, SIZE, &normals)?,
        one: SlopePyramid::from_normals(SIZE, SIZE, &normals)?,
        wet: Beckmann::isotropic(ALPHA)?,
        water: Schlick::new(0.06)?,
        // The sun, the glow above it and the sky.
        lights: [
            Lamp::at(86.0, 13.0, hex(0xff_c890) * 0.3),
            Lamp::at(86.0, 30.0, hex(0xe8_9c90) * 0.12),
            Lamp::at(110.0, 55.0, hex(0x7c_94e0) * 0.3),
        ],
    };
    let once = Sampling { height: context.size * 5 / 8, samples_per_pixel: 1, ..context.square() };
    let view = View { width: once.width as f32, height: once.height as f32 };
    let many = Sampling { samples_per_pixel: SAMPLES, ..once };
    let plain = |uv: Vec2, _: &PixelEllipse, wo: Vec3| {
        street.alone(SlopeMoments::point(street.one.view().slope(uv)), wo)
    };
    let averaged = |uv: Vec2, pixel: &PixelEllipse, wo| {
        let seen = street.one.view().sample_along(uv, pixel, TAPS).moments();
        street.alone(SlopeMoments::point(seen.mean), wo)
    };
    let one = |uv: Vec2, pixel: &PixelEllipse, wo| {
        street.grouped(&street.one.view().sample_along(uv, pixel, TAPS), wo)
    };
    let groups = |uv: Vec2, pixel: &PixelEllipse, wo| {
        street.grouped(&street.groups.view().sample_along(uv, pixel, TAPS), wo)
    };
    let ways: [(&str, &str, Sampling, &Way<'_>); 5] = [
        ("plain", "One sample per pixel", once, &plain),
        ("averaged", "One sample, averaged normals", once, &averaged),
        ("one", "One sample, one slope group", once, &one),
        ("groups", "One sample, sixteen slope groups", once, &groups),
        ("reference", "256 samples per pixel", many, &plain),
    ];
    let draw = |(stem, label, sampling, seen): (_, _, Sampling, &Way<'_>)| {
        let image = context.render(sampling, |x, y| {
            // A single sample is at the pixel's center.
            let (x, y) =
                if sampling.samples_per_pixel == 1 { (x.floor() + 0.5, y.floor() + 0.5) } else { (x, y) };
            let ray = view.ray(x, y);
            view.ground(x, y).map_or_else(|| sky(ray), |uv| seen(uv, &view.pixel(x, y), -ray))
        })?;
        Ok((stem, label, image))
    };
    let pictures = ways.into_iter().map(draw).collect::<Result<Vec<Picture>>>()?;
    let rows = compare(&pictures, &view);
    let panel = |(stem, label, image): Picture| {
        let alt = format!("A wet street of cobbles under a low sun, {}", label.to_lowercase());
        Panel::new(stem, label, alt, image.exposed(1.0))
    };
    let shown = pictures.into_iter().filter(|picture| picture.0 != "one");
    let head = ["street", "mean radiance relative to 256 samples", "RMSE", "RMSE relative to one sample"];
    Ok(Drawn::new(2, shown.map(panel).collect())
        .fact("normal map", format!("{SIZE} × {SIZE} texels on {TILE} m"))
        .fact("roughness of the wet stone", ALPHA)
        .fact("footprints per pixel", format!("at most {TAPS}"))
        .table(head, rows))
}

/// Radiance from a point of the street, over a pixel, to the viewer.
type Way<'a> = dyn Fn(Vec2, &PixelEllipse, Vec3) -> Vec3 + Sync + 'a;
/// An image with its stem and its label.
type Picture = (&'static str, &'static str, Image);

/// Compares each image's street with the last image: mean radiance, and root mean square error
/// relative to the first.
fn compare(pictures: &[Picture], view: &View) -> Vec<[String; 4]> {
    let street = |(.., image): &Picture| -> Vec<Vec3> {
        let rows = image.pixels.chunks_exact(image.width as usize).enumerate();
        let seen = rows.filter(|(y, _)| view.ground(0.0, *y as f32 + 0.5).is_some());
        seen.flat_map(|(_, row)| row.to_vec()).collect()
    };
    let streets: Vec<_> = pictures.iter().map(street).collect();
    let expected = &streets[streets.len() - 1];
    let mean = |pixels: &[Vec3]| pixels.iter().map(|p| f64::from(p.element_sum())).sum::<f64>();
    let error = |pixels: &[Vec3]| {
        let squares = pixels.iter().zip(expected).map(|(p, e)| f64::from((*p - *e).length_squared()));
        (squares.sum::<f64>() / (3 * expected.len()) as f64).sqrt()
    };
    let row = |((_, label, _), pixels): (&Picture, &Vec<Vec3>)| {
        let [share, over] = [mean(pixels) / mean(expected), error(pixels) / error(&streets[0])];
        [(*label).to_owned(), format!("{share:.3}"), format!("{:.4}", error(pixels)), format!("{over:.3}")]
    };
    pictures.iter().zip(&streets).map(row).collect()
}

/// A camera at eye height that looks along +y, slightly downward.
struct View {
    width: f32,
    height: f32,
}

impl View {
    /// Returns the unit direction through an image point in pixels from the top left.
    fn ray(&self, x: f32, y: f32) -> Vec3 {
        let (across, down) = ((x - 0.5 * self.width) / self.height, y / self.height - 0.27);
        Vec3::new(1.1 * across, 1.0, -1.1 * down).normalize()
    }

    /// Returns the intersection of a ray with the street, in tiles, or `None` at and above the
    /// horizon.
    fn ground(&self, x: f32, y: f32) -> Option<Vec2> {
        let ray = self.ray(x, y);
        (ray.z < -1e-4).then(|| Vec2::new(ray.x, ray.y) * (1.2 / -ray.z / TILE) + Vec2::new(0.3, 0.1))
    }

    /// Returns the pixel on the street, in tiles.
    fn pixel(&self, x: f32, y: f32) -> PixelEllipse {
        // Rows at the horizon are infinite: half a pixel down is twice as far from it as half a
        // pixel up.
        let at = |x, y| self.ground(x, y).map_or(Vec3::INFINITY, |uv| uv.extend(0.0));
        let (dx, dy) = (at(x + 0.5, y) - at(x - 0.5, y), at(x, y - 0.5) - at(x, y + 0.5));
        PixelEllipse::from_derivatives(dx, dy)
    }
}

/// The sky behind the lights.
fn sky(ray: Vec3) -> Vec3 {
    let sun = direction(86.0, 13.0);
    let near = ray.dot(sun).max(0.0);
    let height = (ray.z * 2.6).clamp(0.0, 1.0).sqrt();
    let glow = hex(0xff_a868) * (0.55 * near.powi(24)) + hex(0xff_e8c8) * (2.5 * near.powi(1400));
    hex(0xd9_8a62).lerp(hex(0x39_4a78), height) * 0.55 + glow
}

struct Street {
    groups: SlopePyramid<GROUPS>,
    one: SlopePyramid<1>,
    wet: Beckmann,
    water: Schlick,
    lights: [Lamp; 3],
}

impl Street {
    /// Shades a single slope.
    fn alone(&self, slope: SlopeMoments, wo: Vec3) -> Vec3 {
        let facets = slope.beckmann(ALPHA, ALPHA);
        self.shade(slope, wo, |h| facets.d(h))
    }

    fn grouped<const K: usize>(&self, seen: &SlopeLobes<K>, wo: Vec3) -> Vec3 {
        self.shade(seen.moments(), wo, |h| seen.density(self.wet, ResolvedBumps::FAR, h))
    }

    /// Shades stone under water from a facet density and the mean slope: the Torrance–Sparrow
    /// model.
    fn shade(&self, slopes: SlopeMoments, wo: Vec3, density: impl Fn(Vec3) -> f32) -> Vec3 {
        let water = TorranceSparrow::new(Facets(density), self.water);
        let street = chalk(Frame::IDENTITY, wo, slopes.mean_normal(), hex(0x4e_4c50), Vec3::ZERO)
            .with([Facet::FLAT], [Lobe::from(&water as &dyn Brdf)]);
        let lit = self.lights.iter().map(|light| PI * light.color * street.eval_cos(wo, light.direction));
        lit.sum()
    }
}

/// A normal density that is evaluated but never sampled.
struct Facets<F>(F);

impl<F: Fn(Vec3) -> f32> Ndf for Facets<F> {
    fn d(&self, m: Vec3) -> f32 {
        (self.0)(m)
    }

    fn warp_gaussian(&self, _: Vec2) -> Vec3 {
        Vec3::Z
    }

    fn invert(&self, _: Vec3) -> Vec2 {
        Vec2::ZERO
    }
}
