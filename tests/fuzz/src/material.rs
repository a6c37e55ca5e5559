//! Materials and textures with any parameters, at any point, from any direction.

use asperity_shading::glam::Vec3;
use asperity_shading::level_of_detail::{RemappedOctaves, facet_coordinates, shade_facet};
use asperity_shading::material::{
    Elimination, Fibers, FibersParameters, GlassBody, GlassWaves, GlintField, PaintFlakes, SeamPattern,
    Seams, SeamsParameters,
};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise, Perlin};
use asperity_shading::texture::{
    Bevel, BevelParameters, Edge, Gas, PerturbedTexture, StarWallpaper, StarWallpaperParameters, Steam, march,
};
use asperity_shading::{
    Beckmann, Brick, BumpField, BumpMapped, Carpet, CarpetParameters, Footprint, Frame, Ggx, LevelOfDetail,
    Marble, Material, MetallicPaint, MetallicPaintParameters, PixelEllipse, Scratches, ScratchesParameters,
    ShadingError, SurfacePoint, TemperedGlass, TemperedGlassParameters, Variations, VariationsParameters,
};

use crate::numbers::Numbers;

/// Returns a size, mostly in range.
fn size(numbers: &mut Numbers<'_>) -> f32 {
    if numbers.byte() < 250 { numbers.between(1e-6, 1e6) } else { numbers.float() }
}

fn share(numbers: &mut Numbers<'_>) -> f32 {
    if numbers.byte() < 250 { numbers.share() } else { numbers.float() }
}

fn point(numbers: &mut Numbers<'_>) -> SurfacePoint {
    let pixel = PixelEllipse::from_derivatives(numbers.vector(), numbers.vector());
    let pixel = if numbers.byte() < 128 { Footprint::from_width(numbers.float()).into() } else { pixel };
    SurfacePoint::new(numbers.vector(), numbers.unit(), pixel)
        .with_uv(numbers.pair(), [numbers.vector(), numbers.vector()])
}

/// Checks the invariants of every material.
fn material<M: Material>(made: Result<M, ShadingError>, numbers: &mut Numbers<'_>) {
    let material = match made {
        Ok(material) => material,
        Err(error) => return assert_eq!(error.to_string().lines().count(), 1),
    };
    let (point, wo) = (point(numbers), numbers.direction());
    let bsdf = material.bsdf(&point, wo);
    let light = |c: Vec3| assert!(c.is_finite() && c.min_element() >= 0.0, "{c} at {point:?} from {wo}");
    light(bsdf.emitted());
    assert!(material.height(&point).is_finite(), "{} at {point:?}", material.height(&point));
    let u = numbers.pair();
    let sample = bsdf.sample(wo, numbers.float(), u);
    for wi in [Some(numbers.direction()), sample.map(|sample| sample.wi)].into_iter().flatten() {
        light(bsdf.eval(wo, wi));
        let density = bsdf.pdf(wo, wi);
        assert!(density >= 0.0 && density.is_finite(), "{density} for {wi} {wo} at {point:?}");
    }
    if let Some(sample) = sample {
        light(sample.weight());
        assert!(sample.pdf > 0.0, "{sample:?}");
    }
    for sample in bsdf.specular_samples(wo, u).into_iter().flatten() {
        assert!(sample.wi.is_finite() && sample.eval_cos.min_element() >= 0.0, "{sample:?}");
        assert!(sample.eval_cos.max_element() <= 1.0 + 1e-5, "{sample:?}");
    }
}

fn carpet(numbers: &mut Numbers<'_>) {
    let fibers = FibersParameters {
        fiber_length: size(numbers),
        fiber_width: numbers.between(0.01, 0.3),
        fiber_bend: 0.3 * share(numbers),
        fiber_direction: numbers.pair(),
        fiber_spread: share(numbers),
        fiber_contrast: share(numbers),
        seed: numbers.word(),
    };
    if let Ok(fibers) = Fibers::new(fibers) {
        let fiber = fibers.sample(numbers.pair(), Footprint::from_width(numbers.float()));
        assert!(fiber.factor >= 0.0 && fiber.factor.is_finite() && fiber.slope.is_finite(), "{fiber:?}");
    }
    let parameters = CarpetParameters {
        diffuse: numbers.color(),
        specular: numbers.color(),
        diffuse_thread_size: size(numbers),
        diffuse_thread_strength: share(numbers),
        specular_thread_size: size(numbers),
        specular_thread_strength: share(numbers),
        dark_area_size: size(numbers),
        dark_area_strength: share(numbers),
        seams_propagation: numbers.pair(),
        seams_pattern: numbers.pick(&[SeamPattern::None, SeamPattern::Lines, SeamPattern::Grid]),
        seam_distance: size(numbers),
        seams_amplitude: share(numbers),
        roughness: share(numbers),
        fake_rim_light: share(numbers),
        fake_rim_light_width: share(numbers),
        fibers,
        ..CarpetParameters::default()
    };
    material(Carpet::new(parameters), numbers);
    let seams = SeamsParameters {
        seams_pattern: numbers.pick(&[SeamPattern::Lines, SeamPattern::Grid]),
        seams_propagation: numbers.pair(),
        seam_distance: size(numbers),
        seams_amplitude: share(numbers),
    };
    if let Ok(seams) = Seams::new(seams) {
        let _ = seams.filtered(numbers.pair(), PixelEllipse::aligned(numbers.pair()));
        let _ = seams.rounded(numbers.pair(), numbers.float());
    }
}

