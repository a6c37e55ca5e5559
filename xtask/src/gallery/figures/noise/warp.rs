//! Domain warping: a sum of octaves seen through others.

use asperity_noise::{Field, Octaves, Sample, Simplex, Spectrum, Warp};
use asperity_render::image::tone::hex;
use glam::{Vec2, Vec3};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn};
use crate::gallery::figures::noise::plane::{Window, grey};

const CELLS: f32 = 3.0;
const OCTAVES: f32 = 6.0;
const STRENGTH: f32 = 0.22;
/// Octaves of the fields that move the points.
const MOVING: f32 = 3.0;
/// Height of the relief over a cell's width.
const RELIEF: f32 = 0.05;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let window = Window::new(context, CELLS);
    let sum = |k: u32| {
        let seed = context.seed.wrapping_mul(16).wrapping_add(k);
        Octaves::<_, 2>::new(Simplex::new(seed), Spectrum::CLOUD)
    };
    let sums: [_; 5] = std::array::from_fn(|k| sum(k as u32));
    let first = |k: usize| sums[k].first(OCTAVES);
    let moving = |k: usize| sums[k].first(MOVING);
    let once = Warp::new(first(0), [moving(1), moving(2)], STRENGTH)?;
    let by = Warp::new(moving(3), [moving(1), moving(2)], STRENGTH)?;
    let other = Warp::new(moving(4), [moving(1), moving(2)], STRENGTH)?;
    let twice = Warp::new(first(0), [by, other], STRENGTH)?;
    let shown = |words: [&str; 3], values: &[f32]| window.panel(words, |i| grey(0.5 + 0.22 * values[i]));
    let samples = window.map(context, |p: Vec2| (twice.sample(p), twice.displacement(p).point - p))?;
    let plain = window.map(context, |p: Vec2| first(0).value(p))?;
    let once = window.map(context, |p: Vec2| once.value(p))?;
    let twice: Vec<f32> = samples.iter().map(|(sample, _)| sample.value).collect();
    let light = Vec3::new(-0.5, 0.6, 0.62).normalize();
    let words = ["lit", "lit by its gradient", "A carved, tinted relief of the marbled streaks."];
    let lit = window.panel(words, |i| {
        let (Sample { value, gradient }, moved) = samples[i];
        let moved = moved / STRENGTH;
        let normal = Vec3::new(-gradient.x * RELIEF, -gradient.y * RELIEF, 1.0).normalize();
        let tint = hex(0x3e_6a86).lerp(hex(0xd9_a066), (0.5 + 0.3 * moved.x).clamp(0.0, 1.0));
        let tint = tint.lerp(hex(0xf2_e8d5), (0.28 + 0.2 * value).clamp(0.0, 1.0));
        tint * (0.08 + 1.1 * normal.dot(light).max(0.0))
    });
    let panels = vec![
        shown(["plain", "f(p)", "Soft clouds."], &plain),
        shown(["once", "f(p + s w(p))", "The clouds drawn out into streaks and folds."], &once),
        shown(["twice", "w warped too", "Marbled streaks with eddies and sharp folds."], &twice),
        lit,
    ];
    let noise = format!("simplex, r² = 0.5, f of {OCTAVES} octaves, lacunarity 2, gain 0.5, of variance 1");
    Ok(Drawn::new(4, panels)
        .fact("noise", noise)
        .fact("picture", format!("{CELLS} \u{d7} {CELLS} cells"))
        .fact("w", format!("{MOVING} octaves, s = {STRENGTH}")))
}
