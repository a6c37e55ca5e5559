//! Environments from images and slopes from normal maps: any texels are accepted or rejected, and
//! every lookup is finite.

use asperity_shading::bump::Facet;
use asperity_shading::environment::{
    LatitudeLongitude, PrefilteredMap, light_samples, prefiltered_radiance, split_sum,
};
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::level_of_detail::ResolvedBumps;
use asperity_shading::{
    Beckmann, Brdf, Bsdf, Environment, EnvironmentMap, Footprint, Frame, Irradiance, Lambert, PixelEllipse,
    SlopePyramid,
};

use crate::numbers::Numbers;

fn light(color: Vec3) {
    assert!(color.is_finite() && color.min_element() >= 0.0, "{color}");
}

/// Checks the invariants of every environment.
fn environment(environment: &dyn Environment, numbers: &mut Numbers<'_>) {
    let sampled = environment.sample(numbers.pair());
    assert!((sampled.length() - 1.0).abs() < 1e-4, "{sampled}");
    for direction in [sampled, numbers.direction(), numbers.vector()] {
        light(environment.radiance(direction));
        let density = environment.pdf(direction);
        assert!(density >= 0.0 && density.is_finite(), "{density} towards {direction}");
    }
}

fn texel(numbers: &mut Numbers<'_>) -> Vec3 {
    match numbers.byte() {
        0..=149 => 4.0 * numbers.color(),
        150..=199 => Vec3::ZERO,
        200..=239 => Vec3::new(1.0, 0.5, 0.3) * numbers.between(1e-38, 1e30),
        _ => numbers.vector(),
    }
}

fn images(numbers: &mut Numbers<'_>) {
    let [width, height] = [numbers.count(6), numbers.count(5)];
    let texels: Vec<Vec3> = (0..width * height).map(|_| texel(numbers)).collect();
    let made = LatitudeLongitude::new(width, height, &texels[..]);
    if let Ok(image) = &made {
        environment(image, numbers);
    }
    let map = EnvironmentMap::new(width, height, texels.clone());
    assert_eq!(map.is_ok(), made.is_ok());
    let Ok(map) = map else { return };
    let sky = map.view();
    assert!(sky.total() >= 0.0 && sky.total().is_finite());
    environment(&sky, numbers);
    light(Irradiance::new(&sky, numbers.word() % 5).at(numbers.direction()));
    light(prefiltered_radiance(&sky, numbers.float(), numbers.direction(), numbers.word() % 8));
    let frame = Frame::from_normal(numbers.direction());
    let chalk = Lambert::new(Vec3::splat(0.8)).expect("a color");
    let (wo, points) = (numbers.direction(), (numbers.float(), numbers.pair(), numbers.pair()));
    let bsdf = Bsdf::new(frame, wo).with([Facet::FLAT], [(&chalk as &dyn Brdf).into()]);
    for sample in light_samples(&bsdf, &sky, wo, points) {
        light(sample.radiance);
    }
    if let Ok(stack) = PrefilteredMap::new(&sky, &[(0.0, 3), (numbers.share(), 2)], 4) {
        light(stack.radiance(numbers.direction(), numbers.float()));
    }
}

fn normal_maps(numbers: &mut Numbers<'_>) {
    let [width, height] = [numbers.count(6), numbers.count(5)];
    let slope = |numbers: &mut Numbers<'_>| match numbers.byte() {
        0..=199 => 8.0 * Vec2::new(numbers.share() - 0.5, numbers.share() - 0.5),
        _ => numbers.pair(),
    };
    let slopes: Vec<Vec2> = (0..width * height).map(|_| slope(numbers)).collect();
    let normals: Vec<Vec3> = (0..width * height).map(|_| numbers.direction()).collect();
    let made =
        [SlopePyramid::<3>::new(width, height, slopes), SlopePyramid::from_normals(width, height, &normals)];
    for map in made.into_iter().flatten() {
        let (map, uv) = (map.view(), numbers.pair());
        assert!(map.slope(uv).is_finite(), "{uv}");
        let fine = Beckmann::isotropic(numbers.between(1e-6, 1e6)).expect("in range");
        let noise = ResolvedBumps { z: numbers.pair(), variance: numbers.float(), blend: numbers.share() };
        let pixel = PixelEllipse::from_derivatives(numbers.vector(), numbers.vector());
        for lobes in [
            map.whole(),
            map.level(uv, numbers.word() % 9),
            map.sample(uv, Footprint::from_width(numbers.float())),
            map.sample_along(uv, &pixel, numbers.word() % 20),
        ] {
            let weights: f32 = lobes.lobes().iter().map(|lobe| lobe.weight).sum();
            assert!((weights - 1.0).abs() < 1e-4, "{lobes:?} at {uv}");
            let density = lobes.density(fine, noise, numbers.direction());
            assert!(density >= 0.0 && density.is_finite(), "{density}");
            let n = lobes.moments().normal();
            assert!((n.length() - 1.0).abs() < 1e-5 && n.z >= 0.0, "{n}");
            assert!(lobes.moments().mean_normal().is_finite());
        }
    }
}

pub(crate) fn attack(numbers: &mut Numbers<'_>) {
    match numbers.byte() % 3 {
        0 => images(numbers),
        1 => normal_maps(numbers),
        _ => {
            environment(&numbers.vector(), numbers);
            let [scale, bias] = split_sum(numbers.float(), numbers.float(), numbers.word() % 9);
            assert!(scale >= 0.0 && bias >= 0.0 && scale + bias <= 1.0 + 1e-4, "{scale} {bias}");
            let (width, height) = (numbers.count(9), numbers.count(9));
            let towards =
                LatitudeLongitude::direction(width, height, numbers.word() as usize, numbers.count(20));
            assert!((towards.length() - 1.0).abs() < 1e-4, "{towards}");
        }
    }
}
