//! Materials as receding floors under the sun, by the shader and by `Material::bsdf`.

use std::path::Path;

use asperity_shader_tests::case::{INPUTS, OUTPUTS};
use asperity_shader_tests::cases;
use glam::{Vec2, Vec3};

use crate::device::Gpu;
use crate::parity;
use crate::picture::reference::encoded;
use crate::picture::{difference, png};

/// Cases of materials, and the distance of the floor's center in meters.
const FLOORS: [(&str, f32); 16] = [
    ("carpet/carpet, lines", 0.12),
    ("carpet/carpet, grid", 1.2),
    ("paint/metallic_paint, sparkling", 0.03),
    ("paint/metallic_paint, rough coat", 0.3),
    ("paint/counted_flakes", 0.03),
    ("wear/scratches", 0.3),
    ("wear/variations", 0.6),
    ("tempered_glass, pane", 2.0),
    ("tempered_glass, body", 2.0),
    ("textured/brick_wall", 1.0),
    ("textured/beveled_tiles", 3.0),
    ("textured/wallpaper", 3.0),
    ("textured/polished_marble", 3.0),
    ("bump_mapped, exact rule of GGX", 8.0),
    ("bump_mapped, fractal rule of Beckmann", 8.0),
    ("normal_mapped", 2.0),
];

/// Tangent of half the field of view.
const FIELD: f32 = 0.32;

/// Renders every floor, prints the difference between the shader and the crates, and writes one
/// image with the shader on top.
pub(crate) fn run(gpu: &Gpu, size: u32, out: &Path) -> Result<(), String> {
    let cases = cases::all();
    println!(
        "\n| material | mean error of light | pixels that differ by more than 2 of 255 |\n|---|---|---|"
    );
    let mut rows = [vec![], vec![]];
    let mut broken = vec![];
    for (name, distance) in FLOORS {
        let full = format!("shading/material/{name}");
        let case = cases.iter().find(|case| case.name == full).ok_or_else(|| format!("no case `{full}`"))?;
        let inputs = floor(distance, size);
        let ours = light(&parity::outcomes(gpu, case, &inputs)?);
        let theirs: Vec<_> = inputs.iter().map(|input| (case.reference)(*input)).collect();
        let theirs = light(&theirs);
        let sum = |of: &dyn Fn(usize) -> Vec3| {
            (0..theirs.len()).map(|i| of(i).as_dvec3().element_sum()).sum::<f64>()
        };
        let total = sum(&|i| theirs[i]);
        let error = sum(&|i| (ours[i] - theirs[i]).abs()) / total;
        if error > 0.01 || error.is_nan() {
            broken.push(name);
        }
        // Middle gray for the mean.
        let exposure = (0.35 * 3.0 * theirs.len() as f64 / total) as f32;
        let tones = [ours, theirs]
            .map(|light| light.iter().map(|light| encoded(*light * exposure)).collect::<Vec<_>>());
        let count = tones[0].iter().zip(&tones[1]).filter(|(a, b)| difference(**a, **b) > 2).count();
        println!("| {name} | {:.1e} | {:.3} % |", error, 100.0 * count as f64 / inputs.len() as f64);
        rows.iter_mut().zip(tones).for_each(|(row, tones)| row.push(tones));
    }
    let half = FLOORS.len() / 2;
    let picture = [0..half, half..FLOORS.len()].into_iter().flat_map(|columns| {
        let rows = &rows;
        rows.iter().map(move |row| row[columns.clone()].iter().map(Vec::as_slice).collect::<Vec<_>>())
    });
    png(&out.join("gpu-materials.png"), size, &picture.collect::<Vec<_>>())?;
    if broken.is_empty() {
        Ok(())
    } else {
        Err(format!("{}: mean differs by more than 1 %", broken.join(", ")))
    }
}

/// Returns the inputs of a material case at every pixel of a receding floor.
fn floor(distance: f32, size: u32) -> Vec<[u32; INPUTS]> {
    let eye = Vec3::new(0.0, -0.8, 0.6) * distance;
    let forward = -eye.normalize();
    let up = Vec3::X.cross(forward);
    // The sun's reflection is in the upper half.
    let wi = (Vec3::new(0.15, 0.8, 0.45)).normalize();
    let angle = 2.0 * FIELD / size as f32;
    let pixels = (0..size).flat_map(|y| (0..size).map(move |x| [x, y]));
    pixels
        .map(|pixel| {
            let [x, y] = pixel.map(|k| (k as f32 + 0.5) * angle - FIELD);
            let direction = (forward + x * Vec3::X - y * up).normalize();
            let t = -eye.z / direction.z;
            let p = eye + t * direction;
            let wo = -direction;
            let uv = p.truncate() + Vec2::new(0.21, 0.13) * distance;
            let words = [
                uv.x,
                uv.y,
                0.0,
                t * angle,
                wo.x,
                wo.y,
                wo.z,
                0.0,
                wi.x,
                wi.y,
                wi.z,
                0.0,
                uv.x,
                uv.y,
                1.0 / wo.z,
                0.0,
            ];
            words.map(f32::to_bits)
        })
        .collect()
}

fn light(outcomes: &[[u32; OUTPUTS]]) -> Vec<Vec3> {
    outcomes.iter().map(|words| Vec3::from_slice(&[0, 1, 2].map(|k| f32::from_bits(words[k])))).collect()
}
