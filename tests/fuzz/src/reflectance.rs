//! Reflectances with any parameters: values are finite and nonnegative, and samples have a
//! direction and a density.

use asperity_shading::bump::{
    bumped_normal, displace, flip_to_visible, gradient_of_normal, project_to_tangent_plane, slope_facets,
    surface_gradient,
};
use asperity_shading::glam::Vec3;
use asperity_shading::level_of_detail::ResolvedBumps;
use asperity_shading::pixel::FrequencyClamp;
use asperity_shading::reflectance::{
    Absorption, BlinnPhongBrdf, BlinnPhongNormalization, Brdf, BumpFacets, Conductor, CookTorrance,
    Dielectric, EnergyPreservingOrenNayar, FacetBrdf, Fresnel, Lambert, Lobe, Masking, OrenNayar,
    OrenNayarVariant, Phong, RoughDielectric, Schlick, SchlickF82, TorranceSparrow, WardBrdf,
    WardNormalization,
};
use asperity_shading::{
    Beckmann, Footprint, Frame, Ggx, OpenPbr, OpenPbrParameters, PixelEllipse, ShadingError, StandardMaterial,
    StandardMaterialParameters, half_vector, reflect,
};

use crate::numbers::Numbers;

/// Checks the invariants of every reflectance.
fn brdf<B: Brdf>(made: Result<B, ShadingError>, numbers: &mut Numbers<'_>) {
    let brdf = match made {
        Ok(brdf) => brdf,
        Err(error) => return assert_eq!(error.to_string().lines().count(), 1),
    };
    let (wi, wo) = (numbers.direction(), numbers.direction());
    let sampled = evaluated(&brdf, wi, wo, numbers);
    if (wo.length() - 1.0).abs() < 1e-5 && wo.z > 0.0 {
        assert!(sampled.is_none_or(|wi| (wi.length() - 1.0).abs() < 1e-3), "{sampled:?} from {wo}");
    }
}

/// Evaluates a reflectance in a direction and in a sampled one, which it returns.
fn evaluated(brdf: &dyn Brdf, wi: Vec3, wo: Vec3, numbers: &mut Numbers<'_>) -> Option<Vec3> {
    let sample = brdf.sample(wo, numbers.float(), numbers.pair());
    let sampled = sample.map(|sample| sample.wi);
    for wi in [Some(wi), sampled].into_iter().flatten() {
        let (value, density) = (brdf.eval(wo, wi), brdf.pdf(wo, wi));
        assert!(value.is_finite() && value.min_element() >= 0.0, "{value} for {wi} {wo}");
        assert!(density >= 0.0 && density.is_finite(), "{density} for {wi} {wo}");
    }
    sampled
}

/// Evaluates facets of which a part is resolved.
fn resolved(facets: &dyn FacetBrdf, numbers: &mut Numbers<'_>) {
    let bumps =
        ResolvedBumps { z: numbers.pair(), variance: number(numbers, 1e-6, 1.0), blend: numbers.float() };
    let (wi, wo) = (numbers.direction(), numbers.direction());
    evaluated(&Lobe::bumps(facets, bumps), wi, wo, numbers);
}

/// Returns a number, mostly in a range.
fn number(numbers: &mut Numbers<'_>, low: f32, high: f32) -> f32 {
    if numbers.byte() < 230 { numbers.between(low, high) } else { numbers.float() }
}

fn color(numbers: &mut Numbers<'_>) -> Vec3 {
    if numbers.byte() < 230 { numbers.color() } else { numbers.vector() }
}

fn fresnel(made: Result<impl Fresnel, ShadingError>, numbers: &mut Numbers<'_>) {
    if let Ok(fresnel) = made {
        let share = fresnel.reflectance_rgb(numbers.float());
        assert!(share.cmpge(Vec3::ZERO).all() && share.cmple(Vec3::ONE).all(), "{share}");
    }
}

