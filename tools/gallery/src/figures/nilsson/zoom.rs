//! The thesis's materials, and bumps of a density, from a distance down to their smallest details.

use std::f32::consts::PI;

use asperity_render::image::tone::{filmic, hex};
use asperity_render::materials::{share_beyond, sky};
use asperity_render::{integrator::pixels::Sampling, sampling::low_discrepancy::r2};
use asperity_shading::bump::Facet;
use asperity_shading::level_of_detail::{GaussianField, ResolvedBumps};
use asperity_shading::material::{BumpMapped, FibersParameters, Material, PaintFlakes};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::reflectance::{Bsdf, Lobe};
use asperity_shading::{
    BumpField, Carpet, CarpetParameters, Footprint, Ggx, LevelOfDetail, MetallicPaint,
    MetallicPaintParameters, Ndf, Scratches, ScratchesParameters, SurfacePoint, TemperedGlass,
    TemperedGlassParameters, Variations, VariationsParameters, reflect,
};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn};
use asperity::failure::Result;

/// Radius of the lamp on bumps, like a nearby window. Facets closer to each other show the same
/// image of it.
const LAMP: f32 = 0.35;

/// The fraction of the bumps' color lit by a dim sky.
const SKY: f32 = 0.25;

/// Near the center of every image, off the lattices of noises.
const ANCHOR: Vec2 = Vec2::new(1.371, 0.843);

/// Cells of the bumps per meter.
const CELLS: f32 = 60.0;

/// A material with its exposure, and the half vector of viewer and lamp.
struct Surface {
    name: &'static str,
    exposure: f32,
    half: Vec3,
    /// Widths of its images in meters, down to its smallest detail.
    widths: [f32; 5],
    /// Whether its material receives positions relative to [`ANCHOR`].
    anchored: bool,
    material: Box<dyn Material + Sync>,
}

/// Returns the direction to the viewer.
fn eye() -> Vec3 {
    Vec3::new(0.1, -0.25, 0.96).normalize()
}

fn surfaces() -> Result<[Surface; 6]> {
    let surface = |name, exposure, [x, y]: [f32; 2], widths, material| Surface {
        name,
        exposure,
        half: Vec3::new(x, y, 1.0).normalize(),
        widths,
        anchored: false,
        material,
    };
    let carpet = Carpet::new(CarpetParameters {
        diffuse: Vec3::new(0.24, 0.21, 0.19),
        diffuse_thread_strength: 0.17,
        dark_area_size: 1.6,
        dark_area_strength: 0.2,
        fibers: FibersParameters { fiber_length: 0.006, fiber_width: 0.06, ..Default::default() },
        ..Default::default()
    })?;
    let paint = MetallicPaint::new(MetallicPaintParameters {
        specular: 0.16 * Vec3::new(0.35, 0.55, 0.95),
        pigment: Vec3::new(0.02, 0.05, 0.14),
        flakes: PaintFlakes::Counted { spacing: 4e-5, bin: 0.12 },
        flake_roughness: 0.3,
        passive_flake_strength: 0.0,
        coat_index: 1.0,
        seed: 3,
        ..Default::default()
    })?;
    let scratches = Scratches::new(ScratchesParameters {
        scratch_size: 0.005,
        scratch_width: 0.012,
        scratch_strength: 0.4,
        scratch_cover: 4.0,
        specular: hex(0xc8_ccd2),
        roughness: 0.2,
        ..Default::default()
    })?;
    let plastic = Variations::new(VariationsParameters {
        diffuse: Vec3::new(0.34, 0.12, 0.06),
        small_blemish_bump_strength: 0.06,
        gloss_roughness: 0.25,
        ..Default::default()
    })?;
    let glass = TemperedGlass::new(TemperedGlassParameters { wave_amplitude: 6e-4, ..Default::default() })?;
    let noise = GaussianFbm::<Vec3>::new(GaussianNoise::new(5), FbmSpectrum::new(2.17, 0.8, 16)?);
    // Octaves so fine that f32 has no precision left for them at the center.
    let noise = noise.anchored(ANCHOR.extend(0.0).as_dvec3() * f64::from(CELLS));
    let (ndf, bumps, rule) = (Ggx::new(0.2, 0.4)?, BumpField::new(noise, CELLS)?, LevelOfDetail::Exact);
    let most = share_beyond(ndf.d(Vec3::Z), LAMP);
    let bumps = UnderLamp { bumps: BumpMapped { ndf, bumps, rule, color: hex(0xf2_b184) }, most };
    // For all but scratches the lamp is near the highlight. Scratches reflect light that the
    // surface mirrors past the viewer.
    Ok([
        surface("carpet", 2.4, [-0.134, 0.094], [4.0, 0.4, 0.04, 0.01, 0.0025], Box::new(carpet)),
        surface("paint", 1.0, [-0.134, 0.094], [4.0, 0.4, 0.04, 0.004, 0.0004], Box::new(paint)),
        surface("scratches", 0.26, [0.2, 0.25], [0.4, 0.1, 0.02, 0.005, 0.001], Box::new(scratches)),
        surface("plastic", 0.45, [-0.134, 0.094], [4.0, 0.4, 0.04, 0.01, 0.002], Box::new(plastic)),
        surface("glass", 14.0, [0.0, 0.0], [20.0, 8.0, 3.0, 1.2, 0.4], Box::new(glass)),
        Surface {
            anchored: true,
            ..surface("bumps", 0.38, [0.14, 0.2], [4.0, 0.4, 0.04, 0.004, 0.0004], Box::new(bumps))
        },
    ])
}

