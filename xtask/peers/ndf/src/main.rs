//! Times one row after another on demand: reads names of rows, answers with nanoseconds per sample.

use std::{
    error::Error,
    hint::black_box,
    io::{BufRead, Write},
    time::Instant,
};

use asperity_ndf_sampling::{
    Beckmann, Ggx, Measure, Ndf, NdfMap, NormalTable, PackedMapRef, Reconstruction,
    glam::{Vec2, Vec3},
};
use rand::{Rng, SeedableRng, rngs::SmallRng};
use rand_distr::{Distribution, weighted::WeightedAliasIndex};

const SIDE: usize = 256;
const ALPHA: [f32; 2] = [0.2, 0.4];

/// A name, samples of one pass, and the pass.
type Row = (&'static str, usize, Box<dyn FnMut()>);

fn main() -> Result<(), Box<dyn Error>> {
    let samples = std::env::args().nth(1).map_or(Ok(1_000_000), |text| text.parse())?;
    let mut rows = rows(samples)?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "{}", rows.iter().map(|row| row.0).collect::<Vec<_>>().join(" "))?;
    out.flush()?;
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let Some((name, samples, pass)) = rows.iter_mut().find(|row| row.0 == line.trim()) else {
            return Err(format!("there is no row `{line}`").into());
        };
        let start = Instant::now();
        pass();
        let took = start.elapsed().as_secs_f64();
        // Building is one sample, and is told in microseconds.
        let scale = if name.contains("build") { 1e6 } else { 1e9 };
        writeln!(out, "{}", took * scale / *samples as f64)?;
        out.flush()?;
    }
    Ok(())
}

/// SplitMix64: uniform numbers with 24 bits.
fn uniforms(seed: u64, count: usize) -> Vec<f32> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1 << 24) as f32
    };
    (0..count).map(|_| next()).collect()
}

/// The coordinates as two arrays.
fn gaussian_coordinates(z: &[Vec2]) -> [Vec<f32>; 2] {
    [0, 1].map(|k| z.iter().map(|z| z[k]).collect())
}

/// `rand_distr`'s alias table over the same texels: points uniform in a texel, which it cannot invert.
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
    Ok(("alias_table", samples, Box::new(pass)))
}