pub(crate) fn attack(numbers: &mut Numbers<'_>) {
    let (x, y) = (number(numbers, 1e-6, 1e6), number(numbers, 1e-6, 1e6));
    match numbers.byte() % 14 {
        0 => brdf(Lambert::new(color(numbers)), numbers),
        1 => {
            let form = numbers.pick(&[
                OrenNayarVariant::Full,
                OrenNayarVariant::Qualitative,
                OrenNayarVariant::Fujii,
            ]);
            brdf(OrenNayar::new(color(numbers), number(numbers, 1e-6, 2.0), form), numbers);
        }
        2 => brdf(EnergyPreservingOrenNayar::new(color(numbers), number(numbers, 1e-6, 1.0)), numbers),
        3 => brdf(Phong::new(color(numbers), number(numbers, 1e-6, 1e7)), numbers),
        4 => {
            let factor = numbers.pick(&[
                BlinnPhongNormalization::Albedo,
                BlinnPhongNormalization::Approximate,
                BlinnPhongNormalization::Density,
            ]);
            brdf(BlinnPhongBrdf::new(color(numbers), number(numbers, 1e-6, 1e7), factor), numbers);
        }
        5 => {
            let form =
                numbers.pick(&[WardNormalization::Ward, WardNormalization::Dur, WardNormalization::Bounded]);
            brdf(WardBrdf::new(color(numbers), x, y, form), numbers);
        }
        6 => {
            let (Ok(ggx), Ok(glass)) = (Ggx::new(x, y), Dielectric::new(number(numbers, 1e-3, 1e3))) else {
                return;
            };
            let masking = numbers.pick(&[Masking::Separable, Masking::Correlated]);
            let facets = numbers.pick(&[BumpFacets::Visible, BumpFacets::All]);
            let gloss = CookTorrance::new(ggx, glass).with_masking(masking).with_bump_facets(facets);
            brdf(Ok(gloss), numbers);
            resolved(&gloss, numbers);
            brdf(Ok(TorranceSparrow::new(ggx, glass)), numbers);
        }
        7 => {
            let metal = Conductor::new(number(numbers, 1e-3, 1e3), number(numbers, 1e-3, 1e3));
            let (Ok(beckmann), Ok(metal)) = (Beckmann::new(x, y), metal) else { return };
            brdf(Ok(CookTorrance::new(beckmann, metal)), numbers);
        }
        8 => {
            let made = SchlickF82::new(numbers.share(), number(numbers, 1e-6, 1.0));
            let (Ok(ggx), Ok(tinted)) = (Ggx::new(x, y), made) else { return };
            brdf(Ok(CookTorrance::new(ggx, tinted)), numbers);
        }
        9 => {
            let (Ok(ggx), Ok(glass)) = (Ggx::new(x, y), Dielectric::new(number(numbers, 1e-3, 1e3))) else {
                return;
            };
            for glass in
                [RoughDielectric::new(ggx, glass), RoughDielectric::thin(ggx, glass, numbers.vector())]
            {
                let (wi, wo) = (numbers.direction(), numbers.direction());
                evaluated(&glass, wi, wo, numbers);
                resolved(&glass, numbers);
            }
        }
        10 => {
            fresnel(Conductor::new(numbers.float(), numbers.float()), numbers);
            fresnel(Dielectric::new(numbers.float()), numbers);
            fresnel(Ok(Dielectric::new_clamped(numbers.float()).reversed()), numbers);
            fresnel(Schlick::new(numbers.share()), numbers);
            fresnel(SchlickF82::new(numbers.share(), numbers.float()), numbers);
            let made =
                [Absorption::new(numbers.vector()), Absorption::of_color(numbers.color(), numbers.float())];
            for absorption in made.into_iter().flatten() {
                let left = absorption.transmittance(numbers.float());
                assert!(left.cmpge(Vec3::ZERO).all() && left.cmple(Vec3::ONE).all(), "{left}");
            }
            if let Ok(clamp) = FrequencyClamp::new(numbers.float(), numbers.float(), numbers.float()) {
                let octaves = clamp.octaves(Footprint::from_width(numbers.float()));
                assert!(octaves >= 0.0 && octaves <= clamp.max_octaves(), "{octaves}");
                assert!(clamp.footprint(numbers.float()).width() >= 0.0);
            }
        }
        11 => standard(numbers),
        12 => open_pbr(numbers),
        _ => bumps(numbers),
    }
}

/// A material that any number makes.
fn standard(numbers: &mut Numbers<'_>) {
    let material = StandardMaterial::new_clamped(StandardMaterialParameters {
        base_color: color(numbers),
        metallic: number(numbers, 1e-6, 1.0),
        roughness: number(numbers, 1e-6, 1.0),
        emissive: color(numbers),
        ior: number(numbers, 1.0, 1e3),
        specular: number(numbers, 1e-6, 1.0),
        specular_color: color(numbers),
        clearcoat: number(numbers, 1e-6, 1.0),
        clearcoat_roughness: number(numbers, 1e-6, 1.0),
        sheen_color: color(numbers),
        sheen_roughness: number(numbers, 1e-6, 1.0),
        transmission: number(numbers, 1e-6, 1.0),
        thickness: numbers.float(),
        anisotropy: number(numbers, 1e-6, 1.0),
        anisotropy_rotation: number(numbers, 1e-6, 6.0),
    });
    assert!(StandardMaterial::new(*material.parameters()).is_ok(), "{:?}", material.parameters());
    layered(&material, numbers);
}

