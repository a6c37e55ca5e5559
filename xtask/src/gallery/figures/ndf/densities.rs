//! Every density of normals: its map, its lobe, its slopes, and what is left between it and the normals drawn from it.

use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, BlinnPhong, Ggx, Isotropic, Mixture, StudentT, Ward,
};
use asperity_render::{
    image::tone::hex, light::background::background, materials::SharedNdf, sampling::random::Random,
};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Figure, Panel};
use crate::gallery::figures::kautz::ndf::lobe_panel;
use crate::gallery::panels::density_panel;
use crate::gallery::plot::{Axis, Names, Plot, Stroke};
use crate::input::density::painted;

/// One figure for each density; a new one is one entry here.
pub(crate) const DENSITIES: &[Figure] = &[
    Figure { name: "ndf-density-ggx", draw: |context| draw(context, "GGX 0.2, 0.4", &Ggx::new(0.2, 0.4)?) },
    Figure {
        name: "ndf-density-beckmann",
        draw: |context| draw(context, "Beckmann 0.2, 0.4", &Beckmann::new(0.2, 0.4)?),
    },
    Figure {
        name: "ndf-density-student-t",
        draw: |context| draw(context, "Student-t 0.2, 0.4, γ = 1.6", &StudentT::new(0.2, 0.4, 1.6)?),
    },
    Figure {
        name: "ndf-density-blinn-phong",
        draw: |context| draw(context, "Blinn\u{2013}Phong, n = 20", &BlinnPhong::new(20.0)?),
    },
    Figure {
        name: "ndf-density-ashikhmin-shirley",
        draw: |context| draw(context, "Ashikhmin\u{2013}Shirley 80, 12", &AshikhminShirley::new(80.0, 12.0)?),
    },
    Figure {
        name: "ndf-density-ward",
        draw: |context| draw(context, "Ward 0.35, 0.15", &Ward::new(0.35, 0.15)?),
    },
    Figure {
        name: "ndf-density-mixture",
        draw: |context| {
            let mixture = Mixture::new(Ggx::isotropic(0.12)?, BlinnPhong::new(0.0)?, 0.2)?;
            draw(context, "0.2 GGX 0.12 + 0.8 diffuse", &mixture)
        },
    },
    Figure {
        name: "ndf-density-isotropic",
        draw: |context| {
            let ring = |cos: f32| {
                let tilt = cos.acos();
                (-(tilt / 0.12).powi(2)).exp() + 0.35 * (-((tilt - 0.6) / 0.09).powi(2)).exp()
            };
            draw(context, "table, 513 cosines", &Isotropic::from_fn(513, ring)?)
        },
    },
    Figure {
        name: "ndf-density-painted",
        draw: |context| draw(context, "painted, 256 \u{d7} 256", &painted()?),
    },
];

/// Normals that are drawn for the residual.
const NORMALS: u32 = 1 << 22;
/// Bins along a side of the square around the disk.
const BINS: usize = 64;
/// Full blue and full red of the residual, in standard deviations of the count.
const CONTRAST: f64 = 4.0;

fn draw(context: &Context<'_>, name: &str, ndf: &SharedNdf) -> Result<Drawn, Failure> {
    let residual = Residual::measure(context, ndf)?;
    let panels = vec![
        density_panel(context, ndf, name)?,
        lobe_panel(context, ndf, &format!("The lobe of {name} above a disk."))?,
        slopes(ndf)?,
        residual.panel(context)?,
    ];
    Ok(Drawn::new(4, panels)
        .fact("density", name)
        .fact("normals drawn", format!("{} million", NORMALS >> 20))
        .fact("χ² per degree of freedom", format!("{:.3}", residual.chi_square_per_freedom()))
        .fact("total variation", format!("{:.5}", residual.total_variation()))
        .fact("of which the sampling's", format!("{:.5}", residual.sampling_floor())))
}

/// The slope density along both axes, in decades.
fn slopes(ndf: &SharedNdf) -> Result<Panel, Failure> {
    const REACH: f64 = 2.0;
    const DECADES: f64 = 5.0;
    let top = f64::from(ndf.slope_density(Vec2::ZERO)).max(f64::MIN_POSITIVE);
    let tallest = (-200..=200)
        .flat_map(|k| [Vec2::X, Vec2::Y].map(|axis| axis * (k as f32 * 0.01)))
        .map(|slope| f64::from(ndf.slope_density(slope)))
        .fold(top, f64::max)
        .log10()
        .ceil();
    let cut = |axis: Vec2| {
        (-400..=400)
            .map(|k| f64::from(k) * REACH / 400.0)
            .map(move |s| [s, f64::from(ndf.slope_density(axis * s as f32)).max(1e-30).log10()])
            .map(move |[s, p]| [s, if p < tallest - DECADES { f64::NAN } else { p }])
    };
    let x = Axis::linear("slope", [-REACH, REACH], 1.0);
    let y = Axis::linear("log₁₀ of the density", [tallest - DECADES, tallest], 1.0);
    Plot::new([330.0, 330.0], x, y, Names::Above)
        .curve("along y", cut(Vec2::Y), Stroke::dashed(2))
        .curve("along x", cut(Vec2::X), Stroke::solid(1).wide(2.0))
        .panel(
            "slopes",
            "slopes, along both axes",
            "The density of slopes along the two axes, in powers of ten",
        )
}