fn paint(numbers: &mut Numbers<'_>) {
    let unit = size(numbers);
    let parameters = MetallicPaintParameters {
        specular: numbers.color(),
        orange_peel_strength: share(numbers),
        orange_peel_size: size(numbers),
        flake_sparkle_pixel_size: 1000.0 * share(numbers),
        flake_sparkle_physical_size: size(numbers),
        flake_sparkle_variation: share(numbers),
        flake_sparkle_boost: share(numbers),
        flake_sparkle_elimination: share(numbers),
        smart_flake_sparkle: numbers.pick(&[Elimination::Fixed, Elimination::Adaptive { unit }]),
        passive_flake_size: size(numbers),
        passive_flake_strength: share(numbers),
        passive_flake_detail: numbers.word() % 10,
        flake_roughness: share(numbers),
        flakes: numbers.pick(&[PaintFlakes::Sparkling, PaintFlakes::Counted { spacing: unit, bin: 0.05 }]),
        coat_index: 1.0 + share(numbers),
        coat_roughness: share(numbers),
        seed: numbers.word(),
        ..MetallicPaintParameters::default()
    };
    material(MetallicPaint::new(parameters), numbers);
    if let Ok(field) =
        GlintField::new(Beckmann::new_clamped(0.3, 0.3), size(numbers), share(numbers), numbers.word())
    {
        let (h, p, spread) = (numbers.direction(), numbers.vector(), numbers.float());
        let pixel = PixelEllipse::from_derivatives(numbers.vector(), numbers.vector());
        let density = field.density_over(h, spread, p, &pixel);
        assert!(
            density >= 0.0 && density.is_finite(),
            "{density} of {field:?} for {h:?}, {spread} at {p:?}, {pixel:?}"
        );
        let m = field.sample(numbers.pair(), p, &pixel);
        assert!((m.length() - 1.0).abs() < 1e-5 && m.z >= 0.0, "{m} of {field:?} at {p:?}, {pixel:?}");
        if let Some(flake) = field.flake(numbers.vector()) {
            assert!((flake.normal.length() - 1.0).abs() < 1e-5 && flake.center.is_finite(), "{flake:?}");
        }
    }
}

fn glass(numbers: &mut Numbers<'_>) {
    let parameters = TemperedGlassParameters {
        wave_frequency: size(numbers),
        wave_amplitude: size(numbers),
        wave_propagation_vector: numbers.direction(),
        waves: numbers.pick(&[GlassWaves::Sine, GlassWaves::Noise]),
        body: numbers.pick(&[GlassBody::Pane, GlassBody::Solid]),
        index: 1.0 + numbers.share(),
        tint: numbers.color(),
        roughness: share(numbers),
        seed: numbers.word(),
    };
    material(TemperedGlass::new(parameters), numbers);
}

fn wear(numbers: &mut Numbers<'_>) {
    let parameters = VariationsParameters {
        diffuse: numbers.color(),
        specular: numbers.color(),
        roughness: share(numbers),
        small_blemish_size: size(numbers),
        small_blemish_bump_strength: share(numbers),
        small_blemish_color_strength: share(numbers),
        dent_strength: share(numbers),
        dent_size: size(numbers),
        dent_cover: share(numbers),
        dent_detail: numbers.word() % 10,
        gloss_roughness: share(numbers),
        seed: numbers.word(),
    };
    material(Variations::new(parameters), numbers);
    let parameters = ScratchesParameters {
        scratch_size: size(numbers),
        scratch_length: share(numbers),
        scratch_width: 0.5 * share(numbers),
        scratch_strength: share(numbers),
        scratch_cover: 4.0 * share(numbers),
        scratch_direction: numbers.pair(),
        scratch_spread: share(numbers),
        specular: numbers.color(),
        roughness: share(numbers),
        seed: numbers.word(),
    };
    material(Scratches::new(parameters), numbers);
}

