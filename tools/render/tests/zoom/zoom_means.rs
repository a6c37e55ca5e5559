//! Zooming into materials: the visible patch keeps its mean radiance, and no pixel pops.

use asperity_render::shaded::{Patch, Sky, Subject, fractal_bumps, largest_pop, materials};
use asperity_shading::glam::Vec3;

/// From straight above, and at 60°.
fn views() -> [Vec3; 2] {
    [Vec3::Z, Vec3::new(0.0, -0.75_f32.sqrt(), 0.5)]
}

/// A lamp on the opposite side, and a lamp to the side.
fn skies() -> [Sky; 2] {
    [Vec3::new(-0.34, 0.42, 0.84), Vec3::new(0.5, 0.5, 0.6)].map(Sky::about)
}

/// The relative tolerance of the mean, and the pixels along a side at ×100, ×10³ and ×10⁴ that keep
/// its standard error below a third of the tolerance.
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

/// Returns the largest change of the mean from ×1 and the largest standard error, over views, lamps
/// and zooms, relative to the mean.
///
/// The gallery has the same at 256 samples per pixel. Here the number of pixels averages details
/// finer than a pixel.
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
fn materials_keep_their_mean_radiance_at_every_zoom() {
    for subject in materials() {
        let (bound, pixels) = demand(subject.name);
        let [change, error] = worst(&subject, pixels);
        println!("{}: {change:.4}, standard errors up to {error:.4}", subject.name);
        assert!(error < bound / 3.0, "{}: an error of {error} shows nothing", subject.name);
        // Measured: 2.5 % for scratches, 2 % for carpets, 1.8 % for noisy glass, 1.4 % for flakes
        // and less for the others, with errors of up to 1.3 %. For the glass 1.3 % remain with an
        // error of 0.1 %: half from its facets, half from the noise, whose slopes are not Gaussian.
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
fn slow_zoom_does_not_pop() {
    // A frame exchanges 2 % of the pixel's area, and moves the fade of an octave by 1 % of 0.6/0.4
    // · 1.5 = 2.3: at most this fraction of the range of all samples, if all changes add up.
    // Measured: 3.1 % for paint, 2.5 % for flakes, 1.9 % for fibers, whose edges are hard, and at
    // most 0.8 % for the others.
    const BOUND: f64 = 0.02 + 0.023;
    for subject in materials() {
        let pop = pop(&subject);
        println!("{}: largest pop {pop:.4}", subject.name);
        assert!(pop < BOUND, "{}: {pop}", subject.name);
        if ["carpet", "paint", "glass, noise", "bumps"].contains(&subject.name) {
            // Octaves that appear one after another, for pixels of 1, ½, ¼, …, visibly pop.
            let name = subject.name;
            let pop = self::pop(&subject.in_steps());
            println!("{name}: largest pop in steps {pop:.4}");
            assert!(pop > BOUND, "{name}: {pop} by steps");
        }
    }
}
