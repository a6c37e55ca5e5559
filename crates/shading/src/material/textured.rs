//! The textures of Cohen's lecture as materials: bricks, tiles, wallpaper, marble, and
//! perturbation.

use asperity_noise::{IntegerHash, Lattice, filtered_fraction};
use glam::{Vec2, Vec3};

use crate::bump::{Facet, bumped_normal};
use crate::material::interface::Material;
use crate::material::surface_point::SurfacePoint;
use crate::math::sqrt;
use crate::pixel::PixelEllipse;
use crate::reflectance::{Bsdf, Coat, Dielectric, EnergyPreservingOrenNayar};
use crate::texture::{Bevel, Brick, Edge, Marble, PerturbedTexture, StarWallpaper};

/// A brick wall on texture coordinates with recessed mortar.
///
/// The facets of its grooves are shaded separately.
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::material::{BrickWall, Material};
/// use asperity_shading::{Brdf, Footprint, SurfacePoint};
///
/// let wall = BrickWall::default();
/// let point = SurfacePoint::new(Vec3::ZERO, Vec3::Z, Footprint::from_width(1e-3)).with_uv(Vec2::new(0.13, 0.045), [Vec3::X, Vec3::Y]);
/// let seen = wall.bsdf(&point, Vec3::Z).eval(Vec3::Z, Vec3::Z);
/// assert!(seen.x > 2.0 * seen.z, "clay is red");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrickWall {
    /// The pattern.
    pub bricks: Brick,
    /// The color of the bricks.
    pub clay: Vec3,
    /// The color of the mortar.
    pub mortar: Vec3,
    /// Relative variation of brightness between bricks, as far as the pixel resolves them.
    pub variation: f32,
    /// Depth of the mortar, in texture coordinates.
    pub depth: f32,
    /// The roughness of the facets, in [0, 1].
    pub roughness: f32,
}

/// The bricks of the lecture in red, 6 mm deep in meters.
impl Default for BrickWall {
    fn default() -> Self {
        Self {
            bricks: Brick::default(),
            clay: Vec3::new(0.38, 0.08, 0.045),
            mortar: Vec3::new(0.46, 0.42, 0.37),
            variation: 0.25,
            depth: 0.006,
            roughness: 0.7,
        }
    }
}

impl Material for BrickWall {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let pixel = point.uv_pixel();
        let sample = self.bricks.filtered(point.uv, pixel);
        let [column, row] = self.bricks.sample(point.uv).cell;
        let own = IntegerHash.word([column, row], 1) as f32 / 4_294_967_296.0 - 0.5;
        let told_apart = pixel.long().kept(1.0 / self.bricks.cell().max_element());
        let clay = self.clay * (1.0 + 2.0 * self.variation * own * told_apart);
        let color = self.mortar.lerp(clay, sample.brick);
        let lobe = EnergyPreservingOrenNayar::new_clamped(color, self.roughness).into();
        Bsdf::new(point.frame(), wo).with_visited([lobe], |add| {
            let mut lit = of_slopes(point, self.depth, add);
            self.bricks.facets(point.uv, pixel, |share, _, slope| lit(share, slope));
        })
    }

    fn height(&self, point: &SurfacePoint) -> f32 {
        self.depth * self.bricks.filtered(point.uv, point.uv_pixel()).height
    }

    fn height_range(&self) -> Option<[f32; 2]> {
        Some([self.depth.min(0.0), self.depth.max(0.0)])
    }
}

/// Visits facets of a height of this depth over texture coordinates, in the frame of the surface.
fn of_slopes(point: &SurfacePoint, depth: f32, add: &mut dyn FnMut(Facet)) -> impl FnMut(f32, Vec2) {
    let (frame, texture) = (point.frame(), point.texture());
    move |share, slope| {
        let normal = bumped_normal(point.normal, texture.of(depth * slope));
        add(Facet::new(share, frame.to_local(normal)));
    }
}

/// Square tiles with a ridge along their edges, on texture coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeveledTiles {
    /// The ridge, for tiles of side 1.
    pub bevel: Bevel,
    /// The side of a tile in texture coordinates; a non-positive side is one tile without an edge.
    pub side: f32,
    /// The color.
    pub color: Vec3,
    /// The roughness of the facets, in [0, 1].
    pub roughness: f32,
}

/// The interval across the nearest edge of a tile that a pixel covers, in sides.
struct EdgeInterval {
    low: f32,
    high: f32,
    /// The fraction beyond the edge, which is the ridge of the next tile.
    beyond: f32,
    away: Vec2,
}

impl BeveledTiles {
    /// The interval that a pixel covers, if it resolves tiles, and the unresolved fraction.
    ///
    /// `None` without edges.
    fn interval(&self, point: &SurfacePoint) -> Option<(Option<EdgeInterval>, f32)> {
        const TILE: [Vec2; 4] = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        let side = Some(self.side).filter(|side| *side > 0.0)?;
        let (at, width) = (point.uv / side, point.texture().width(&point.pixel) / side);
        let far = filtered_fraction(width, 1.0);
        let nearest = Edge::nearest(&TILE, at - at.floor()).filter(|_| far < 1.0);
        let interval = nearest.map(|Edge { distance, away }| {
            let [low, high] = [distance - 0.5 * width, distance + 0.5 * width];
            EdgeInterval { low, high, beyond: if width > 0.0 { (-low / width).max(0.0) } else { 0.0 }, away }
        });
        Some((interval, far))
    }
}