fn textures(numbers: &mut Numbers<'_>) {
    let (uv, p, footprint) = (numbers.pair(), numbers.vector(), Footprint::from_width(numbers.float()));
    let pixel = PixelEllipse::aligned(numbers.pair());
    if let Ok(wall) = Brick::new(size(numbers), size(numbers), size(numbers)) {
        for got in [wall.sample(uv), wall.filtered(uv, pixel)] {
            assert!((0.0..=1.0).contains(&got.brick) && (0.0..=1.0).contains(&got.height), "{got:?}");
            assert!(got.slope.is_finite(), "{got:?}");
        }
        let mut shares = 0.0;
        wall.facets(uv, pixel, |share, _, slope| shares += if slope.is_finite() { share } else { f32::NAN });
        assert!((shares - 1.0).abs() < 1e-4, "{shares}");
    }
    let [r_min, r_max] = [numbers.share(), numbers.share()];
    let stars = StarWallpaperParameters {
        points: numbers.word() % 1100,
        r_min,
        r_max,
        cells: size(numbers),
        chance: share(numbers),
        seed: 1,
    };
    if let Ok(stars) = StarWallpaper::new(stars) {
        let covered = stars.coverage(uv, footprint);
        assert!((0.0..=1.0).contains(&covered) && (0.0..=1.0).contains(&stars.mean()), "{covered}");
        let _ = stars.as_listed(uv);
    }
    if let Ok(marble) = Marble::new(Perlin::default(), size(numbers), 1) {
        let color = marble.color(p, footprint);
        assert!(color.min_element() >= 0.0 && color.max_element() <= 1.0, "{color}");
    }
    let _ = PerturbedTexture::default().filtered(p, uv, footprint);
    for density in [Gas::default().density(p), Gas::default().with_veins().clamped_density(p, footprint)] {
        assert!((0.0..=Gas::default().densest()).contains(&density), "{density}");
    }
    if let Ok(steam) = Steam::new(numbers.vector(), numbers.float(), numbers.float()) {
        assert!((0.0..=1.0).contains(&steam.share(p)));
        let _ = steam.interval(numbers.vector(), numbers.direction());
    }
    let [plateau, ridge, top, bottom] = [(); 4].map(|()| numbers.float());
    if let Ok(bevel) = Bevel::new(BevelParameters { plateau, ridge, top, bottom }) {
        let [height, slope] = bevel.profile(numbers.float());
        assert!(height.is_finite() && slope.is_finite(), "{height} {slope}");
        bevel.facets(numbers.float(), numbers.float(), |_, _| {});
    }
    let corners = numbers.list(6, Numbers::pair);
    if let Some(edge) = Edge::nearest(&corners, uv) {
        assert!(edge.distance >= 0.0 && (edge.away.length() - 1.0).abs() < 1e-5, "{edge:?}");
    }
    let step = if numbers.byte() < 220 { numbers.between(1e-2, 1e3) } else { numbers.float() };
    let (extinction, light) = (numbers.float(), numbers.color());
    let seen = march(
        p,
        numbers.vector(),
        [numbers.float(), numbers.float()],
        step,
        numbers.float(),
        |_| extinction,
        |_| light,
    );
    assert!((0.0..=1.0).contains(&seen.transmittance) && seen.light.is_finite(), "{seen:?}");
    assert!(seen.light.min_element() >= 0.0, "{seen:?}");
}

fn bumps(numbers: &mut Numbers<'_>) {
    let ndf = Ggx::new_clamped(numbers.float(), numbers.float());
    let spectrum =
        FbmSpectrum::new(2.0 + numbers.share(), numbers.between(0.1, 1.0), 1 + numbers.word() % 16);
    let spectrum = spectrum.unwrap_or_default();
    let Ok(field) = BumpField::new(GaussianFbm::<Vec3>::new(GaussianNoise::new(3), spectrum), size(numbers))
    else {
        return;
    };
    let frame = Frame { tangent: numbers.vector(), bitangent: numbers.vector(), normal: numbers.direction() };
    let seen = field.coordinates(numbers.vector(), &frame, Footprint::from_width(numbers.float()));
    assert!(
        seen.z.is_finite() && (0.0..=1.0).contains(&seen.variance) && (0.0..=1.0).contains(&seen.blend),
        "{seen:?}"
    );
    for rule in [LevelOfDetail::Exact, LevelOfDetail::Fractal] {
        let radiance = rule.radiance(&ndf, numbers.direction(), seen);
        assert!(radiance >= 0.0 && radiance.is_finite(), "{radiance}");
        assert!((rule.normal(&ndf, seen).length() - 1.0).abs() < 1e-5);
        material(Ok(BumpMapped { ndf, bumps: field, rule, color: Vec3::ONE }), numbers);
    }
    assert!(facet_coordinates(&ndf, seen).is_finite());
    let shaded = shade_facet(&ndf, &Frame::from_normal(numbers.direction()), numbers.direction());
    assert!(shaded >= 0.0 && shaded.is_finite(), "{shaded}");
    let _ = RemappedOctaves::new(Perlin::new(1), spectrum, numbers.word());
}

pub(crate) fn attack(numbers: &mut Numbers<'_>) {
    // Its fibers are measured at 16384 points.
    if numbers.is_one_in(1024) {
        return carpet(numbers);
    }
    match numbers.byte() % 5 {
        0 => paint(numbers),
        1 => glass(numbers),
        2 => wear(numbers),
        3 => textures(numbers),
        _ => bumps(numbers),
    }
}
