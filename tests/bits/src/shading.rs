//! Reflectances, materials, textures and environments at many points.

use alloc::{boxed::Box, vec::Vec};

use asperity_shading::glam::Vec3;
use asperity_shading::ndf_sampling::{Beckmann, Ggx};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::reflectance::{BsdfSample, OrenNayar, OrenNayarVariant, WardBrdf, WardNormalization};
use asperity_shading::texture::{Gas, StarWallpaper};
use asperity_shading::{
    Brdf, Brick, BumpField, Carpet, Conductor, CookTorrance, Dielectric, EnergyPreservingOrenNayar,
    Environment, EnvironmentMap, Footprint, Frame, Irradiance, Lambert, LevelOfDetail, Marble, Material,
    MetallicPaint, OpenPbr, OpenPbrParameters, Phong, Scratches, SlopePyramid, StandardMaterial,
    StandardMaterialParameters, SurfacePoint, TemperedGlass, TorranceSparrow, Variations, far_field,
};

use crate::digest::{Report, direction, plane, space, square, unit};

const POINTS: u32 = 200;

fn reflectances(report: &mut Report) -> Option<()> {
    report.group("shading: reflectances");
    let albedo = Vec3::new(0.8, 0.5, 0.1);
    let (ggx, beckmann) = (Ggx::new(0.2, 0.4).ok()?, Beckmann::new(0.2, 0.4).ok()?);
    let (glass, gold) = (Dielectric::new(1.5).ok()?, Conductor::new(0.2, 3.0).ok()?);
    let varnished = StandardMaterialParameters {
        base_color: albedo,
        metallic: 0.4,
        roughness: 0.5,
        clearcoat: 0.7,
        clearcoat_roughness: 0.3,
        sheen_color: Vec3::splat(0.2),
        sheen_roughness: 0.5,
        transmission: 0.3,
        anisotropy: 0.5,
        anisotropy_rotation: 0.7,
        ..Default::default()
    };
    let wet = OpenPbrParameters {
        base_metalness: 0.3,
        coat_weight: 0.8,
        coat_color: albedo,
        coat_roughness: 0.2,
        fuzz_weight: 0.4,
        ..Default::default()
    };
    let all: [(&str, Box<dyn Brdf>); 10] = [
        ("Lambert", Box::new(Lambert::new(albedo).ok()?)),
        ("EnergyPreservingOrenNayar", Box::new(EnergyPreservingOrenNayar::new(albedo, 0.6).ok()?)),
        ("OrenNayar", Box::new(OrenNayar::new(albedo, 0.6, OrenNayarVariant::Full).ok()?)),
        ("CookTorrance, GGX", Box::new(CookTorrance::new(ggx, glass))),
        ("CookTorrance, Beckmann", Box::new(CookTorrance::new(beckmann, gold))),
        ("TorranceSparrow", Box::new(TorranceSparrow::new(beckmann, glass))),
        ("Phong", Box::new(Phong::new(albedo, 30.0).ok()?)),
        ("StandardMaterial", Box::new(StandardMaterial::new(varnished).ok()?)),
        ("OpenPbr", Box::new(OpenPbr::new(wet).ok()?)),
        ("WardReflection", Box::new(WardBrdf::new(albedo, 0.2, 0.4, WardNormalization::Bounded).ok()?)),
    ];
    for (name, brdf) in all {
        report.row(name, |bits| {
            for i in 0..POINTS {
                let (wi, wo) = (direction(i), direction(i + POINTS));
                let sample = brdf.sample(wo, unit(i, 4), square(i));
                bits.push([brdf.eval(wo, wi), sample.map_or(Vec3::ZERO, |sample| sample.wi)]);
                bits.push(brdf.pdf(wo, wi));
            }
        });
    }
    Some(())
}

