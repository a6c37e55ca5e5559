//! Zooming in on materials: what is seen of a patch keeps its mean radiance, and no pixel pops.

use asperity_render::shaded::{Patch, Sky, Subject, fractal_bumps, largest_pop, materials};
use asperity_shading::glam::Vec3;

/// From straight above, and at 60°.
fn views() -> [Vec3; 2] {
    [Vec3::Z, Vec3::new(0.0, -0.75_f32.sqrt(), 0.5)]
}

/// A lamp on the other side, and one aside.
fn skies() -> [Sky; 2] {
    [Vec3::new(-0.34, 0.42, 0.84), Vec3::new(0.5, 0.5, 0.6)].map(Sky::about)
}

/// The share by which the mean may change, and the pixels along a side at ×100, ×10³ and ×10⁴ that make its standard error less than
/// a third of that.
fn demand(name: &str) -> (f64, [u32; 3]) {
    match name {
        "bumps" => (0.02, [240, 330, 330]),
        "flakes" => (0.02, [40, 140, 260]),
        "passive flakes" => (0.02, [40; 3]),
        "carpet" | "carpet, grid" => (0.04, [110; 3]),
        "paint" => (0.05, [40, 64, 110]),
        "orange peel" | "glass" => (0.05, [80; 3]),
        "glass, noise" => (0.02, [330; 3]),
        _ => (0.05, [40; 3]),
    }
}

/// The largest change of the mean from ×1 and the largest standard error, over views, lamps and zooms, relative to the mean.
///
/// The gallery has the same at 256 samples a pixel; here details that are finer than a pixel count by the number of pixels.
fn worst(subject: &Subject, pixels: [u32; 3]) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    let zooms =
        [(1.0, 16, 4), (10.0, 16, 4), (100.0, pixels[0], 1), (1e3, pixels[1], 1), (1e4, pixels[2], 1)];
    for view in views() {
        let means = zooms
            .map(|(zoom, pixels, samples)| Patch { pixels, samples, view }.means(subject, &skies(), zoom));
        for sky in 0..skies().len() {
            let first = means[0][sky].value;
            for mean in means.map(|skies| skies[sky]) {
                worst[0] = worst[0].max((mean.value / first - 1.0).abs());
                worst[1] = worst[1].max(mean.error / first);
            }
        }
    }
    worst
}

#[test]
#[ignore = "slow: weekly"]
fn materials_keep_their_mean_radiance_from_afar_to_very_near() {
    for subject in materials() {
        let (bound, pixels) = demand(subject.name);
        let [change, error] = worst(&subject, pixels);
        println!("{}: {change:.4}, standard errors up to {error:.4}", subject.name);
        assert!(error < bound / 3.0, "{}: an error of {error} shows nothing", subject.name);
        // Measured: 2.5 % of scratches, 2 % of carpets, 1.8 % of noisy glass, 1.4 % of flakes and less of the others, with errors of
        // up to 1.3 %. Of the glass 1.3 % is left with an error of 0.1 %: half by its facets, half by the noise, whose slopes are no Gaussians.
        assert!(change < bound, "{}: {change}", subject.name);
    }
    // The paper's rule fails.
    let [change, _] = worst(&fractal_bumps(), [40; 3]);
    assert!(change > 0.2, "{change}");
}

fn pop(subject: &Subject) -> f64 {
    let patch = Patch { pixels: 1, samples: 32, view: views()[1] };
    largest_pop(&patch.slow_zooms(subject, &skies()[0]))
}

#[test]
#[ignore = "slow: weekly"]
fn no_pixel_pops_in_a_slow_zoom() {
    // A frame exchanges 2 % of the pixel's area, and moves the fade of an octave by 1 % of 0.6/0.4 · 1.5 = 2.3: of the range of
    // all samples this much, if everything goes one way. Measured: 3.1 % of paint, 2.5 % of flakes, 1.9 % of fibres, whose edges are hard, 0.8 % and less of others.
    const BOUND: f64 = 0.02 + 0.023;
    for subject in materials() {
        let pop = pop(&subject);
        println!("{}: largest pop {pop:.4}", subject.name);
        assert!(pop < BOUND, "{}: {pop}", subject.name);
        if ["carpet", "paint", "glass, noise", "bumps"].contains(&subject.name) {
            // Details that come up one octave after another, for pixels of 1, ½, ¼, … are seen to pop.
            let name = subject.name;
            let pop = self::pop(&subject.in_steps());
            println!("{name}: largest pop in steps {pop:.4}");
            assert!(pop > BOUND, "{name}: {pop} by steps");
        }
    }
}
