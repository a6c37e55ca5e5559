//! The materials of a mesh file: textured glTF materials, by triangle.

use std::f32::consts::TAU;

use asperity_shading::{
    Frame, StandardMaterial, StandardMaterialParameters, SurfacePoint,
    bump::flip_to_visible,
    level_of_detail::ResolvedBumps,
    reflectance::{Absorption, Bsdf},
};
use glam::{Vec2, Vec3, Vec4};

use crate::{geometry::ray::Hit, image::texture_map::TextureMap, sampling::sampler::of_position};

/// A material of glTF 2.0. Textures multiply its parameters.
#[derive(Clone)]
pub struct TexturedMaterial {
    pub parameters: StandardMaterialParameters,
    /// The alpha of the base color.
    pub alpha: f32,
    pub coverage: Coverage,
    pub double_sided: bool,
    /// Whether the base color is shown without light.
    pub unlit: bool,
    /// The strength of the normal map.
    pub normal_scale: f32,
    /// The inside of a body.
    pub absorption: Absorption,
    pub textures: Textures,
}

/// What alpha means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coverage {
    Opaque,
    /// Opaque where alpha is at least this value, and invisible elsewhere.
    Mask(f32),
    /// The visible fraction.
    Blend,
}

/// The textures of a material, named as in glTF.
#[derive(Clone, Default)]
pub struct Textures {
    pub base_color: Option<TextureMap>,
    pub metallic_roughness: Option<TextureMap>,
    pub normal: Option<TextureMap>,
    pub emissive: Option<TextureMap>,
    pub clearcoat: Option<TextureMap>,
    pub clearcoat_roughness: Option<TextureMap>,
    pub sheen_color: Option<TextureMap>,
    pub sheen_roughness: Option<TextureMap>,
    pub transmission: Option<TextureMap>,
    pub specular: Option<TextureMap>,
    pub specular_color: Option<TextureMap>,
    pub anisotropy: Option<TextureMap>,
}

/// The values of a vertex that its material reads.
#[derive(Clone, Copy, Debug)]
pub struct Painted {
    /// Two sets of texture coordinates, with v downwards.
    pub uv: [Vec2; 2],
    /// Multiplies the base color.
    pub color: Vec4,
    /// The index of the material, the same for all corners of a triangle.
    pub material: u32,
}

/// The materials of a mesh.
pub struct MeshMaterials {
    pub materials: Vec<TexturedMaterial>,
    /// For each triangle of the mesh the indices of its corners.
    pub triangles: Vec<[u32; 3]>,
    pub corners: Vec<Painted>,
}

impl TexturedMaterial {
    /// Returns the material in a scene whose unit is this many units of the file.
    pub fn in_units_of(self, unit: f32) -> Self {
        let absorption = Absorption::new(self.absorption.coefficient() * unit);
        Self { absorption: absorption.unwrap_or(self.absorption), ..self }
    }

    /// Returns the base color and alpha at a point.
    fn base(&self, at: &Painted) -> Vec4 {
        let factor = self.parameters.base_color.extend(self.alpha);
        factor * at.color * color(self.textures.base_color.as_ref(), at)
    }

    /// Whether light may enter.
    fn transmits(&self) -> bool {
        !self.unlit && self.parameters.transmission > 0.0
    }

    /// Returns the fraction of light that passes through the visible surface at a point, which
    /// has the base color.
    fn transmitted(&self, at: &Painted) -> Vec3 {
        if !self.transmits() {
            return Vec3::ZERO;
        }
        // NaN is 0, as in the material.
        let share = |x: f32| if x > 0.0 { x.min(1.0) } else { 0.0 };
        let (p, t) = (&self.parameters, &self.textures);
        let metallic = p.metallic * data(t.metallic_roughness.as_ref(), at).z;
        let transmission = p.transmission * data(t.transmission.as_ref(), at).x;
        self.base(at).truncate().map(share) * ((1.0 - share(metallic)) * share(transmission))
    }

    /// Returns the fraction of the surface at a point that is visible for a ray in this direction.
    /// A single-sided surface has no back, unless light leaves a body there.
    fn covered(&self, at: &Painted, hit: &Hit, direction: Vec3) -> f32 {
        if !self.double_sided && !self.transmits() && hit.flat.dot(direction) > 0.0 {
            return 0.0;
        }
        match self.coverage {
            Coverage::Opaque => 1.0,
            Coverage::Mask(least) => f32::from(self.base(at).w >= least),
            // NaN is invisible.
            Coverage::Blend if self.base(at).w > 0.0 => self.base(at).w.min(1.0),
            Coverage::Blend => 0.0,
        }
    }

