//! A BSDF in the metallic–roughness model, which textures of engines hold.

use glam::{Vec2, Vec3};

use crate::math::{clamp_to, sqrt};
use crate::normal_map::SlopeMoments;
use crate::reflectance::{Bsdf, LobePart};

/// A point of a surface as the metallic–roughness model has it: one diffuse lobe of a dielectric, or one lobe of a metal, or between.
///
/// ```text
/// diffuse = base (1 − metallic) (1 − F₀),   F₀ = 0.04 (1 − metallic) + base · metallic
/// ```
///
/// Diffuse lobes of a [`Bsdf`] and the reflectances at normal incidence of its glossy ones give base colour and metallic by the rule
/// of Khronos's extension KHR_materials_pbrSpecularGlossiness. Slopes are those of all facets by the share of light that their lobes send on,
/// and `alpha2` is the mean of Beckmann's α² about them, so that `alpha2` plus the trace of their covariance is that of the whole. A
/// varnish is the dielectric's own lobe over what is matt, and a clear coat over what is glossy. A matt surface has α = 1.
///
/// Light that is sent whatever the light, sparkles and counted flakes are left out, and the roughness of diffuse lobes is.
///
/// ```
/// use asperity_shading::glam::Vec3;
/// use asperity_shading::material::MetallicRoughness;
/// use asperity_shading::reflectance::{Bsdf, Coat};
///
/// let gold = Vec3::new(1.0, 0.77, 0.34);
/// let bsdf = Bsdf::new(Vec3::Z).with_coat(Coat::metal(gold).rough(0.2));
/// let seen = MetallicRoughness::of(&bsdf).ok_or("no lobes")?;
/// assert_eq!((seen.base_colour, seen.metallic), (gold, 1.0));
/// assert!((seen.alpha2 - 0.04).abs() < 1e-6);
/// # Ok::<(), &str>(())
/// ```
#[doc(alias = "pbr")]
#[doc(alias = "gltf")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicRoughness {
    /// The linear base colour, in [0, 1]³.
    pub base_colour: Vec3,
    /// From 0, a dielectric, to 1, a metal.
    pub metallic: f32,
    /// Moments of the slopes `(n_x, n_y)/n_z` of the facets, in the frame of the surface.
    pub slopes: SlopeMoments,
    /// The mean of α² about the facets, in [0, 1].
    pub alpha2: f32,
    /// α of a clear coat over a glossy surface, if there is one.
    pub coat: Option<f32>,
}

/// Reflectance of a dielectric at normal incidence in the model.
const DIELECTRIC: f32 = 0.04;

impl MetallicRoughness {
    /// The model's parameters of a BSDF; none of one without lobes, one that transmits, and one with a lobe that has no colours.
    #[must_use]
    pub fn of(bsdf: &Bsdf<'_>) -> Option<Self> {
        let (mut diffuse, mut specular) = (Vec3::ZERO, Vec3::ZERO);
        let (mut matt, mut glossy, mut varnish) = (Mean::default(), Mean::default(), Mean::default());
        for (share, normal, part) in bsdf.parts() {
            let slope = Vec2::new(normal.x, normal.y) / normal.z.max(1e-3);
            match part? {
                LobePart::Diffuse(albedo) => {
                    diffuse += share * albedo;
                    matt.add(share * brightness(albedo), slope, 1.0);
                }
                LobePart::Glossy(colour, alpha2) => {
                    specular += share * colour;
                    glossy.add(share * brightness(colour), slope, alpha2);
                }
                LobePart::Varnish(alpha2) => varnish.add(share, slope, alpha2),
            }
        }
        let (shown, coat) = match (glossy.weight > 0.0, varnish.weight > 0.0) {
            (true, true) => (glossy, Some(sqrt(varnish.alpha2))),
            (true, false) => (glossy, None),
            (false, true) => (varnish, None),
            (false, false) => (matt, None),
        };
        let (base_colour, metallic) = base_colour(diffuse, specular);
        let unit = Vec3::from_array(base_colour.to_array().map(|x| clamp_to(x, 1.0)));
        let any = shown.weight > 0.0 || matt.weight > 0.0 || bsdf.parts().next().is_some();
        any.then_some(Self {
            base_colour: unit,
            metallic,
            slopes: shown.slopes,
            alpha2: if shown.weight > 0.0 { clamp_to(shown.alpha2, 1.0) } else { 1.0 },
            coat,
        })
    }
}

/// Slopes and α² by their share of light.
#[derive(Clone, Copy, Default)]
struct Mean {
    weight: f32,
    slopes: SlopeMoments,
    alpha2: f32,
}

impl Mean {
    fn add(&mut self, weight: f32, slope: Vec2, alpha2: f32) {
        if weight > 0.0 {
            let parts = [(self.weight, self.slopes), (weight, SlopeMoments::point(slope))];
            self.slopes = SlopeMoments::mixed(parts);
            self.weight += weight;
            self.alpha2 += weight / self.weight * (alpha2 - self.alpha2);
        }
    }
}

/// Perceived brightness of a colour (Finley 2006, "HSP Color Model").
fn brightness(colour: Vec3) -> f32 {
    sqrt((colour * colour).dot(Vec3::new(0.299, 0.587, 0.114)).max(0.0))
}

