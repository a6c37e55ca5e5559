//! Times rows on demand: reads names of rows, and prints nanoseconds per sample.

use std::{
    error::Error,
    hint::black_box,
    io::{BufRead, Write},
    time::Instant,
};

use asperity_ndf_sampling::{
    Beckmann, ClosedForm, Ggx, Measure, Ndf, NdfMap, NormalLut, PackedMapRef, Reconstruction,
    glam::{Vec2, Vec3},
};
use rand::{Rng, SeedableRng, rngs::SmallRng};
use rand_distr::{Distribution, weighted::WeightedAliasIndex};

const SIDE: usize = 256;
const ALPHA: [f32; 2] = [0.2, 0.4];

/// A name, samples per pass, and the pass.
type Row = (String, usize, Box<dyn FnMut()>);

fn main() -> Result<(), Box<dyn Error>> {
    let samples = std::env::args().nth(1).map_or(Ok(1_000_000), |text| text.parse())?;
    let mut rows = rows(samples)?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "{}", rows.iter().map(|row| row.0.as_str()).collect::<Vec<_>>().join(" "))?;
    out.flush()?;
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let Some((name, samples, pass)) = rows.iter_mut().find(|row| row.0 == line.trim()) else {
            return Err(format!("no row `{line}`").into());
        };
        let start = Instant::now();
        pass();
        let took = start.elapsed().as_secs_f64();
        // Building counts as one sample, and is reported in microseconds.
        let scale = if name.contains("build") { 1e6 } else { 1e9 };
        writeln!(out, "{}", took * scale / *samples as f64)?;
        out.flush()?;
    }
    Ok(())
}

/// Returns uniform numbers.
fn uniforms(seed: u64, count: usize) -> Vec<f32> {
    SmallRng::seed_from_u64(seed).random_iter().take(count).collect()
}

/// `rand_distr`'s alias table over the same texels: uniform points within a texel. It is not
/// invertible.
fn alias(samples: usize) -> Result<Row, Box<dyn Error>> {
    let table = WeightedAliasIndex::new(texels())?;
    let mut random = SmallRng::seed_from_u64(5);
    let mut points = [vec![0.0_f32; samples], vec![0.0; samples]];
    let pass = move || {
        let [xs, ys] = &mut points;
        for (x, y) in xs.iter_mut().zip(ys) {
            let texel = table.sample(&mut random);
            *x = ((texel % SIDE) as f32 + random.random::<f32>()) / SIDE as f32;
            *y = ((texel / SIDE) as f32 + random.random::<f32>()) / SIDE as f32;
        }
        black_box(&points);
    };
    Ok(("alias_table".into(), samples, Box::new(pass)))
}