fn materials(report: &mut Report) -> Option<()> {
    report.group("shading: materials and bumps");
    let all: [(&str, Box<dyn Material>); 5] = [
        ("Carpet", Box::new(Carpet::new(Default::default()).ok()?)),
        ("MetallicPaint", Box::new(MetallicPaint::new(Default::default()).ok()?)),
        ("TemperedGlass", Box::new(TemperedGlass::new(Default::default()).ok()?)),
        ("Scratches", Box::new(Scratches::new(Default::default()).ok()?)),
        ("Variations", Box::new(Variations::new(Default::default()).ok()?)),
    ];
    for (name, material) in all {
        report.row(name, |bits| {
            for i in 0..POINTS {
                let footprint = Footprint::from_width(unit(i, 4) * [1e-4, 1e-3, 0.05, 1.0][i as usize % 4]);
                let point = SurfacePoint::new(space(i), direction(i), footprint);
                let point = point.with_uv(plane(i), point.tangents);
                let (wi, wo) = (direction(i + POINTS), direction(i + 2 * POINTS));
                let bsdf = material.bsdf(&point, wo);
                let direction = |sample: Option<BsdfSample>| sample.map_or(Vec3::ZERO, |sample| sample.wi);
                let sample = bsdf.sample(wo, unit(i, 4), square(i));
                bits.push([bsdf.eval_cos(wo, wi), bsdf.emitted(), direction(sample)]);
                bits.push(bsdf.pdf(wo, wi));
                bits.push(bsdf.specular_samples(wo, square(i)).map(direction));
            }
        });
    }
    let ggx = Ggx::new(0.2, 0.4).ok()?;
    let bumps =
        BumpField::new(GaussianFbm::<Vec3>::new(GaussianNoise::new(1), FbmSpectrum::default()), 7.0).ok()?;
    report.row("BumpField", |bits| {
        for i in 0..POINTS {
            let seen = bumps.coordinates(
                space(i),
                &Frame::from_normal(direction(i + POINTS)),
                Footprint::from_width(unit(i, 4)),
            );
            bits.push(LevelOfDetail::Exact.radiance(&ggx, direction(i), seen));
            bits.push(LevelOfDetail::Fractal.radiance(&ggx, direction(i), seen));
            bits.push(far_field(&ggx, direction(i)));
        }
    });
    Some(())
}

fn images(report: &mut Report) -> Option<()> {
    report.group("shading: textures, environments, pyramids");
    let (wall, marble, gas, stars) =
        (Brick::default(), Marble::default(), Gas::default(), StarWallpaper::default());
    report.row("textures", |bits| {
        for i in 0..POINTS {
            let footprint = Footprint::from_width(0.1 * unit(i, 4));
            let mean = wall.filtered(plane(i), footprint.into());
            bits.push([mean.brick, mean.height, stars.coverage(plane(i), footprint), gas.density(space(i))]);
            bits.push(marble.color(space(i), footprint));
        }
    });
    let sky = |w: Vec3| Vec3::splat(0.2 + w.z.max(0.0)) + Vec3::X * (w.x + 1.0);
    let map = EnvironmentMap::from_fn(32, 16, sky).ok()?;
    let irradiance = Irradiance::new(&map, 16);
    report.row("environment", |bits| {
        for i in 0..POINTS {
            bits.push([map.radiance(direction(i)), map.sample(square(i)), irradiance.at(direction(i))]);
            bits.push(map.pdf(direction(i)));
        }
    });
    let normals: Vec<Vec3> = (0..256).map(direction).collect();
    let pyramid: SlopePyramid<2> = SlopePyramid::from_normals(16, 16, &normals).ok()?;
    report.row("slope pyramid", |bits| {
        for i in 0..POINTS {
            let lobes = pyramid.view().sample(square(i), Footprint::from_width(unit(i, 4)));
            bits.push(lobes.moments().normal());
        }
    });
    Some(())
}

pub(crate) fn tell(report: &mut Report) {
    for part in [reflectances, materials, images] {
        if part(report).is_none() {
            report.row("invalid material", |_| ());
        }
    }
}