    /// Returns the parameters at a point, with the base color there. `turn` is −1 where the
    /// bitangent of the texture is opposite to that of the frame.
    fn at(&self, at: &Painted, turn: f32) -> StandardMaterialParameters {
        let (p, t) = (&self.parameters, &self.textures);
        let data = |map: &Option<TextureMap>| data(map.as_ref(), at);
        let metallic_roughness = data(&t.metallic_roughness);
        let (mut strength, mut rotation) = (p.anisotropy, p.anisotropy_rotation);
        if let Some(map) = &t.anisotropy {
            let texel = map.data(at.uv);
            strength *= texel.z;
            rotation += (2.0 * texel.y - 1.0).atan2(2.0 * texel.x - 1.0);
        }
        StandardMaterialParameters {
            base_color: self.base(at).truncate(),
            metallic: p.metallic * metallic_roughness.z,
            roughness: p.roughness * metallic_roughness.y,
            emissive: p.emissive * color(t.emissive.as_ref(), at).truncate(),
            clearcoat: p.clearcoat * data(&t.clearcoat).x,
            clearcoat_roughness: p.clearcoat_roughness * data(&t.clearcoat_roughness).y,
            sheen_color: p.sheen_color * color(t.sheen_color.as_ref(), at).truncate(),
            sheen_roughness: p.sheen_roughness * data(&t.sheen_roughness).w,
            transmission: p.transmission * data(&t.transmission).x,
            specular: p.specular * data(&t.specular).w,
            specular_color: p.specular_color * color(t.specular_color.as_ref(), at).truncate(),
            anisotropy: strength,
            anisotropy_rotation: (turn * rotation) % TAU,
            ..*p
        }
    }
}

fn color(map: Option<&TextureMap>, at: &Painted) -> Vec4 {
    map.map_or(Vec4::ONE, |map| map.color(at.uv))
}

fn data(map: Option<&TextureMap>, at: &Painted) -> Vec4 {
    map.map_or(Vec4::ONE, |map| map.data(at.uv))
}

impl MeshMaterials {
    /// Returns the material of a hit, and its values there.
    fn of(&self, hit: &Hit) -> Option<(&TexturedMaterial, Painted)> {
        let (triangle, weights) = hit.triangle?;
        let corners = self.triangles.get(triangle as usize)?;
        let [a, b, c] = corners.map(|i| self.corners.get(i as usize));
        let corners = [*a?, *b?, *c?];
        let mut at = Painted { uv: [Vec2::ZERO; 2], color: Vec4::ZERO, ..corners[0] };
        for (corner, weight) in corners.iter().zip(weights) {
            at.uv = [0, 1].map(|set| at.uv[set] + corner.uv[set] * weight);
            at.color += corner.color * weight;
        }
        Some((self.materials.get(at.material as usize)?, at))
    }

    /// Whether any light passes through a surface of these materials, or they have an invisible
    /// side.
    pub fn let_light_through(&self) -> bool {
        let passes =
            |m: &TexturedMaterial| m.coverage != Coverage::Opaque || !m.double_sided || m.transmits();
        self.materials.iter().any(passes)
    }

    /// Returns the fraction of a hit that is visible for a ray in this direction.
    fn covered(&self, hit: &Hit, direction: Vec3) -> f32 {
        self.of(hit).map_or(1.0, |(material, at)| material.covered(&at, hit, direction))
    }

    /// Whether a ray meets the surface at a hit: in proportion to its visible fraction, by a hash
    /// of the position.
    pub fn meets(&self, hit: &Hit, direction: Vec3) -> bool {
        let covered = self.covered(hit, direction);
        covered > 0.0 && of_position(hit.position) < covered
    }

    /// Returns the fraction of light that passes straight through the surface at a hit.
    pub fn passes(&self, hit: &Hit, direction: Vec3) -> Vec3 {
        let Some((material, at)) = self.of(hit) else { return Vec3::ZERO };
        let covered = material.covered(&at, hit, direction);
        1.0 - covered * (1.0 - material.transmitted(&at))
    }

    /// Returns the inside of the body at a hit, if it is the surface of one.
    pub fn body(&self, hit: &Hit) -> Option<Absorption> {
        let (material, _) = self.of(hit)?;
        (material.transmits() && material.parameters.thickness > 0.0).then_some(material.absorption)
    }