/// Counted and expected normals in bins that lie in the disk as a whole.
struct Residual {
    /// Counts and expectations, `None` for bins that the rim crosses or that expect too few.
    bins: Vec<Option<[f64; 2]>>,
}

impl Residual {
    /// Draws normals by pseudo-random Gaussian numbers and counts them.
    fn measure(context: &Context<'_>, ndf: &SharedNdf) -> Result<Self, Failure> {
        const PARTS: u32 = 64;
        let counts: Vec<Vec<u32>> = (0..PARTS)
            .into_par_iter()
            .map(|part| {
                let mut random = Random(u64::from(context.seed) << 32 | u64::from(part));
                let mut counts = vec![0; BINS * BINS];
                for _ in 0..NORMALS / PARTS {
                    let m = ndf.from_gaussian(Vec2::from(random.gaussians().map(|z| z as f32)));
                    let place = |n: f32| ((n * 0.5 + 0.5) * BINS as f32) as usize;
                    if let Some(count) =
                        counts.get_mut(place(m.y).min(BINS - 1) * BINS + place(m.x).min(BINS - 1))
                    {
                        *count += 1;
                    }
                }
                counts
            })
            .collect();
        context.checkpoint()?;
        let bins = (0..BINS * BINS)
            .into_par_iter()
            .map(|bin| {
                let expected = f64::from(NORMALS) * integral(ndf, bin % BINS, bin / BINS)?;
                let count = counts.iter().map(|part| f64::from(part[bin])).sum();
                // Fewer would not be near to Gaussian.
                (expected >= 10.0).then_some([count, expected])
            })
            .collect();
        Ok(Self { bins })
    }

    fn sum(&self, term: impl Fn([f64; 2]) -> f64) -> f64 {
        self.bins.iter().flatten().map(|&bin| term(bin)).sum()
    }

    fn chi_square_per_freedom(&self) -> f64 {
        self.sum(|[count, expected]| (count - expected).powi(2) / expected)
            / self.bins.iter().flatten().count().max(1) as f64
    }

    /// Half the sum of the differences, as shares of all normals.
    fn total_variation(&self) -> f64 {
        0.5 * self.sum(|[count, expected]| (count - expected).abs()) / f64::from(NORMALS)
    }

    /// Expected total variation from random numbers alone: `½ Σ √(2/π) √expected`.
    fn sampling_floor(&self) -> f64 {
        0.5 * self.sum(|[_, expected]| (expected * std::f64::consts::FRAC_2_PI).sqrt()) / f64::from(NORMALS)
    }

    /// The differences over their standard deviations, on the disk.
    fn panel(&self, context: &Context<'_>) -> Result<Panel, Failure> {
        const RADIUS: f32 = 0.86;
        let sampling = context.square();
        let half = 0.5 * sampling.width as f32 * RADIUS;
        let (low, middle, high) = (hex(0x4f_8fd0), hex(0x1f_2129), hex(0xe0_7a4a));
        let image = context.render(sampling, |px, py| {
            let (x, y) = (px / half - 1.0 / RADIUS, 1.0 / RADIUS - py / half);
            let place = |n: f32| ((n * 0.5 + 0.5) * BINS as f32).floor();
            let (i, j) = (place(x), place(y));
            let inside = x * x + y * y < 1.0;
            let bin =
                if inside { self.bins.get(j as usize * BINS + i as usize).copied().flatten() } else { None };
            match bin {
                Some([count, expected]) => {
                    let deviation = ((count - expected) / expected.sqrt() / CONTRAST).clamp(-1.0, 1.0) as f32;
                    middle.lerp(if deviation < 0.0 { low } else { high }, deviation.abs())
                }
                None if inside => hex(0x2b_2d35),
                None => background(px / sampling.width as f32, py / sampling.height as f32),
            }
        })?;
        Ok(Panel::raster(
            "residual",
            format!("drawn less expected, \u{b1}{CONTRAST} deviations"),
            "Blue and orange specks without a pattern over the disk of normals.",
            image,
        ))
    }
}

/// The share of normals in a bin; nothing where the rim crosses it.
fn integral(ndf: &SharedNdf, i: usize, j: usize) -> Option<f64> {
    const POINTS: usize = 24;
    let edge = |k: usize| 2.0 * k as f64 / BINS as f64 - 1.0;
    let corner = |a: usize, b: usize| edge(i + a).hypot(edge(j + b)) < 1.0;
    if ![(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().all(|(a, b)| corner(a, b)) {
        return None;
    }
    let step = 2.0 / BINS as f64 / POINTS as f64;
    let at = |k: usize, m: usize| edge(k) + step * (m as f64 + 0.5);
    let sum: f64 = (0..POINTS * POINTS)
        .map(|k| (at(i, k % POINTS), at(j, k / POINTS)))
        .map(|(x, y)| Vec3::new(x as f32, y as f32, (1.0 - x * x - y * y).sqrt() as f32))
        .map(|m| f64::from(ndf.density(m)))
        .sum();
    Some(sum * step * step)
}
