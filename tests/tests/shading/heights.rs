//! Heights of materials: their slopes match the facets, their means match the far view, and their
//! bounds hold.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::material::{BeveledTiles, BrickWall, MetallicRoughness, PolishedMarble, SeamPattern};
use asperity_shading::reflectance::Coat;
use asperity_shading::texture::{Bevel, BevelParameters};
use asperity_shading::{
    Carpet, CarpetParameters, Footprint, Marble, Material, MetallicPaint, MetallicPaintParameters, Scratches,
    ScratchesParameters, SurfacePoint, Variations, VariationsParameters,
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;

/// Materials with heights: name, width of the smallest detail, and maximum difference of close
/// slopes.
fn reliefs() -> Vec<(&'static str, f32, f32, Box<dyn Material>)> {
    let carpet = |seams_pattern, seam_crossover_strength| {
        let parameters =
            CarpetParameters { seams_pattern, seam_crossover_strength, ..CarpetParameters::default() };
        Box::new(Carpet::new(parameters).expect("a carpet"))
    };
    let bevel =
        Bevel::new(BevelParameters { plateau: 0.02, ridge: 0.1, top: 0.1, bottom: 0.8 }).expect("a ridge");
    let tiles = BeveledTiles { bevel, side: 0.05, color: Vec3::ONE, roughness: 0.5 };
    let dents = VariationsParameters { dent_strength: 0.2, dent_size: 0.02, ..Default::default() };
    let scratches = ScratchesParameters { scratch_cover: 2.5, ..Default::default() };
    vec![
        ("bricks", 0.005, 0.01, Box::new(BrickWall::default())),
        ("pits in place of mortar", 0.005, 0.01, Box::new(BrickWall { depth: -0.01, ..Default::default() })),
        ("tiles", 0.004, 0.02, Box::new(tiles)),
        // A step at a fiber's end that is not excluded, and the rounding of heights, which is a
        // hundredth of such a small rise.
        ("carpet", 2.4e-4, 0.03, carpet(SeamPattern::Lines, 0.0)),
        ("carpet with a grid", 2.4e-4, 0.03, carpet(SeamPattern::Grid, 0.0)),
        // A seam's depth of 0.4 · 0.02/π times the change of the fraction of leaning threads, ½ ·
        // (N + 1) · ½, over its size of 0.05: a component of ∇N has a root mean square of 3.08^½,
        // and was seen up to three times that.
        ("carpet with threads over its seams", 2.4e-4, 0.08, carpet(SeamPattern::Lines, 0.5)),
        ("plastic", 0.003, 0.01, Box::new(Variations::new(dents).expect("plastic"))),
        ("scratches", 2.5e-4, 0.01, Box::new(Scratches::new(scratches).expect("scratches"))),
    ]
}

fn point(uv: Vec2, width: f32) -> SurfacePoint {
    SurfacePoint::new(uv.extend(0.0), Vec3::Z, Footprint::from_width(width)).with_uv(uv, [Vec3::X, Vec3::Y])
}

#[test]
fn facets_have_the_slopes_of_the_height() {
    for (name, detail, tolerance, material) in reliefs() {
        let mut random = Random(5);
        let (mut worst, mut kept, mut steep) = (0.0_f32, 0, 0.0_f32);
        for _ in 0..4000 {
            let uv = Vec2::new(random.uniform() as f32, random.uniform() as f32) * 0.2;
            let middle = material.height(&point(uv, 0.0));
            // The remainders of rounding and of the step are a few thousandths each.
            let sides = [Vec2::X, Vec2::Y].map(|axis| {
                let ends = [1.0, -1.0].map(|sign| uv + sign * 0.004 * detail * axis);
                let rise =
                    ends.map(|end| (material.height(&point(end, 0.0)) - middle) / (end - uv).dot(axis));
                [0.5 * (rise[0] + rise[1]), (rise[0] - rise[1]).abs()]
            });
            let slope = Vec2::from(sides.map(|side| side[0]));
            // Fibers end in steps, and tiles and seams have creases.
            if sides.iter().any(|side| side[1] > 0.03) {
                continue;
            }
            // From below, because from above facets steeper than 45° are turned toward the viewer.
            let seen = MetallicRoughness::of(&material.bsdf(&point(uv, 0.0), Vec3::NEG_Z)).unwrap();
            worst = worst.max((seen.slopes.mean + slope).abs().max_element());
            steep = steep.max(slope.length());
            kept += 1;
        }
        println!("{name}: {kept} of 4000, {worst} of slopes up to {steep}");
        assert!(kept > 3600 && steep > 0.1, "{name}: {kept} of 4000, slopes up to {steep}");
        assert!(worst < tolerance, "{name}: {worst}");
    }
}

#[test]
fn wide_pixel_has_the_mean_height_and_bounds_hold() {
    const POINTS: u16 = 20_000;
    for (name, detail, _, material) in reliefs() {
        let [low, high] = material.height_range().unwrap();
        let heights = |width: f32| {
            let mut random = Random(9);
            let (mut sum, mut squares) = (0.0, 0.0);
            for _ in 0..POINTS {
                let uv = Vec2::new(random.uniform() as f32, random.uniform() as f32) * 4.0;
                let height = material.height(&point(uv, width));
                let rounding = 1e-6 * (high - low);
                assert!(
                    (low - rounding..=high + rounding).contains(&height),
                    "{name}, {width}: {height} in {low} to {high}"
                );
                sum += f64::from(height) / f64::from(POINTS);
                squares += f64::from(height).powi(2) / f64::from(POINTS);
            }
            (sum, (squares - sum * sum).max(0.0) / f64::from(POINTS))
        };
        let (near, variance) = heights(0.0);
        assert!(variance > 0.0, "{name}");
        for width in [0.3 * detail, detail, 10.0 * detail, 0.05, 1.0, 1e4] {
            let (mean, scatter) = heights(width);
            // Five standard errors of independent points. For fibers the mean is measured to 1 %,
            // here 1.2e-7.
            let tolerance = 5.0 * (variance + scatter).sqrt() + 2e-7;
            assert_abs_diff_eq!(mean, near, epsilon = tolerance, "{name}, {width}");
        }
    }
}

#[test]
fn flat_materials_have_no_heights() {
    let marble = PolishedMarble { marble: Marble::default(), tint: Vec3::ONE, polish: 0.1 };
    let paint = MetallicPaint::new(MetallicPaintParameters::default()).unwrap();
    let flat: [(&str, Box<dyn Material>); 3] = [
        ("chrome", Box::new(Coat::conductor(Vec3::ONE))),
        ("marble", Box::new(marble)),
        ("paint, whose peel is its coat's", Box::new(paint)),
    ];
    for (name, material) in flat {
        assert_eq!(material.height_range(), None, "{name}");
        assert_eq!(material.height(&point(Vec2::new(0.3, 0.1), 0.0)), 0.0, "{name}");
    }
}