    /// Returns the BSDF of a hit at its point, whose normal may be reversed.
    pub fn bsdf(&self, hit: &Hit, point: &SurfacePoint, wo: Vec3) -> Bsdf<'static> {
        let frame = point.frame();
        let Some((material, at)) = self.of(hit) else { return Bsdf::new(frame, wo) };
        if material.unlit {
            return Bsdf::new(frame, wo).with_emitted(material.base(&at).truncate());
        }
        // The texture's upwards direction, which mirrored textures reverse.
        let turn = if frame.bitangent.dot(point.tangents[1]) < 0.0 { -1.0 } else { 1.0 };
        let bumped = material.textures.normal.as_ref().map_or(frame, |map| {
            let n = 2.0 * map.data(at.uv).truncate() - 1.0;
            let (x, y) = (n.x * material.normal_scale, n.y * material.normal_scale);
            // Seen from behind, the whole relief is reversed.
            let side = if hit.normal.dot(point.normal) < 0.0 { -1.0 } else { 1.0 };
            let tilted = Vec3::new(side * x, side * turn * y, n.z).try_normalize().unwrap_or(Vec3::Z);
            // From inside a body, the surface below its normal is visible.
            let visible = if wo.dot(frame.normal) < 0.0 { -1.0 } else { 1.0 };
            let normal =
                visible * flip_to_visible(visible * frame.normal, visible * frame.to_world(tilted), wo);
            Frame::from_normal_tangent(normal, frame.tangent)
        });
        StandardMaterial::new_clamped(material.at(&at, turn)).bsdf_at(bumped, wo, ResolvedBumps::FAR)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use approx::assert_abs_diff_eq;
    use asperity_shading::Footprint;
    use glam::Affine2;

    use super::*;
    use crate::{
        geometry::{
            mesh::{Mesh, Probe, TracedMesh},
            shape::Shape,
        },
        image::texture_map::{Texels, Wrap},
    };

    fn plain() -> TexturedMaterial {
        TexturedMaterial {
            parameters: StandardMaterialParameters::default(),
            alpha: 1.0,
            coverage: Coverage::Opaque,
            double_sided: false,
            unlit: false,
            normal_scale: 1.0,
            absorption: Absorption::NONE,
            textures: Textures::default(),
        }
    }

    fn constant(texel: [u8; 4]) -> Option<TextureMap> {
        let texels = Arc::new(Texels::constant(texel));
        let (transform, wrap) = (Affine2::IDENTITY, [Wrap::Repeat; 2]);
        Some(TextureMap { texels, set: 0, transform, wrap, nearest: false })
    }

    /// Returns a square of this material, and its hit from a direction.
    fn square(material: TexturedMaterial, color: Vec4, from: Vec3) -> (MeshMaterials, Hit) {
        let mesh = Mesh::parallelogram(Vec3::new(-1.0, -1.0, 0.0), [2.0 * Vec3::X, 2.0 * Vec3::Y]);
        let triangles = mesh.triangles.clone();
        let corners = vec![Painted { uv: [Vec2::ZERO; 2], color, material: 0 }; mesh.vertices.len()];
        let shape = Shape::Mesh(TracedMesh::new(mesh));
        let probe = Probe::new(3.0 * from, -from);
        let hit = shape.meets(&probe, f32::INFINITY).and_then(|met| shape.hit(&probe, met)).expect("a hit");
        (MeshMaterials { materials: vec![material], triangles, corners }, hit)
    }

    #[test]
    fn coverage_follows_alpha_and_the_side() {
        let up = Vec3::new(0.1, 0.0, 0.995).normalize();
        for (coverage, double_sided, alpha, from, expected) in [
            (Coverage::Opaque, false, 0.2, up, 1.0),
            (Coverage::Opaque, false, 0.2, -up, 0.0),
            (Coverage::Opaque, true, 0.2, -up, 1.0),
            (Coverage::Mask(0.5), true, 0.49, up, 0.0),
            (Coverage::Mask(0.5), true, 0.5, up, 1.0),
            (Coverage::Blend, true, 0.3, up, 0.3),
            (Coverage::Blend, true, f32::NAN, up, 0.0),
            (Coverage::Blend, true, 7.0, up, 1.0),
        ] {
            let material = TexturedMaterial { coverage, double_sided, ..plain() };
            let (materials, hit) = square(material, Vec4::new(1.0, 1.0, 1.0, alpha), from);
            assert_eq!(materials.covered(&hit, -from), expected, "{coverage:?} {double_sided} {alpha}");
            assert_eq!(materials.passes(&hit, -from), Vec3::splat(1.0 - expected));
            assert_eq!(materials.let_light_through(), coverage != Coverage::Opaque || !double_sided);
        }
        // The fraction of positions that are met is the alpha.
        let material = TexturedMaterial { coverage: Coverage::Blend, ..plain() };
        let (materials, hit) = square(material, Vec4::new(1.0, 1.0, 1.0, 0.3), up);
        let at = |k: u16| Hit { position: Vec3::new(f32::from(k) * 0.001, 0.5, 0.0), ..hit };
        let met = (0..10_000).filter(|&k| materials.meets(&at(k), -up)).count();
        // Four standard deviations of 10,000 draws.
        assert!(met.abs_diff(3000) < 4 * 46, "{met}");
    }

