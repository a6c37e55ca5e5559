//! Every parameter of the materials: its values, other non-default parameters, and the view.

use asperity_render::light::{environments::Studio, lamps::Lamp};
use asperity_render::{geometry::ray::Ray, image::tone::hex, materials::pattern::grid, scenes::Form};
use asperity_shading::material::{
    Elimination, FibersParameters, GlassBody, GlassWaves, PaintFlakes, SeamPattern,
};
use asperity_shading::{
    CarpetParameters, Environment, MetallicPaintParameters, ScratchesParameters, TemperedGlassParameters,
    VariationsParameters,
};
use glam::{Vec2, Vec3};

use crate::figures::nilsson::sliders::strip::{Strip, View};

/// Strips of fields, each with its view, the other parameters, its name and its values.
macro_rules! strips {
    ($($view:ident $base:ident $field:ident: $values:expr;)*) => {
        vec![$({
            let with = |$field| {
                let mut parameters = $base;
                parameters.$field = $field;
                parameters
            };
            let options = $values.into_iter().map(with).collect();
            Strip { field: stringify!($field), options, view: $view.clone() }
        }),*]
    };
}

pub(super) fn carpet() -> Vec<Strip<CarpetParameters>> {
    let base = CarpetParameters::default();
    let plain = CarpetParameters { seams_pattern: SeamPattern::None, ..base };
    let shining = CarpetParameters { specular_thread_strength: 0.6, ..plain };
    let crossing = CarpetParameters { seams_amplitude: 0.9, ..base };
    let crossed = CarpetParameters {
        seam_crossover_strength: 1.0,
        dark_area_strength: 0.0,
        diffuse_thread_strength: 0.0,
        ..crossing
    };
    let bald = CarpetParameters { fiber_strength: 0.0, fiber_bump_strength: 0.0, ..plain };
    let glossy = CarpetParameters { specular_thread_strength: 0.6, ..bald };
    let threads = View::patch(0.045).exposed(2.6);
    let field = View::patch(0.3).exposed(2.2);
    let soft = CarpetParameters { fake_rim_light: 0.6, ..plain };
    let near = View::patch(0.01).exposed(3.0);
    let seamed = View::patch(0.14).exposed(2.2);
    let wide = View::patch(1.2).exposed(2.2);
    let ball = View::ball(0.3, 0.32).exposed(2.2);
    let even = CarpetParameters {
        diffuse_thread_bump_strength: 0.0,
        diffuse_thread_strength: 0.0,
        specular_thread_strength: 0.0,
        ..plain
    };
    let matte = CarpetParameters {
        fake_rim_light: 0.0,
        diffuse_thread_bump_strength: 0.0,
        dark_area_strength: 0.0,
        ..plain
    };
    let rim = ball.clone().exposed(1.9);
    let moon = ball.lit_from_the_eye();
    let gray = Vec3::splat;
    let fibers = |fiber_length| FibersParameters { fiber_length, ..Default::default() };
    strips! {
        seamed base diffuse: [Vec3::new(0.02, 0.02, 0.03), base.diffuse, Vec3::new(0.25, 0.2, 0.13),
            Vec3::new(0.2, 0.05, 0.04), Vec3::new(0.04, 0.08, 0.2)];
        seamed plain specular: [0.0, 0.05, 0.1, 0.2, 0.4].map(gray);
        threads bald diffuse_thread_size: [0.002, 0.004, 0.006, 0.012, 0.03];
        seamed plain diffuse_thread_strength: [0.0, 0.06, 0.12, 0.25, 0.5];
        seamed plain diffuse_thread_bump_strength: [0.0, 0.06, 0.12, 0.3, 0.7];
        threads glossy specular_thread_size: [0.002, 0.004, 0.008, 0.016, 0.04];
        seamed plain specular_thread_strength: [0.0, 0.12, 0.3, 0.6, 1.0];
        wide plain dark_area_size: [0.05, 0.1, 0.15, 0.3, 0.6];
        wide plain dark_area_strength: [0.0, 0.25, 0.5, 0.75, 1.0];
        seamed base seams_propagation: [Vec2::X, Vec2::new(2.0, 1.0), Vec2::ONE, Vec2::new(1.0, 2.0),
            Vec2::Y];
        seamed base seams_pattern: [SeamPattern::None, SeamPattern::Lines, SeamPattern::Grid];
        seamed base seam_distance: [0.007, 0.012, 0.02, 0.035, 0.07];
        seamed base seams_amplitude: [0.0, 0.15, 0.3, 0.6, 1.0];
        seamed base seams_bump_strength: [0.0, 0.2, 0.4, 0.7, 1.0];
        field crossed seam_crossover_size: [0.01, 0.025, 0.05, 0.1, 0.25];
        seamed crossing seam_crossover_strength: [0.0, 0.25, 0.5, 0.75, 1.0];
        near even fiber_strength: [0.0, 0.25, 0.5, 0.8, 1.0];
        near even fiber_bump_strength: [0.0, 0.15, 0.3, 0.6, 1.0];
        near even fibers: [0.002, 0.003, 0.004, 0.006, 0.01].map(fibers);
        moon matte roughness: [0.0, 0.25, 0.5, 0.8, 1.0];
        rim plain fake_rim_light: [0.0, 0.15, 0.4, 0.7, 1.0];
        rim soft fake_rim_light_width: [0.0, 0.2, 0.4, 0.7, 1.0];
        rim soft fake_rim_light_color: [Vec3::splat(0.4), Vec3::ONE, hex(0xff_d6a8), hex(0xb9_d0ff),
            Vec3::new(1.0, 0.3, 0.2)];
        seamed shining specular_roughness: [0.1, 0.2, 0.45, 0.7, 1.0];
        wide base seed: [1, 2, 3, 4, 5];
    }
}