/// Returns the density on the map's texels, 0 outside the disk.
fn texels() -> Vec<f32> {
    let center = |k: usize| (k as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0;
    let texel = |k: usize| {
        let (x, y) = (center(k % SIDE), center(k / SIDE));
        let cos2 = 1.0 - x * x - y * y;
        let t = (x / ALPHA[0]).powi(2) + (y / ALPHA[1]).powi(2) + cos2;
        if cos2 > 0.0 { 1.0 / (std::f32::consts::PI * ALPHA[0] * ALPHA[1] * t * t) } else { 0.0 }
    };
    (0..SIDE * SIDE).map(texel).collect()
}

/// Creates a row that maps arrays to arrays.
fn row<const I: usize, const O: usize, E: std::fmt::Debug>(
    name: impl Into<String>,
    inputs: [&[f32]; I],
    mut pass: impl FnMut([&[f32]; I], [&mut [f32]; O]) -> Result<(), E> + 'static,
) -> Row {
    let inputs = inputs.map(<[f32]>::to_vec);
    let samples = inputs[0].len();
    let mut outputs: [Vec<f32>; O] = std::array::from_fn(|_| vec![0.0; samples]);
    let run = move || {
        let done = pass(inputs.each_ref().map(Vec::as_slice), outputs.each_mut().map(Vec::as_mut_slice));
        black_box(done).expect("arrays of one length");
    };
    (name.into(), samples, Box::new(run))
}

/// Creates a row of single calls.
fn calls(name: &str, points: &[Vec2], mut call: impl FnMut(Vec2) -> Vec3 + 'static) -> Row {
    let (samples, points) = (points.len(), points.to_vec());
    let mut normals = vec![Vec3::ZERO; samples];
    let run = move || {
        for (m, &point) in normals.iter_mut().zip(&points) {
            *m = call(point);
        }
        black_box(&normals);
    };
    (name.into(), samples, Box::new(run))
}

/// Returns every available row.
fn rows(samples: usize) -> Result<Vec<Row>, Box<dyn Error>> {
    let [u1, u2, up, azimuth] = [1, 2, 3, 4].map(|seed| uniforms(seed, samples));
    let uniform: Vec<Vec2> = u1.iter().zip(&u2).map(|(&x, &y)| Vec2::new(x, y)).collect();
    let u: [&[f32]; 2] = [&u1, &u2];
    let ggx = Ggx::new(ALPHA[0], ALPHA[1])?;
    let beckmann = Beckmann::new(ALPHA[0], ALPHA[1])?;
    let view = up.iter().zip(&azimuth).map(|(up, azimuth)| {
        let (up, (sin, cos)) = (0.9 * up + 0.1, (std::f32::consts::TAU * azimuth).sin_cos());
        let across = (1.0 - up * up).sqrt();
        Vec3::new(across * cos, across * sin, up)
    });
    let view: Vec<Vec3> = view.collect();
    let view = [0, 1, 2].map(|k| view.iter().map(|v| v[k]).collect::<Vec<_>>());
    let seen: [&[f32]; 5] = [&view[0], &view[1], &view[2], &u1, &u2];
    let z: Vec<Vec2> = uniform.iter().map(|&u| ggx.invert(ggx.sample(u))).collect();
    let gaussian = [0, 1].map(|k| z.iter().map(|z| z[k]).collect::<Vec<_>>());
    let gaussian = gaussian.each_ref().map(Vec::as_slice);
    let table = NormalLut::standard(&ggx);
    let nearest = table.clone();
    let mut rows: Vec<Row> = vec![
        row("ggx_sample", u, move |u, m: [_; 3]| ggx.sample_batch(u, m)),
        row("beckmann_sample", u, move |u, m: [_; 3]| beckmann.sample_batch(u, m)),
        row("ggx_visible", seen, move |[x, y, z, u1, u2], m: [_; 3]| {
            ggx.sample_visible_batch([x, y, z], [u1, u2], m)
        }),
        row("beckmann_visible", seen, move |[x, y, z, u1, u2], m: [_; 3]| {
            beckmann.sample_visible_batch([x, y, z], [u1, u2], m)
        }),
        row("ggx_warp_gaussian", gaussian, move |z, m: [_; 3]| ggx.warp_gaussian_batch(z, m)),
        row("beckmann_warp_gaussian", gaussian, move |z, m: [_; 3]| beckmann.warp_gaussian_batch(z, m)),
    ];
    for (kind, name) in [(Reconstruction::Bilinear, "bilinear"), (Reconstruction::Constant, "constant")] {
        let values = texels();
        let map = NdfMap::from_texels(SIDE, SIDE, &values, Measure::ProjectedSolidAngle, kind)?;
        // Static for the whole run, as in flash.
        let packed = PackedMapRef::new(map.into_array().leak())?;
        let mut points = [vec![0.0; samples], vec![0.0; samples]];
        packed.inverse_batch(u, points.each_mut().map(Vec::as_mut_slice))?;
        let points = points.each_ref().map(Vec::as_slice);
        rows.push(row(format!("map_sample_{name}"), u, move |u, n: [_; 2]| packed.inverse_batch(u, n)));
        rows.push(row(format!("map_forward_{name}"), points, move |n, u: [_; 2]| packed.forward_batch(n, u)));
        rows.push(row(format!("map_density_{name}"), points, move |n, [d]: [_; 1]| packed.d_batch(n, d)));
        let build = move || {
            let map = NdfMap::from_texels(SIDE, SIDE, &values, Measure::ProjectedSolidAngle, kind);
            black_box(map.is_ok());
        };
        rows.push((format!("map_build_{name}"), 1, Box::new(build)));
        if kind == Reconstruction::Bilinear {
            rows.push(calls("map_call_bilinear", &uniform, move |u| packed.sample(u)));
        }
    }
    rows.extend([
        row("table_nearest", gaussian, move |z, m: [_; 3]| nearest.view().nearest_normals(z, m)),
        row("table_bilinear", gaussian, move |z, m: [_; 3]| table.view().bilinear_normals(z, m)),
        alias(samples)?,
        calls("ggx_call", &z, move |z| ggx.warp_gaussian(z)),
        calls("beckmann_call", &z, move |z| beckmann.warp_gaussian(z)),
    ]);
    Ok(rows)
}
