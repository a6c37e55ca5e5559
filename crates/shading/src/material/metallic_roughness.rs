//! Conversion of a BSDF to the metallic–roughness model of engine textures.

use glam::{Vec2, Vec3};

use crate::math::{clamp_to, sqrt};
use crate::normal_map::SlopeMoments;
use crate::reflectance::{Bsdf, LobePart};

/// A point of a surface in the metallic–roughness model of glTF 2.0.
///
/// ```text
/// diffuse  = (1 − F₀) lerp(base, 0, metallic)
/// specular = F₀ = lerp(0.04, base, metallic)
/// ```
///
/// `diffuse` is the albedo of all diffuse lobes of a [`Bsdf`] and `specular` the reflectance of all
/// glossy lobes at normal incidence, in each channel. [`of`](Self::of) inverts the model. The
/// result for a surface of these lobes has the original base color and metallic, and the same lobes
/// to 3·10⁻⁷. If all channels of the base color are at most 0.04, two pairs have the same lobes,
/// and the result is the less metallic one.
///
/// For a surface with other lobes, such as [`MetallicPaint`](crate::MetallicPaint), the base color
/// and the metallic minimize the squared difference of `diffuse/(1 − specular)` and of `specular`
/// over the channels. A surface without glossy lobes has metallic 0 and its albedo as base color,
/// also under a varnish. Its diffuse light is multiplied by 1 − F twice, but in the model once, so
/// the model is brighter by 4 % for an index of 1.5.
///
/// Slopes are means over all facets, weighted by the light of their lobes. `alpha2` is the mean of
/// Beckmann's α² around the facets, so `alpha2` plus the trace of the covariance of the slopes
/// describes the whole surface. A varnish is the dielectric lobe of the model over a diffuse
/// surface, and a clearcoat over a glossy surface. A diffuse surface has α = 1.
///
/// Emission, sparkles, counted flakes and the roughness of diffuse lobes are omitted.
///
/// Khronos Group 2021, *glTF 2.0 Specification*, Appendix B.
///
/// ```
/// use asperity_shading::{Frame, glam::Vec3};
/// use asperity_shading::material::MetallicRoughness;
/// use asperity_shading::reflectance::{Bsdf, Coat};
///
/// let gold = Vec3::new(1.0, 0.77, 0.34);
/// let bsdf = Bsdf::new(Frame::IDENTITY, Vec3::Z).with_coat(Coat::conductor(gold).rough(0.2));
/// let seen = MetallicRoughness::of(&bsdf).ok_or("no lobes")?;
/// assert_eq!((seen.base_color, seen.metallic), (gold, 1.0));
/// assert!((seen.alpha2 - 0.04).abs() < 1e-6);
/// # Ok::<(), &str>(())
/// ```
#[doc(alias = "pbr")]
#[doc(alias = "gltf")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicRoughness {
    /// The linear base color, in [0, 1]³.
    pub base_color: Vec3,
    /// From 0, a dielectric, to 1, a metal.
    pub metallic: f32,
    /// Moments of the slopes `(n_x, n_y)/n_z` of the facets, in the frame of the surface.
    pub slopes: SlopeMoments,
    /// The mean of α² around the facets, in [0, 1].
    pub alpha2: f32,
    /// α of a clearcoat over a glossy surface, if present.
    pub coat: Option<f32>,
}

/// Reflectance of a dielectric at normal incidence in the model.
const DIELECTRIC: f64 = 0.04;