fn open_pbr(numbers: &mut Numbers<'_>) {
    let made = OpenPbr::new(OpenPbrParameters {
        base_weight: number(numbers, 1e-6, 1.0),
        base_color: color(numbers),
        base_diffuse_roughness: number(numbers, 1e-6, 1.0),
        base_metalness: number(numbers, 1e-6, 1.0),
        specular_weight: number(numbers, 1e-6, 1.0),
        specular_color: color(numbers),
        specular_roughness: number(numbers, 1e-6, 1.0),
        specular_roughness_anisotropy: number(numbers, 1e-6, 1.0),
        specular_ior: number(numbers, 1.0, 3.0),
        transmission_weight: number(numbers, 1e-6, 1.0),
        transmission_color: color(numbers),
        transmission_depth: numbers.float(),
        coat_weight: number(numbers, 1e-6, 1.0),
        coat_color: color(numbers),
        coat_roughness: number(numbers, 1e-6, 1.0),
        coat_ior: number(numbers, 1.0, 3.0),
        fuzz_weight: number(numbers, 1e-6, 1.0),
        fuzz_color: color(numbers),
        fuzz_roughness: number(numbers, 1e-6, 1.0),
        emission_luminance: numbers.float(),
        geometry_thin_walled: numbers.byte() % 2 == 0,
        ..OpenPbrParameters::default()
    });
    match made {
        Ok(material) => layered(&material, numbers),
        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
    }
}

fn layered(material: &dyn FacetBrdf, numbers: &mut Numbers<'_>) {
    let (wi, wo) = (numbers.direction(), numbers.direction());
    evaluated(material, wi, wo, numbers);
    resolved(material, numbers);
    let emitted = material.emitted(wo);
    assert!(emitted.is_finite() && emitted.min_element() >= 0.0, "{emitted} towards {wo}");
}

fn bumps(numbers: &mut Numbers<'_>) {
    let n = numbers.unit();
    let (g, slope, p) = (numbers.vector(), numbers.pair(), [numbers.vector(), numbers.vector()]);
    let frame = Frame::from_normal(n);
    for gradient in
        [g, surface_gradient(n, p, slope), project_to_tangent_plane(n, g), gradient_of_normal(&frame, p[0])]
    {
        let bumped = bumped_normal(n, gradient);
        assert!((bumped.length() - 1.0).abs() < 1e-5 && bumped.dot(n) > 0.0, "{bumped} of {n} {gradient}");
        let seen = flip_to_visible(n, bumped, p[1]);
        assert!((seen.length() - 1.0).abs() < 1e-5, "{seen}");
        let mut shares = 0.0;
        for facet in slope_facets(n, bumped, numbers.float()) {
            assert!((facet.normal.length() - 1.0).abs() < 1e-4);
            shares += facet.weight;
        }
        assert!((shares - 1.0).abs() < 1e-4, "{shares}");
    }
    let normal = displace(g, n, p, p, slope.x, slope).normal;
    assert!((normal.length() - 1.0).abs() < 1e-5, "{normal}");
    let h = half_vector(numbers.direction(), numbers.direction());
    assert!(h.is_finite() && h.length() < 1.0 + 1e-5, "{h}");
    let _ = reflect(numbers.direction(), numbers.direction());
    let pixel = PixelEllipse::from_derivatives(p[0], p[1]);
    assert!(pixel.long().width() >= pixel.short().width() && pixel.change(g) >= 0.0, "{pixel:?}");
    let most = numbers.word() % 40;
    assert!((1..=most.max(1) as usize).contains(&pixel.taps(most).count()), "{pixel:?}");
    for footprint in [
        Footprint::from_distance(numbers.float(), numbers.float(), numbers.float()),
        Footprint::from_derivatives(p[0], p[1]),
        Footprint::from_width(numbers.float()),
    ] {
        assert!(
            footprint.width() >= 0.0 && (0.0..=1.0).contains(&footprint.kept(numbers.float())),
            "{footprint:?}"
        );
    }
}