pub(super) fn paint() -> Vec<Strip<MetallicPaintParameters>> {
    let base = MetallicPaintParameters::default();
    let studio = |ray: &Ray| Studio::new(1.0).radiance(ray.direction);
    let ball = View { mirrored: studio, ..View::ball(0.12, 0.126) }.lit(0.7);
    let peel = View { mirrored: studio, ..View::ball(0.16, 0.13) }.lit(0.15).exposed(2.5);
    let bead = View { mirrored: studio, ..View::ball(0.02, 0.013) }.lit(0.5);
    let sparkling =
        MetallicPaintParameters { flake_sparkle_boost: 0.8, flake_sparkle_elimination: 0.0, ..base };
    // Large enough to be visible, under one lamp.
    let large = MetallicPaintParameters { flake_sparkle_pixel_size: 3.0, ..sparkling };
    // Smooth flakes shine only near the lamp's reflection. Tilted flakes shine at a distance
    // proportional to their tilt.
    let polished = MetallicPaintParameters { flake_roughness: 0.12, ..sparkling };
    let moon = View::ball(0.02, 0.0215).lit_from_the_eye().lit(0.3);
    let tilted = View::ball(0.016, 0.008).lit_from_the_eye().lit(0.5);
    let sparse = MetallicPaintParameters { flake_sparkle_elimination: 0.9, ..sparkling };
    let counted = |spacing| PaintFlakes::Counted { spacing, bin: 0.12 };
    let smart = |unit| Elimination::Adaptive { unit };
    let quiet = MetallicPaintParameters {
        flake_sparkle_elimination: 1.0,
        smart_flake_sparkle: Elimination::Fixed,
        ..base
    };
    let passive = MetallicPaintParameters { passive_flake_strength: 1.0, ..quiet };
    let with_orange_peel_size = MetallicPaintParameters { orange_peel_strength: 0.02, ..base };
    let with_passive_flake_strength = MetallicPaintParameters { passive_flake_size: 0.01, ..quiet };
    strips! {
        ball base specular: [Vec3::splat(0.5), base.specular, Vec3::new(0.6, 0.1, 0.06),
            Vec3::new(0.12, 0.4, 0.2), Vec3::new(0.6, 0.4, 0.1)];
        peel base orange_peel_strength: [0.0, 0.01, 0.02, 0.04, 0.1];
        peel with_orange_peel_size orange_peel_size: [0.004, 0.006, 0.012, 0.024, 0.048];
        bead sparkling flake_sparkle_pixel_size: [1.0, 1.5, 2.0, 3.0, 4.0];
        bead sparkling flake_sparkle_physical_size: [0.0005, 0.0007, 0.001, 0.0015, 0.002];
        moon polished flake_sparkle_variation: [0.05, 0.2, 0.5, 0.75, 1.0];
        bead sparkling flake_sparkle_boost: [0.0, 0.15, 0.3, 0.6, 1.0];
        bead sparkling flake_sparkle_boost_target: [Vec3::ONE, Vec3::new(1.0, 0.5, 0.1),
            Vec3::new(1.0, 0.1, 0.05), Vec3::new(0.1, 1.0, 0.2), Vec3::new(0.05, 0.15, 1.0)];
        bead sparkling flake_sparkle_elimination: [0.0, 0.4, 0.6, 0.8, 0.95];
        bead sparse smart_flake_sparkle: [Elimination::Fixed, smart(0.002), smart(0.0008),
            smart(0.0006), smart(0.0004)];
        bead passive passive_flake_size: [0.004, 0.006, 0.01, 0.016, 0.03];
        bead with_passive_flake_strength passive_flake_strength: [0.0, 0.3, 0.5, 0.75, 1.0];
        bead passive passive_flake_detail: [1, 2, 3, 4, 5];
        ball base flake_roughness: [0.1, 0.2, 0.32, 0.5, 0.8];
        bead base flakes: [PaintFlakes::Sparkling, counted(2e-4), counted(1e-4), counted(4e-5)];
        ball base pigment: [Vec3::ZERO, base.pigment, Vec3::new(0.10, 0.01, 0.008),
            Vec3::new(0.02, 0.1, 0.03), Vec3::splat(0.3)];
        ball base coat_index: [1.0, 1.3, 1.5, 2.0, 3.0];
        ball base coat_roughness: [0.0, 0.05, 0.1, 0.2, 0.4];
        tilted large seed: [1, 2, 3, 4, 5];
    }
}