impl MetallicRoughness {
    /// The parameters of the model for a BSDF.
    ///
    /// `None` for a BSDF without lobes, a BSDF that transmits, and a BSDF with a lobe without
    /// colors.
    #[must_use]
    pub fn of(bsdf: &Bsdf<'_>) -> Option<Self> {
        let (mut diffuse, mut specular, mut facets) = (Vec3::ZERO, Vec3::ZERO, false);
        let (mut matt, mut glossy, mut varnish) = (Mean::default(), Mean::default(), Mean::default());
        for (share, normal, part) in bsdf.parts() {
            let slope = Vec2::new(normal.x, normal.y) / normal.z.max(1e-3);
            match part? {
                LobePart::Diffuse(albedo) => {
                    diffuse += share * albedo;
                    matt.add(share * brightness(albedo), slope, 1.0);
                }
                LobePart::Glossy(color, alpha2) => {
                    specular += share * color;
                    facets = true;
                    glossy.add(share * brightness(color), slope, alpha2);
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
        let (base_color, metallic) = if facets {
            base_color(diffuse, specular)
        } else {
            (Vec3::from_array(diffuse.to_array().map(|x| clamp_to(x, 1.0))), 0.0)
        };
        let any = shown.weight > 0.0 || matt.weight > 0.0 || bsdf.parts().next().is_some();
        any.then_some(Self {
            base_color,
            metallic,
            slopes: shown.slopes,
            alpha2: if shown.weight > 0.0 { clamp_to(shown.alpha2, 1.0) } else { 1.0 },
            coat,
        })
    }
}

/// Slopes and α² weighted by their fraction of light.
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

/// Perceived brightness of a color (Finley 2006, "HSP Color Model").
fn brightness(color: Vec3) -> f32 {
    sqrt((color * color).dot(Vec3::new(0.299, 0.587, 0.114)).max(0.0))
}

/// Base color and metallic of the nearest surface of the glTF 2.0 model.
///
/// With `c = diffuse/(1 − specular)`, the squared difference is smallest for the base color
///
/// ```text
/// b(t) = (t c + (1 − t) (s − 0.04 t))/(t² + (1 − t)²),   t = 1 − metallic
/// ```
///
/// in each channel, within [0, 1]. The difference of one channel is 0 at the roots of `0.04 t² −
/// (c + s) t + c`. The search for the minimum of the sum over all channels starts at the best of
/// these roots and a few steps.
fn base_color(diffuse: Vec3, specular: Vec3) -> (Vec3, f32) {
    let lobes: [[f64; 2]; 3] = core::array::from_fn(|i| {
        let specular = f64::from(clamp_to(specular[i], 1.0));
        let left = 1.0 - specular;
        let diffuse = f64::from(clamp_to(diffuse[i], 1.0));
        [if diffuse < left { diffuse / left } else { f64::from(u8::from(diffuse > 0.0)) }, specular]
    });
    let base = |t: f64, [c, s]: [f64; 2]| {
        ((t * c + (1.0 - t) * (s - DIELECTRIC * t)) / (t * t + (1.0 - t) * (1.0 - t))).clamp(0.0, 1.0)
    };
    let apart = |t: f64| {
        let of = |[c, s]: [f64; 2]| {
            let b = base(t, [c, s]);
            let [diffuse, specular] = [b * t - c, DIELECTRIC * t + b * (1.0 - t) - s];
            diffuse * diffuse + specular * specular
        };
        lobes.into_iter().map(of).sum::<f64>()
    };
    let roots = lobes.into_iter().flat_map(|[c, s]| {
        let root = f64::from(sqrt(((c + s) * (c + s) - 4.0 * DIELECTRIC * c).max(0.0) as f32));
        let sum = c + s + root;
        [if sum > 0.0 { 2.0 * c / sum } else { 0.0 }, sum / (2.0 * DIELECTRIC)].map(|t| t.min(1.0))
    });
    let steps = (0..=STEPS).rev().map(|k| f64::from(k) / f64::from(STEPS));
    // The less metallic of two surfaces with the same lobes.
    let start = steps.chain(roots).fold((0.0, f64::INFINITY), |best, t| {
        let next = apart(t);
        let nearer = if t > best.0 { next < best.1 + SAME } else { next < best.1 - SAME };
        if nearer { (t, next) } else { best }
    });
    let t = least(apart, start.0, 1.0 / f64::from(STEPS));
    let color = Vec3::from_array(lobes.map(|lobe| base(t, lobe) as f32));
    (color, (1.0 - t) as f32)
}

/// Starts of the search, next to the roots.
const STEPS: u8 = 16;
/// The squared difference of lobes that are equal up to the rounding of `f32`.
const SAME: f64 = 1e-13;

/// The minimum of a function within `step` of a start and within [0, 1], by the golden section.
fn least(f: impl Fn(f64) -> f64, best: f64, step: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let [mut low, mut high] = [(best - step).max(0.0), (best + step).min(1.0)];
    let (mut place, mut value) = (best, f(best));
    for _ in 0..40 {
        let [a, b] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        let [at_a, at_b] = [f(a), f(b)];
        for (t, at) in [(a, at_a), (b, at_b)] {
            if at < value {
                (place, value) = (t, at);
            }
        }
        if at_a < at_b {
            high = b;
        } else {
            low = a;
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bump::{Facet, bumped_normal};
    use crate::reflectance::{Coat, CookTorrance, Dielectric, EnergyPreservingOrenNayar, Lobe};
    use asperity_core::assert_abs_diff_eq;
    use asperity_ndf_sampling::{Beckmann, Frame};

    fn facets() -> [Facet; 2] {
        [-0.3, 0.5].map(|x| Facet::new(0.5, bumped_normal(Vec3::Z, Vec3::new(-x, 0.0, 0.0))))
    }

    fn glossy(color: Vec3, alpha: f32) -> Lobe<'static> {
        CookTorrance::new(Beckmann::new_clamped(alpha, alpha), color).into()
    }

    #[test]
    fn of_distinguishes_matte_glossy_and_varnished_surfaces() {
        let clay = Vec3::new(0.4, 0.2, 0.1);
        let chalk = || Lobe::from(EnergyPreservingOrenNayar::new_clamped(clay, 0.5));
        let matt =
            MetallicRoughness::of(&Bsdf::new(Frame::IDENTITY, Vec3::Z).with(facets(), [chalk()])).unwrap();
        assert_eq!((matt.base_color, matt.metallic, matt.alpha2, matt.coat), (clay, 0.0, 1.0, None));
        assert_abs_diff_eq!(matt.slopes.mean, Vec2::new(0.1, 0.0), epsilon = 1e-6);
        assert_abs_diff_eq!(matt.slopes.covariance[0], 0.16, epsilon = 1e-5);

        let varnish = Coat::clearcoat(Dielectric::new_clamped(1.5)).rough(0.1);
        let varnished = Bsdf::new(Frame::IDENTITY, Vec3::Z).with([Facet::FLAT], [chalk()]).with_coat(varnish);
        let varnished = MetallicRoughness::of(&varnished).unwrap();
        assert_eq!((varnished.base_color, varnished.metallic, varnished.coat), (clay, 0.0, None));
        assert_abs_diff_eq!(varnished.alpha2, 0.01, epsilon = 1e-6);

        let gold = Vec3::new(1.0, 0.77, 0.34);
        let metal = Bsdf::new(Frame::IDENTITY, Vec3::Z).with(facets(), [glossy(gold, 0.3)]);
        let plain = MetallicRoughness::of(&metal).unwrap();
        assert_eq!((plain.base_color, plain.metallic, plain.coat), (gold, 1.0, None));
        assert_abs_diff_eq!(plain.alpha2, 0.09, epsilon = 1e-6);
        let coated = MetallicRoughness::of(&metal.with_coat(varnish)).unwrap();
        assert_eq!((coated.base_color, coated.metallic), (gold, 1.0));
        assert_abs_diff_eq!(coated.coat.unwrap(), 0.1, epsilon = 1e-6);
    }

    /// The diffuse albedo and the specular color of the glTF 2.0 model.
    fn model(base: Vec3, metallic: f32) -> [Vec3; 2] {
        let specular = Vec3::splat(DIELECTRIC as f32).lerp(base, metallic);
        [base * (1.0 - metallic) * (Vec3::ONE - specular), specular]
    }

    fn of_lobes([diffuse, specular]: [Vec3; 2]) -> MetallicRoughness {
        let chalk = EnergyPreservingOrenNayar::new_clamped(diffuse, 0.0);
        MetallicRoughness::of(
            &Bsdf::new(Frame::IDENTITY, Vec3::Z).with([Facet::FLAT], [glossy(specular, 0.3), chalk.into()]),
        )
        .unwrap()
    }

    #[test]
    fn metallic_roughness_of_inverts_the_gltf_model() {
        let steps: [f32; 11] = core::array::from_fn(|k| k as f32 / 10.0);
        let levels = [0.0, 0.003, 0.02, 0.04, 0.1, 0.3, 0.5, 0.77, 1.0];
        for &metallic in &steps {
            for k in 0..levels.len().pow(3) {
                let base = Vec3::from([1, 9, 81].map(|stride| levels[k / stride % 9]));
                let lobes = model(base, metallic);
                let seen = of_lobes(lobes);
                let again = model(seen.base_color, seen.metallic);
                // Five roundings of numbers up to 1.
                let light = (again[0] - lobes[0]).abs().max((again[1] - lobes[1]).abs()).max_element();
                assert!(light < 3e-7, "{base}, {metallic}: {again:?} of {lobes:?}, {seen:?}");
                // Otherwise (0.04 (1 − m), 1 − b/0.04) has the lobes of (b, m).
                if base.max_element() > DIELECTRIC as f32 {
                    // Two roundings by the slope b − 0.04 t of the polynomial, at least 0.06.
                    let apart = (seen.base_color - base).abs().max_element();
                    let worst = apart.max((seen.metallic - metallic).abs());
                    assert!(worst < 2e-6, "{base}, {metallic}: {seen:?}");
                }
            }
        }
    }

    #[test]
    fn metallic_roughness_of_other_lobes_is_the_nearest_fit() {
        let apart = |lobes: [Vec3; 2], base: Vec3, metallic: f32| {
            let [below, specular] = [base * (1.0 - metallic), Vec3::splat(0.04).lerp(base, metallic)];
            let below = below - lobes[0] / (Vec3::ONE - lobes[1]);
            below.length_squared() + (specular - lobes[1]).length_squared()
        };
        let colors = [Vec3::new(0.02, 0.05, 0.14), Vec3::new(0.3, 0.02, 0.1), Vec3::splat(0.39)];
        let facets = [Vec3::new(0.25, 0.35, 0.6), Vec3::splat(0.02), Vec3::splat(0.5)];
        for lobes in colors.into_iter().flat_map(|color| facets.map(|facet| [color, facet])) {
            let seen = of_lobes(lobes);
            let found = apart(lobes, seen.base_color, seen.metallic);
            for metallic in (0..=100).map(|k| k as f32 / 100.0) {
                // The best base color of each channel on a grid.
                let best = Vec3::from([0, 1, 2].map(|channel| {
                    let of = |k: u16| {
                        apart(
                            lobes.map(|lobe| Vec3::splat(lobe[channel])),
                            Vec3::splat(f32::from(k) / 100.0),
                            metallic,
                        )
                    };
                    let best = (0..=100).min_by(|a, b| of(*a).total_cmp(&of(*b)));
                    f32::from(best.unwrap()) / 100.0
                }));
                let other = apart(lobes, best, metallic);
                assert!(found < other + 1e-6, "{lobes:?}: {seen:?} {found}, {best} {metallic} {other}");
            }
        }
    }

    #[test]
    fn of_glass_and_empty_bsdfs_is_none() {
        let glass = Coat::dielectric(Dielectric::new_clamped(1.5));
        assert_eq!(
            MetallicRoughness::of(&Bsdf::new(Frame::IDENTITY, Vec3::Z).with_coat(glass.rough(0.2))),
            None
        );
        assert_eq!(MetallicRoughness::of(&Bsdf::new(Frame::IDENTITY, Vec3::Z).with_coat(glass)), None);
        assert_eq!(MetallicRoughness::of(&Bsdf::new(Frame::IDENTITY, Vec3::Z)), None);
        let mirror =
            MetallicRoughness::of(&Bsdf::new(Frame::IDENTITY, Vec3::Z).with_coat(Coat::conductor(Vec3::ONE)))
                .unwrap();
        assert_eq!((mirror.metallic, mirror.alpha2), (1.0, 0.0));
    }
}