    #[test]
    fn transmission_passes_light_and_thickness_makes_a_body() {
        let mut glass = plain();
        (glass.parameters.transmission, glass.parameters.metallic) = (0.75, 0.0);
        let from = Vec3::Z;
        let (materials, hit) = square(glass.clone(), Vec4::ONE, from);
        assert_eq!(materials.passes(&hit, -from), Vec3::splat(0.75));
        assert!(materials.body(&hit).is_none());
        glass.parameters.thickness = 2.0;
        glass.absorption = Absorption::new(Vec3::new(0.5, 0.0, 1.0)).unwrap();
        let (materials, hit) = square(glass.in_units_of(4.0), Vec4::ONE, -from);
        assert_eq!(materials.body(&hit).unwrap().coefficient(), Vec3::new(2.0, 0.0, 4.0));
        // Light leaves the body through its back.
        assert_eq!(materials.covered(&hit, from), 1.0);
    }

    #[test]
    fn passes_multiplies_textures_of_transmission_metallic_and_color() {
        let mut glass = plain();
        (glass.parameters.transmission, glass.parameters.metallic) = (0.75, 0.5);
        glass.parameters.base_color = Vec3::new(1.0, 0.5, 7.0);
        glass.textures.transmission = constant([51, 0, 0, 255]);
        glass.textures.metallic_roughness = constant([0, 0, 102, 255]);
        let color = Vec4::new(0.5, 1.0, 1.0, 1.0);
        let (materials, hit) = square(glass.clone(), color, Vec3::Z);
        let passed = 0.75 * 0.2 * (1.0 - 0.5 * 0.4);
        let expected = passed * Vec3::new(0.5, 0.5, 1.0);
        assert_abs_diff_eq!(materials.passes(&hit, -Vec3::Z), expected, epsilon = 1e-6);
        glass.unlit = true;
        let (materials, hit) = square(glass, color, Vec3::Z);
        assert_eq!(materials.passes(&hit, -Vec3::Z), Vec3::ZERO);
    }

    #[test]
    fn anisotropy_rotation_wraps_around() {
        let mut material = plain();
        material.parameters.anisotropy_rotation = 5.0;
        // The direction at 2 radians.
        material.textures.anisotropy = constant([74, 243, 255, 255]);
        let at = Painted { uv: [Vec2::ZERO; 2], color: Vec4::ONE, material: 0 };
        for turn in [1.0, -1.0] {
            let rotation = material.at(&at, turn).anisotropy_rotation;
            // Half a level of 8 bits is 0.004 rad.
            assert_abs_diff_eq!(rotation, turn * (7.0 - TAU), epsilon = 0.006);
        }
    }

    #[test]
    fn normal_map_inside_a_body_keeps_its_side() {
        let mut glass = plain();
        (glass.parameters.transmission, glass.parameters.metallic) = (1.0, 0.0);
        (glass.parameters.thickness, glass.parameters.roughness) = (1.0, 0.3);
        // Tilted by 45 degrees towards +x, against a view from below at 6 degrees.
        glass.textures.normal = constant([218, 128, 218, 255]);
        let wo = Vec3::new(0.995, 0.0, -0.1).normalize();
        let (materials, hit) = square(glass, Vec4::ONE, wo);
        let hit = hit.consistent(-wo);
        let bsdf = materials.bsdf(&hit, &hit.point(Footprint::from_width(0.0)), wo);
        // Below the critical angle no light enters from above.
        let light = |degrees: u8| {
            let (sin, cos) = f32::from(degrees).to_radians().sin_cos();
            Vec3::new(cos, 0.0, sin)
        };
        assert!((0..18).all(|k| bsdf.eval_cos(wo, light(10 * k)) == Vec3::ZERO));
        assert!(bsdf.eval_cos(wo, -light(10)).x > 0.1);
    }

