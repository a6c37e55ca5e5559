//! Metallic paint: a clear coat over flakes.

use asperity_shading::{
    Beckmann, Brdf, CookTorrance, Dielectric, EnergyPreservingOrenNayar, Frame, GlintField, MetallicPaint,
    MetallicPaintParameters, Microfacet, Ndf, PaintSurface, half_vector,
};
use glam::{Vec2, Vec3};

use crate::materials::in_metres;
use crate::{
    failure::Failure,
    integrator::path_tracer::{Appearance, Behind, Coat, Layer, Seen},
};

/// The width of the lobe of all flakes together.
const FLAKES: f32 = 0.32;

/// The thesis's paint, in a scene whose unit is so many metres, over a pigment.
pub fn paint(
    parameters: MetallicPaintParameters,
    metres: f32,
    pigment: Vec3,
) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    let paint = MetallicPaint::new(parameters)?;
    let (fresnel, base) = (Dielectric::new(1.5)?, EnergyPreservingOrenNayar::new(pigment, 0.2)?);
    Ok(move |seen: &Seen| {
        let surface = paint.surface(&in_metres(seen, metres));
        let normal = surface.base_normal;
        Appearance {
            layers: vec![
                Layer { normal, brdf: Box::new(Sparkling::new(&surface, seen.tangent)) },
                Layer { normal, brdf: Box::new(base) },
            ],
            coat: Some(Coat {
                normal: surface.coat_normal,
                slope_variance: surface.coat_slope_variance,
                fresnel,
                behind: Behind::Layers,
            }),
            ..Default::default()
        }
    })
}

/// The thesis's paint with counted flakes of Beckmann's density instead of sparkles and their lobe.
pub fn glinting(
    parameters: MetallicPaintParameters,
    metres: f32,
    pigment: Vec3,
    spacing: f32,
) -> Result<impl Fn(&Seen) -> Appearance + Sync, Failure> {
    let paint = MetallicPaint::new(parameters)?;
    let field = GlintField::new(Beckmann::new(FLAKES, FLAKES)?, spacing, 0.12, parameters.seed)?;
    let (fresnel, base) = (Dielectric::new(1.5)?, EnergyPreservingOrenNayar::new(pigment, 0.2)?);
    Ok(move |seen: &Seen| {
        let point = in_metres(seen, metres);
        let surface = paint.surface(&point);
        let normal = surface.base_normal;
        let flakes = Flakes { field, point: point.position, width: point.footprint().width() };
        Appearance {
            layers: vec![
                Layer { normal, brdf: Box::new(CookTorrance::new(flakes, surface.specular)) },
                Layer { normal, brdf: Box::new(base) },
            ],
            coat: Some(Coat {
                normal: surface.coat_normal,
                slope_variance: surface.coat_slope_variance,
                fresnel,
                behind: Behind::Layers,
            }),
            ..Default::default()
        }
    })
}

/// A lobe about the normal, or about that of a sparkle where this is brighter.
struct Sparkling {
    /// In the frame of the normal.
    surface: PaintSurface,
    lobe: CookTorrance<Beckmann, Vec3>,
}

impl Sparkling {
    fn new(surface: &PaintSurface, tangent: Vec3) -> Self {
        let frame = Frame::from_normal_tangent(surface.base_normal, tangent);
        let mut surface = *surface;
        surface.base_normal = Vec3::Z;
        if let Some(flake) = &mut surface.sparkle {
            flake.normal = frame.to_local(flake.normal);
        }
        let lobe = CookTorrance::new(Beckmann::clamped(FLAKES, FLAKES), Vec3::ONE);
        Self { surface, lobe }
    }
}

impl Brdf for Sparkling {
    fn value(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        let facet = self.surface.towards(half_vector(wi, wo));
        let frame = Frame::from_normal(facet.normal);
        let (i, o) = (frame.to_local(wi), frame.to_local(wo));
        // The renderer multiplies by the cosine with the normal of the surface.
        let cosine = i.z.max(0.0) / wi.z.max(1e-3);
        facet.specular * self.lobe.value(i, o) * cosine.min(4.0)
    }

    fn sample(&self, wo: Vec3, u: Vec2) -> Vec3 {
        self.lobe.sample(wo, u)
    }

    fn density(&self, wi: Vec3, wo: Vec3) -> f32 {
        self.lobe.density(wi, wo)
    }
}

/// Counted flakes in a pixel as a density of normals; samples are those of all flakes.
struct Flakes {
    field: GlintField<Beckmann>,
    point: Vec3,
    width: f32,
}

impl Ndf for Flakes {
    fn density(&self, m: Vec3) -> f32 {
        self.field.density(m, self.point, asperity_shading::Footprint::from_width(self.width))
    }

    fn from_gaussian(&self, z: Vec2) -> Vec3 {
        self.field.ndf().from_gaussian(z)
    }

    fn to_gaussian(&self, m: Vec3) -> Vec2 {
        self.field.ndf().to_gaussian(m)
    }
}

impl Microfacet for Flakes {
    fn lambda(&self, v: Vec3) -> f32 {
        self.field.ndf().lambda(v)
    }

    fn projected_area(&self, v: Vec3) -> f32 {
        self.field.ndf().projected_area(v)
    }

    fn sample_visible(&self, v: Vec3, u: Vec2) -> Vec3 {
        self.field.ndf().sample_visible(v, u)
    }

    /// That of the samples.
    fn visible_density(&self, v: Vec3, m: Vec3) -> f32 {
        self.field.ndf().visible_density(v, m)
    }
}