/// Base colour and metallic of a surface that sends on so much from below and so much from its facets.
///
/// ```text
/// 0.04 m² + b m + (0.04 − s) = 0,   b = d (1 − max s)/(1 − 0.04) + s − 2 · 0.04
/// ```
///
/// d and s the brightness of either; from there base colours of both parts, the metal's with the share m².
fn base_colour(diffuse: Vec3, specular: Vec3) -> (Vec3, f32) {
    let (d, s) = (brightness(diffuse), brightness(specular));
    let left = 1.0 - specular.max_element();
    if s < DIELECTRIC {
        return (diffuse, 0.0);
    }
    if d <= 0.0 {
        return (specular, 1.0);
    }
    let b = d * left / (1.0 - DIELECTRIC) + s - 2.0 * DIELECTRIC;
    let root = sqrt((b * b - 4.0 * DIELECTRIC * (DIELECTRIC - s)).max(0.0));
    let metallic = clamp_to((root - b) / (2.0 * DIELECTRIC), 1.0);
    let from_diffuse = diffuse * (left / (1.0 - DIELECTRIC) / (1.0 - metallic).max(1e-4));
    let from_specular = (specular - DIELECTRIC * (1.0 - metallic)) / metallic.max(1e-4);
    (from_diffuse.lerp(from_specular, metallic * metallic), metallic)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bump::{Facet, bumped_normal};
    use crate::reflectance::{Coat, CookTorrance, Dielectric, EnergyPreservingOrenNayar, Lobe};
    use asperity_ndf_sampling::Beckmann;

    fn facets() -> [Facet; 2] {
        [-0.3, 0.5].map(|x| Facet::new(0.5, bumped_normal(Vec3::Z, Vec3::new(-x, 0.0, 0.0))))
    }

    fn glossy(colour: Vec3, alpha: f32) -> Lobe<'static> {
        CookTorrance::new(Beckmann::clamped(alpha, alpha), colour).into()
    }

    #[test]
    fn matt_glossy_and_varnished_surfaces_are_told_apart() {
        let clay = Vec3::new(0.4, 0.2, 0.1);
        let chalk = || Lobe::from(EnergyPreservingOrenNayar::clamped(clay, 0.5));
        let matt = MetallicRoughness::of(&Bsdf::new(Vec3::Z).with(facets(), [chalk()])).unwrap();
        assert_eq!((matt.base_colour, matt.metallic, matt.alpha2, matt.coat), (clay, 0.0, 1.0, None));
        assert_abs_diff_eq!(matt.slopes.mean, Vec2::new(0.1, 0.0), epsilon = 1e-6);
        assert_abs_diff_eq!(matt.slopes.covariance[0], 0.16, epsilon = 1e-5);

        let varnish = Coat::varnish(Dielectric::clamped(1.5)).rough(0.1);
        let varnished = Bsdf::new(Vec3::Z).with([Facet::FLAT], [chalk()]).with_coat(varnish);
        let varnished = MetallicRoughness::of(&varnished).unwrap();
        assert_eq!((varnished.base_colour, varnished.metallic, varnished.coat), (clay, 0.0, None));
        assert_abs_diff_eq!(varnished.alpha2, 0.01, epsilon = 1e-6);

        let gold = Vec3::new(1.0, 0.77, 0.34);
        let metal = Bsdf::new(Vec3::Z).with(facets(), [glossy(gold, 0.3)]);
        let plain = MetallicRoughness::of(&metal).unwrap();
        assert_eq!((plain.base_colour, plain.metallic, plain.coat), (gold, 1.0, None));
        assert_abs_diff_eq!(plain.alpha2, 0.09, epsilon = 1e-6);
        let coated = MetallicRoughness::of(&metal.with_coat(varnish)).unwrap();
        assert_eq!((coated.base_colour, coated.metallic), (gold, 1.0));
        assert_abs_diff_eq!(coated.coat.unwrap(), 0.1, epsilon = 1e-6);
    }

    #[test]
    fn the_model_sends_on_as_much_as_the_surface() {
        for (d, s) in [(0.5, 0.04), (0.3, 0.2), (0.1, 0.6), (0.02, 0.9)] {
            let (diffuse, specular) = (Vec3::splat(d), Vec3::splat(s));
            let (base, metallic) = base_colour(diffuse, specular);
            let below = base * ((1.0 - metallic) * (1.0 - DIELECTRIC));
            let facets = Vec3::splat(DIELECTRIC).lerp(base, metallic);
            // The model's diffuse part lies below its facets.
            assert_abs_diff_eq!(below, diffuse * (1.0 - s), epsilon = 2e-3, "{d}, {s}: {base}, {metallic}");
            assert_abs_diff_eq!(facets, specular, epsilon = 2e-3, "{d}, {s}: {base}, {metallic}");
        }
    }

    #[test]
    fn glass_and_nothing_have_no_such_parameters() {
        let glass = Coat::body(Dielectric::clamped(1.5));
        assert_eq!(MetallicRoughness::of(&Bsdf::new(Vec3::Z).with_coat(glass.rough(0.2))), None);
        assert_eq!(MetallicRoughness::of(&Bsdf::new(Vec3::Z).with_coat(glass)), None);
        assert_eq!(MetallicRoughness::of(&Bsdf::new(Vec3::Z)), None);
        let mirror = MetallicRoughness::of(&Bsdf::new(Vec3::Z).with_coat(Coat::metal(Vec3::ONE))).unwrap();
        assert_eq!((mirror.metallic, mirror.alpha2), (1.0, 0.0));
    }
}