    #[test]
    fn textures_multiply_the_parameters() {
        let mut material = plain();
        material.parameters = StandardMaterialParameters {
            emissive: Vec3::splat(2.0),
            clearcoat: 1.0,
            clearcoat_roughness: 1.0,
            sheen_color: Vec3::ONE,
            sheen_roughness: 1.0,
            transmission: 1.0,
            anisotropy: 1.0,
            anisotropy_rotation: 0.25,
            ..material.parameters
        };
        let map = constant([255, 51, 102, 153]);
        material.textures = Textures {
            base_color: map.clone(),
            metallic_roughness: map.clone(),
            normal: None,
            emissive: map.clone(),
            clearcoat: map.clone(),
            clearcoat_roughness: map.clone(),
            sheen_color: map.clone(),
            sheen_roughness: map.clone(),
            transmission: map.clone(),
            specular: map.clone(),
            specular_color: map.clone(),
            anisotropy: constant([128, 255, 102, 0]),
        };
        let at = Painted { uv: [Vec2::ZERO; 2], color: Vec4::new(0.5, 1.0, 1.0, 1.0), material: 0 };
        let p = material.at(&at, -1.0);
        // sRGB 0.2 and 0.4.
        let linear = Vec3::new(1.0, 0.0331, 0.1329);
        assert_abs_diff_eq!(p.base_color, linear * Vec3::new(0.5, 1.0, 1.0), epsilon = 1e-4);
        assert_abs_diff_eq!(p.emissive, 2.0 * linear, epsilon = 2e-4);
        assert_abs_diff_eq!(p.sheen_color, linear, epsilon = 1e-4);
        assert_abs_diff_eq!(p.specular_color, linear, epsilon = 1e-4);
        let got = [p.metallic, p.roughness, p.clearcoat, p.clearcoat_roughness, p.sheen_roughness];
        let expected = [0.4, 0.2, 1.0, 0.2, 0.6];
        got.into_iter().zip(expected).for_each(|(got, x)| assert_abs_diff_eq!(got, x, epsilon = 1e-6));
        assert_abs_diff_eq!(p.specular, 0.6, epsilon = 1e-6);
        assert_eq!(p.transmission, 1.0);
        assert_abs_diff_eq!(p.anisotropy, 0.4, epsilon = 1e-6);
        assert_abs_diff_eq!(p.anisotropy_rotation, -(0.25 + std::f32::consts::FRAC_PI_2), epsilon = 0.005);
    }

    #[test]
    fn normal_map_tilts_towards_u_and_up_and_reverses_behind() {
        // A mirror that is tilted by 45 degrees towards +u, or towards +v.
        for (texel, towards) in [([218, 128, 218, 255], Vec3::X), ([128, 218, 218, 255], Vec3::Y)] {
            let mut material = plain();
            (material.parameters.roughness, material.double_sided) = (0.1, true);
            material.textures.normal = constant(texel);
            for side in [1.0, -1.0] {
                let from = Vec3::Z * side;
                let (materials, hit) = square(material.clone(), Vec4::ONE, from);
                let seen = hit.flip_to_visible(-from);
                let bsdf = materials.bsdf(&hit, &seen.point(Footprint::from_width(0.0)), from);
                let lit = |wi: Vec3| bsdf.eval_cos(from, wi).x;
                // Behind, the tilt is the same in space: a bump is a dent.
                let (bright, dark) =
                    ((towards * side + 0.02 * from).normalize(), (-towards * side + 0.02 * from).normalize());
                assert!(
                    lit(bright) > 20.0 * lit(dark).max(1e-3),
                    "{towards} {side}: {} {}",
                    lit(bright),
                    lit(dark)
                );
            }
        }
    }

    #[test]
    fn unlit_shows_its_color() {
        let material = TexturedMaterial { unlit: true, ..plain() };
        let (materials, hit) = square(material, Vec4::new(0.2, 0.4, 0.6, 1.0), Vec3::Z);
        let bsdf = materials.bsdf(&hit, &hit.point(Footprint::from_width(0.0)), Vec3::Z);
        assert_abs_diff_eq!(bsdf.emitted(), Vec3::new(0.2, 0.4, 0.6), epsilon = 1e-6);
        assert_eq!(bsdf.eval_cos(Vec3::Z, Vec3::Z), Vec3::ZERO);
    }
}