impl Material for BeveledTiles {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let lobe = EnergyPreservingOrenNayar::new_clamped(self.color, self.roughness).into();
        let Some((interval, far)) = self.interval(point) else {
            return Bsdf::new(point.frame(), wo).with([Facet::FLAT], [lobe]);
        };
        Bsdf::new(point.frame(), wo).with_visited([lobe], |add| {
            let mut lit = of_slopes(point, 1.0, add);
            if let Some(EdgeInterval { low, high, beyond, away }) = interval {
                self.bevel.facets(low.max(0.0), high, |share, slope| {
                    lit((1.0 - far) * (1.0 - beyond) * share, slope * away);
                });
                if beyond > 0.0 {
                    self.bevel
                        .facets(0.0, -low, |share, slope| lit((1.0 - far) * beyond * share, -slope * away));
                }
            }
            if far > 0.0 {
                self.bevel.tile(|share, slope| {
                    for away in [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y] {
                        lit(0.25 * far * share, slope * away);
                    }
                });
            }
        })
    }

    fn height(&self, point: &SurfacePoint) -> f32 {
        let Some((interval, far)) = self.interval(point) else { return 0.0 };
        let near = interval.map_or(0.0, |EdgeInterval { low, high, beyond, .. }| {
            let own = (1.0 - beyond) * self.bevel.mean_height(low.max(0.0), high);
            own + if beyond > 0.0 { beyond * self.bevel.mean_height(0.0, -low) } else { 0.0 }
        });
        self.side * (near + far * (self.bevel.mean_height_of_tile() - near))
    }

    fn height_range(&self) -> Option<[f32; 2]> {
        let [low, high] = self.bevel.range();
        let side = if self.side > 0.0 { self.side } else { 0.0 };
        Some([side * low, side * high])
    }
}

/// Paper with stars, on texture coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wallpaper {
    /// The pattern.
    pub stars: StarWallpaper,
    /// The color of the paper.
    pub paper: Vec3,
    /// The color of the stars.
    pub star: Vec3,
    /// The roughness of the facets, in [0, 1].
    pub roughness: f32,
}

impl Material for Wallpaper {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let share = self.stars.coverage(point.uv, point.uv_pixel().long());
        let color = self.paper.lerp(self.star, share);
        Bsdf::new(point.frame(), wo)
            .with([Facet::FLAT], [EnergyPreservingOrenNayar::new_clamped(color, self.roughness).into()])
    }
}

/// Blue marble, by position, under a polish that reflects 4 % at normal incidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolishedMarble {
    /// The veins.
    pub marble: Marble,
    /// Factor of the colors of the lecture.
    pub tint: Vec3,
    /// The roughness of the polish: Beckmann's α; non-positive means stone without polish.
    pub polish: f32,
}

impl Material for PolishedMarble {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let color = self.tint * self.marble.color(point.position, point.footprint());
        let stone = EnergyPreservingOrenNayar::new_clamped(color, 0.0).into();
        let mut bsdf = Bsdf::new(point.frame(), wo);
        bsdf.add_layer([Facet::FLAT], [stone]);
        if self.polish > 0.0 {
            bsdf.add_coat(Coat::clearcoat(Dielectric::new_clamped(1.5)).rough(self.polish));
        }
        bsdf
    }
}

/// A material with texture coordinates displaced by a [`PerturbedTexture`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Perturbed<M> {
    /// The displacement.
    pub by: PerturbedTexture,
    /// The material.
    pub material: M,
}

impl<M> Perturbed<M> {
    /// The point of the material that is seen at a surface point.
    fn seen(&self, point: &SurfacePoint) -> SurfacePoint {
        let there = self.by.filtered(point.position, point.uv, point.footprint());
        // Unresolved displacement blurs the texture.
        let [u, v] = point.tangents.map(Vec3::length);
        let spread = there.spread * Vec2::new(u, v);
        let width = point.footprint().width();
        let sides = (Vec2::splat(width * width) + 12.0 * spread * spread).map(sqrt);
        let [along, across] = point.tangents.map(Vec3::normalize_or_zero);
        let pixel = PixelEllipse::from_derivatives(along * sides.x, across * sides.y);
        let pixel = if there.spread == Vec2::ZERO { point.pixel } else { pixel };
        SurfacePoint { uv: there.uv, pixel, ..*point }
    }
}

impl<M: Material> Material for Perturbed<M> {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        self.material.bsdf(&self.seen(point), wo)
    }

    fn height(&self, point: &SurfacePoint) -> f32 {
        self.material.height(&self.seen(point))
    }

    fn height_range(&self) -> Option<[f32; 2]> {
        self.material.height_range()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Footprint;
    use crate::texture::BevelParameters;
    use asperity_ndf_sampling::Frame;

    #[test]
    fn tiles_of_non_positive_side_have_no_edge() {
        let (wo, wi) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, -0.6, 0.8));
        let lobe = EnergyPreservingOrenNayar::new_clamped(Vec3::ONE, 0.5);
        let flat = Bsdf::new(Frame::IDENTITY, wo).with([Facet::FLAT], [lobe.into()]).eval_cos(wo, wi);
        let bevel = Bevel::new(BevelParameters { plateau: 0.03, ridge: 0.2, top: 0.2, bottom: 0.9 })
            .expect("a ridge");
        for (side, width) in [(0.0, 0.1), (-0.2, 0.0), (-0.2, 0.1), (-0.2, 10.0), (f32::NAN, 0.1)] {
            let tiles = BeveledTiles { bevel, side, color: Vec3::ONE, roughness: 0.5 };
            let point = SurfacePoint::new(Vec3::ZERO, Vec3::Z, Footprint::from_width(width))
                .with_uv(Vec2::new(0.31, 0.17), [Vec3::X, Vec3::Y]);
            assert_eq!(tiles.bsdf(&point, wo).eval_cos(wo, wi), flat, "side {side}, pixel {width}");
        }
    }
}