/// Bumps under an area lamp and a dim sky.
struct UnderLamp<F> {
    bumps: BumpMapped<Ggx, F>,
    /// Maximum fraction of the variance that counts as resolved.
    most: f32,
}

impl<F: GaussianField> Material for UnderLamp<F> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let BumpMapped { ndf, bumps, rule, color } = &self.bumps;
        let coordinates = bumps.coordinates(point.position, &point.frame(), point.footprint());
        let coordinates = ResolvedBumps { variance: coordinates.variance.min(self.most), ..coordinates };
        let lobe = Lobe::resolved(ndf, *rule, coordinates).weighted(*color);
        let sky = sky(point.frame().to_world(rule.normal(ndf, coordinates)));
        Bsdf::new(point.frame(), wo).with([Facet::FLAT], [lobe]).with_emitted(SKY * *color * sky)
    }
}

impl Surface {
    /// Returns the radiance from the lamp, and from tubes reflected by a smooth surface, at a
    /// position relative to the anchor.
    fn radiance(&self, from: Vec2, pixel: Footprint) -> Vec3 {
        const DIRECTIONS: u32 = 4;
        let (wo, wi) = (eye(), reflect(eye(), self.half));
        let p = ANCHOR + from;
        let position = if self.anchored { from } else { p }.extend(0.0);
        let point = SurfacePoint::new(position, Vec3::Z, pixel).with_uv(p, [Vec3::X, Vec3::Y]);
        let bsdf = self.material.bsdf(&point, wo);
        let specular = (0..DIRECTIONS)
            .flat_map(|k| bsdf.specular_samples(wo, Vec2::from(r2(k).map(|u| u as f32))))
            .flatten();
        let mirrored = specular.filter(|sample| sample.wi.z > 0.0).fold(Vec3::ZERO, |sum, sample| {
            // Tilted tubes, at a distance of a few meters.
            let place = sample.wi.truncate() + 0.06 * p;
            let tube = (3.0 * (place.dot(Vec2::new(0.5, 0.87)) * 55.0).sin()).tanh();
            sum + sample.eval_cos * Vec3::new(0.50, 0.56, 0.60) * (0.55 + 0.42 * tube)
        });
        self.exposure * (PI * bsdf.eval_cos(wo, wi) + bsdf.emitted() + mirrored / DIRECTIONS as f32)
    }

    /// Returns the position near the anchor where the closest image has the most detail: among all
    /// candidates, the position with the largest variation of radiance.
    fn liveliest(&self) -> Vec2 {
        /// Candidates, and points per side of each.
        const TRIED: (u32, u16) = (512, 8);
        let width = self.widths[4];
        let pixel = Footprint::from_width(width / f32::from(TRIED.1));
        let spread = |middle: Vec2| {
            let points = (0..TRIED.1 * TRIED.1).map(|k| {
                let place = Vec2::new(f32::from(k % TRIED.1), f32::from(k / TRIED.1)) + 0.5;
                let from = middle + (place / f32::from(TRIED.1) - 0.5) * width;
                filmic(self.radiance(from, pixel).element_sum() / 3.0)
            });
            let (sum, square) = points.fold((0.0, 0.0), |(sum, square), x| (sum + x, square + x * x));
            square - sum * sum / f32::from(TRIED.1).powi(2)
        };
        // Close enough to stay at the center of the previous image.
        let middle = |k| (Vec2::from(r2(k).map(|u| u as f32)) - 0.5) * (0.8 * self.widths[2]);
        let spreads = (0..TRIED.0).map(|k| (spread(middle(k)), middle(k)));
        spreads.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(Vec2::ZERO, |(_, middle)| middle)
    }
}

/// Formats a length.
fn words(metres: f32) -> String {
    let (value, unit) = match metres {
        m if m >= 1.0 => (m, "m"),
        m if m >= 0.01 => (100.0 * m, "cm"),
        m => (1000.0 * m, "mm"),
    };
    format!("{} {unit}", (value * 100.0).round() / 100.0)
}

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let side = context.size * 3 / 5;
    let sampling = Sampling { width: side, height: side, ..context.square() };
    let side = side as f32;
    let surfaces = surfaces()?;
    let pictures = surfaces.iter().flat_map(|surface| {
        let (name, middle) = (surface.name, surface.liveliest());
        surface.widths.into_iter().zip(0..).map(move |(width, k)| {
            let label = if k == 0 { format!("{name}, {}", words(width)) } else { words(width) };
            let alt = format!("A patch of {name}, {} wide", words(width));
            ([format!("{name}-{k}"), label, alt], (surface, middle, width))
        })
    });
    let drawn = Drawn::pictures(5, pictures, |(surface, middle, width)| {
        let pixel = Footprint::from_width(width / side);
        let image = context.render(sampling, |x, y| {
            surface.radiance(middle + Vec2::new(x / side - 0.5, 0.5 - y / side) * width, pixel)
        })?;
        Ok(image.filmic(1.0))
    })?;
    let lamp = format!("{:.0}°", 2.0 * LAMP.to_degrees());
    Ok(drawn.fact("lamp size for bumps", lamp).fact("samples per pixel", sampling.samples_per_pixel))
}