/// The density on the map's texels, 0 outside the disk.
fn texels() -> Vec<f32> {
    let centre = |k: usize| (k as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0;
    let texel = |k: usize| {
        let (x, y) = (centre(k % SIDE), centre(k / SIDE));
        let cos2 = 1.0 - x * x - y * y;
        let t = (x / ALPHA[0]).powi(2) + (y / ALPHA[1]).powi(2) + cos2;
        if cos2 > 0.0 { 1.0 / (std::f32::consts::PI * ALPHA[0] * ALPHA[1] * t * t) } else { 0.0 }
    };
    (0..SIDE * SIDE).map(texel).collect()
}

/// A row from arrays into arrays.
fn row<const I: usize, const O: usize>(
    name: &'static str,
    inputs: [Vec<f32>; I],
    mut pass: impl FnMut([&[f32]; I], [&mut [f32]; O]) -> bool + 'static,
) -> Row {
    let samples = inputs[0].len();
    let mut outputs: [Vec<f32>; O] = std::array::from_fn(|_| vec![0.0; samples]);
    let run = move || {
        let done = pass(inputs.each_ref().map(Vec::as_slice), outputs.each_mut().map(Vec::as_mut_slice));
        assert!(black_box(done), "arrays of one length");
    };
    (name, samples, Box::new(run))
}

/// Every row that can be asked for.
fn rows(samples: usize) -> Result<Vec<Row>, Box<dyn Error>> {
    let [u1, u2] = [1, 2].map(|seed| uniforms(seed, samples));
    let ggx = Ggx::new(ALPHA[0], ALPHA[1])?;
    let beckmann = Beckmann::new(ALPHA[0], ALPHA[1])?;
    let view: Vec<Vec3> = uniforms(3, samples)
        .into_iter()
        .zip(uniforms(4, samples))
        .map(|(up, azimuth)| {
            let (up, (sin, cos)) = (0.9 * up + 0.1, (std::f32::consts::TAU * azimuth).sin_cos());
            let across = (1.0 - up * up).sqrt();
            Vec3::new(across * cos, across * sin, up)
        })
        .collect();
    let view = [0, 1, 2].map(|k| view.iter().map(|v| v[k]).collect::<Vec<_>>());
    let z: Vec<Vec2> = (0..samples).map(|k| ggx.to_gaussian(ggx.sample(Vec2::new(u1[k], u2[k])))).collect();
    let gaussian = gaussian_coordinates(&z);
    let mut rows: Vec<Row> = Vec::new();

    let u = || [u1.clone(), u2.clone()];
    let seen = || [view[0].clone(), view[1].clone(), view[2].clone(), u1.clone(), u2.clone()];
    rows.push(row("ggx_sample", u(), move |u, m: [&mut [f32]; 3]| ggx.samples(u, m).is_ok()));
    rows.push(row("beckmann_sample", u(), move |u, m: [&mut [f32]; 3]| {
        beckmann.samples(u, m).is_ok()
    }));
    rows.push(row("ggx_visible", seen(), move |[x, y, z, u1, u2], m: [&mut [f32]; 3]| {
        ggx.visible_samples([x, y, z], [u1, u2], m).is_ok()
    }));
    rows.push(row("beckmann_visible", seen(), move |[x, y, z, u1, u2], m: [&mut [f32]; 3]| {
        beckmann.visible_samples([x, y, z], [u1, u2], m).is_ok()
    }));
    rows.push(row("ggx_from_gaussian", gaussian.clone(), move |z, m: [&mut [f32]; 3]| {
        ggx.normals(z, m).is_ok()
    }));
    rows.push(row("beckmann_from_gaussian", gaussian, move |z, m: [&mut [f32]; 3]| {
        beckmann.normals(z, m).is_ok()
    }));
    let kinds = [
        (
            Reconstruction::Bilinear,
            ["map_sample_bilinear", "map_forward_bilinear", "map_density_bilinear"],
            "map_build_bilinear",
        ),
        (
            Reconstruction::Constant,
            ["map_sample_constant", "map_forward_constant", "map_density_constant"],
            "map_build_constant",
        ),
    ];
    for (kind, [sample, forward, density], build) in kinds {
        let map = NdfMap::from_texels(SIDE, SIDE, &texels(), Measure::Normals, kind)?;
        // As in flash: for the whole run.
        let packed = PackedMapRef::new(map.pack().leak())?;
        let mut points = [vec![0.0; samples], vec![0.0; samples]];
        packed.inverses([&u1, &u2], points.each_mut().map(Vec::as_mut_slice))?;
        rows.push(row(sample, u(), move |u, n: [&mut [f32]; 2]| packed.inverses(u, n).is_ok()));
        rows.push(row(forward, points.clone(), move |n, u: [&mut [f32]; 2]| {
            packed.forwards(n, u).is_ok()
        }));
        rows.push(row(density, points, move |n, [density]: [&mut [f32]; 1]| {
            packed.densities(n, density).is_ok()
        }));
        let values = texels();
        rows.push((
            build,
            1,
            Box::new(move || {
                black_box(NdfMap::from_texels(SIDE, SIDE, &values, Measure::Normals, kind).is_ok());
            }),
        ));
        if kind == Reconstruction::Bilinear {
            let uniforms: Vec<Vec2> = u1.iter().zip(&u2).map(|(&x, &y)| Vec2::new(x, y)).collect();
            let mut normals = vec![Vec3::ZERO; samples];
            rows.push((
                "map_call_bilinear",
                samples,
                Box::new(move || {
                    for (m, &u) in normals.iter_mut().zip(&uniforms) {
                        *m = packed.sample(u);
                    }
                    black_box(&normals);
                }),
            ));
        }
    }
    let table = NormalTable::standard(&ggx);
    let nearest = table.clone();
    rows.push(row("table_nearest", gaussian_coordinates(&z), move |z, m: [&mut [f32]; 3]| {
        nearest.view().nearest_normals(z, m).is_ok()
    }));
    rows.push(row("table_bilinear", gaussian_coordinates(&z), move |z, m: [&mut [f32]; 3]| {
        table.view().bilinear_normals(z, m).is_ok()
    }));
    rows.push(alias(samples)?);
    let coordinates = z.clone();
    let mut normals = vec![Vec3::ZERO; samples];
    rows.push((
        "ggx_call",
        samples,
        Box::new(move || {
            for (m, &z) in normals.iter_mut().zip(&coordinates) {
                *m = ggx.from_gaussian(z);
            }
            black_box(&normals);
        }),
    ));
    let coordinates = z.clone();
    let mut normals = vec![Vec3::ZERO; samples];
    rows.push((
        "beckmann_call",
        samples,
        Box::new(move || {
            for (m, &z) in normals.iter_mut().zip(&coordinates) {
                *m = beckmann.from_gaussian(z);
            }
            black_box(&normals);
        }),
    ));
    Ok(rows)
}