/// Bright sky between tilted bars 0.06 apart on a plane at distance 1.
fn lattice(ray: &Ray) -> Vec3 {
    let w = ray.direction;
    if w.z <= 0.0 {
        // Directly behind the pane.
        return hex(0x4a_4642);
    }
    let place = w.truncate() / w.z.max(1e-3) / 0.06;
    let bars = grid(Vec2::from_angle(0.45).rotate(place) + 0.5, 0.16, 0.03);
    // So bright that four percent of it fills the range.
    10.0 * hex(0xb9_d0ec).lerp(hex(0x24_2830), bars)
}

pub(super) fn glass() -> Vec<Strip<TemperedGlassParameters>> {
    let base = TemperedGlassParameters { tint: Vec3::ZERO, ..Default::default() };
    let strong = TemperedGlassParameters { wave_amplitude: 2e-4, ..base };
    let noise = TemperedGlassParameters {
        waves: GlassWaves::Noise,
        wave_frequency: 6.0,
        wave_amplitude: 2e-4,
        ..base
    };
    let form = Form::Patch { height: 1.0, distance: 4.0 };
    let view = View { form, lamps: Vec::new(), mirrored: lattice, exposure: 1.0 };
    // A lamp reflected in the pane, which roughness blurs.
    let lit = View { lamps: vec![Lamp::at(90.0, 86.0, Vec3::splat(0.6))], ..view.clone() };
    let directions =
        [Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y, Vec3::new(-1.0, 2.0, 0.0), Vec3::new(0.0, 1.0, 1.0)];
    let with_waves = TemperedGlassParameters { waves: GlassWaves::Sine, ..noise };
    strips! {
        view base wave_frequency: [5.0, 10.0, 20.0, 30.0, 45.0];
        view base wave_amplitude: [0.0, 5e-5, 1e-4, 2e-4, 4e-4];
        view strong wave_propagation_vector: directions;
        view with_waves waves: [GlassWaves::Sine, GlassWaves::Noise];
        view base body: [GlassBody::Pane, GlassBody::Solid];
        view base index: [1.2, 1.52, 1.8, 2.4, 4.0];
        view base tint: [Vec3::ZERO, Vec3::splat(0.3), Vec3::ONE, Vec3::new(0.3, 0.8, 0.6)];
        lit base roughness: [0.0, 0.05, 0.1, 0.2, 0.4];
        view noise seed: [1, 2, 3, 4, 5];
    }
}

pub(super) fn variations() -> Vec<Strip<VariationsParameters>> {
    let base = VariationsParameters::default();
    let near = View::glossy(0.04).lit(0.45);
    let wide = View::glossy(0.8).lit(0.45);
    let ball = View::ball(0.1, 0.105).lit_from_the_eye().exposed(1.3);
    let unblemished =
        VariationsParameters { small_blemish_bump_strength: 0.0, small_blemish_color_strength: 0.0, ..base };
    let dented = VariationsParameters { dent_strength: 0.1, ..unblemished };
    let matte = VariationsParameters { specular: Vec3::ZERO, dent_strength: 0.0, ..unblemished };
    let gray = Vec3::splat;
    strips! {
        near base diffuse: [Vec3::splat(0.02), base.diffuse, Vec3::new(0.5, 0.06, 0.04),
            Vec3::new(0.05, 0.2, 0.4), Vec3::splat(0.8)];
        near base specular: [0.0, 0.1, 0.2, 0.4, 0.8].map(gray);
        ball matte roughness: [0.0, 0.15, 0.3, 0.6, 1.0];
        near base small_blemish_size: [0.001, 0.003, 0.006, 0.012, 0.024];
        near base small_blemish_bump_strength: [0.0, 0.03, 0.06, 0.12, 0.3];
        near base small_blemish_color_strength: [0.0, 0.2, 0.4, 0.7, 1.0];
        wide base dent_strength: [0.0, 0.05, 0.1, 0.2, 0.4];
        wide dented dent_size: [0.03, 0.06, 0.1, 0.2, 0.4];
        wide dented dent_cover: [0.0, 0.1, 0.3, 0.6, 1.0];
        wide dented dent_detail: [1, 2, 3, 5, 8];
        near base gloss_roughness: [0.1, 0.17, 0.25, 0.4, 0.7];
        wide base seed: [1, 2, 3, 4, 5];
    }
}

pub(super) fn scratches() -> Vec<Strip<ScratchesParameters>> {
    let base = ScratchesParameters {
        scratch_width: 0.02,
        scratch_cover: 4.0,
        specular: hex(0xc8_ccd2),
        roughness: 0.2,
        ..Default::default()
    };
    // Half vectors slightly off the normal.
    let lamp = |x, y, color| {
        let h = Vec3::new(x, y, 1.0).normalize();
        Lamp { direction: 2.0 * h.z * h - Vec3::Z, color }
    };
    let view = |height| View {
        lamps: vec![lamp(0.22, 0.26, hex(0xff_f2e2) * 0.5), lamp(-0.3, 0.1, hex(0xb9_d0ff) * 0.25)],
        ..View::patch(height)
    };
    let (view, near) = (view(0.11), view(0.05));
    let combed = ScratchesParameters { scratch_spread: 0.15, ..base };
    strips! {
        view base scratch_size: [0.02, 0.035, 0.05, 0.1, 0.2];
        view base scratch_length: [0.1, 0.25, 0.5, 0.75, 1.0];
        view base scratch_width: [0.004, 0.01, 0.02, 0.05, 0.1];
        near base scratch_strength: [0.0, 0.1, 0.25, 0.5, 1.0];
        view base scratch_cover: [0.0, 0.5, 1.0, 2.0, 4.0];
        view combed scratch_direction: [Vec2::X, Vec2::new(2.0, 1.0), Vec2::ONE, Vec2::Y,
            Vec2::new(-1.0, 1.0)];
        view base scratch_spread: [0.0, 0.1, 0.25, 0.5, 1.0];
        view base specular: [Vec3::splat(0.3), Vec3::splat(0.7), Vec3::new(0.95, 0.64, 0.54),
            Vec3::new(1.0, 0.77, 0.34), hex(0x8a_a0c0)];
        view base roughness: [0.1, 0.2, 0.3, 0.45, 0.7];
        view base seed: [1, 2, 3, 4, 5];
    }
}

pub(super) fn fibers() -> Vec<Strip<FibersParameters>> {
    let base = FibersParameters::default();
    let view = View::patch(0.012).exposed(1.3);
    let combed = FibersParameters { fiber_length: 0.008, fiber_width: 0.06, fiber_spread: 0.0, ..base };
    strips! {
        view base fiber_length: [0.002, 0.003, 0.004, 0.006, 0.01];
        view base fiber_width: [0.07, 0.09, 0.12, 0.2, 0.3];
        view combed fiber_bend: [0.0, 0.08, 0.15, 0.22, 0.3];
        view base fiber_direction: [Vec2::X, Vec2::ONE, Vec2::Y, Vec2::new(-1.0, 1.0), Vec2::NEG_X];
        view base fiber_spread: [0.0, 0.15, 0.3, 0.6, 1.0];
        view base fiber_contrast: [0.0, 0.3, 0.6, 0.8, 1.0];
        view base seed: [1, 2, 3, 4, 5];
    }
}
