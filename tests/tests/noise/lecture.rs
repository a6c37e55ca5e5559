//! The noises of Ebert (ed.) 1994 and the chained lookups of Nilsson 2008, against transcriptions
//! of their listings.

use asperity_noise::{
    Field, Lattice, PerlinClassic, Sample,
    ebert_1994::{Gnoise, LectureTables, Vgnoise, Vnoise},
    glam::Vec3,
    lattice::{ChainedTable, PermutationTable},
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;

const POINTS: usize = 10_000;

/// Maximum errors seen: `gnoise` 1.8e-7, `vnoise` 4.4e-7, `PerlinClassic` 2.5e-7.
const VALUE_TOLERANCE: f64 = 1e-6;
/// The error of a central difference is h² max |n‴|/6, 7e-10 with h = 1e-5 and n‴ ≤ 40, plus 1e-11
/// of rounding. The spline's second derivative jumps at borders by up to 20. A difference across a
/// border has an error of h/2 of that, 1e-4. Maximum seen 7.7e-7, so no difference crosses a
/// border.
const GRADIENT_TOLERANCE: f64 = 3e-6;

/// The listings in `f64`, with their tables of floats.
struct Listing {
    perm: [u8; 256],
    value_tab: Vec<f64>,
    gradient_tab: Vec<f64>,
}

impl Listing {
    /// `valueTabInit` and `gradientTabInit`, from streams of the same numbers.
    fn new(perm: [u8; 256], seed: u64) -> Self {
        let mut random = Random(seed);
        let value_tab = (0..256).map(|_| f64::from((1.0 - 2.0 * random.uniform()) as f32)).collect();
        let mut random = Random(seed);
        let mut gradient_tab = Vec::new();
        for _ in 0..256 {
            let z = (1.0 - 2.0 * random.uniform()) as f32;
            let r = (1.0 - z * z).sqrt();
            let theta = f64::from((2.0 * std::f64::consts::PI * random.uniform()) as f32);
            let gradient = [r * theta.cos() as f32, r * theta.sin() as f32, z];
            gradient_tab.extend(gradient.map(f64::from));
        }
        Self { perm, value_tab, gradient_tab }
    }

    /// `INDEX(ix, iy, iz)`.
    fn index(&self, ix: i64, iy: i64, iz: i64) -> usize {
        let perm = |x: i64| i64::from(self.perm[(x & 255) as usize]);
        perm(ix + perm(iy + perm(iz))) as usize
    }

    fn glattice(&self, [ix, iy, iz]: [i64; 3], [fx, fy, fz]: [f64; 3]) -> f64 {
        let g = &self.gradient_tab[3 * self.index(ix, iy, iz)..];
        g[0] * fx + g[1] * fy + g[2] * fz
    }

    fn gnoise(&self, p: [f64; 3]) -> f64 {
        let floor = p.map(f64::floor);
        let [ix, iy, iz] = floor.map(|x| x as i64);
        let [fx0, fy0, fz0] = [0, 1, 2].map(|axis| p[axis] - floor[axis]);
        let [fx1, fy1, fz1] = [fx0 - 1.0, fy0 - 1.0, fz0 - 1.0];
        let [wx, wy, wz] = [fx0, fy0, fz0].map(|x| x * x * (3.0 - 2.0 * x));
        let lerp = |t: f64, a: f64, b: f64| a + t * (b - a);
        let row = |iy: i64, iz: i64, fy: f64, fz: f64| {
            let vx0 = self.glattice([ix, iy, iz], [fx0, fy, fz]);
            let vx1 = self.glattice([ix + 1, iy, iz], [fx1, fy, fz]);
            lerp(wx, vx0, vx1)
        };
        let vz0 = lerp(wy, row(iy, iz, fy0, fz0), row(iy + 1, iz, fy1, fz0));
        let vz1 = lerp(wy, row(iy, iz + 1, fy0, fz1), row(iy + 1, iz + 1, fy1, fz1));
        lerp(wz, vz0, vz1)
    }

    fn vnoise(&self, p: [f64; 3]) -> f64 {
        let floor = p.map(f64::floor);
        let [ix, iy, iz] = floor.map(|x| x as i64);
        let [fx, fy, fz] = [0, 1, 2].map(|axis| p[axis] - floor[axis]);
        let zknots: [f64; 4] = std::array::from_fn(|k| {
            let yknots: [f64; 4] = std::array::from_fn(|j| {
                let xknots: [f64; 4] = std::array::from_fn(|i| {
                    self.value_tab[self.index(ix + i as i64 - 1, iy + j as i64 - 1, iz + k as i64 - 1)]
                });
                spline(fx, xknots)
            });
            spline(fy, yknots)
        });
        spline(fz, zknots)
    }
}

/// RenderMan's `spline` over four knots: the Catmull–Rom matrix, by Horner's rule.
fn spline(x: f64, knots: [f64; 4]) -> f64 {
    const MATRIX: [[f64; 4]; 4] =
        [[-0.5, 1.5, -1.5, 0.5], [1.0, -2.5, 2.0, -0.5], [-0.5, 0.0, 0.5, 0.0], [0.0, 1.0, 0.0, 0.0]];
    MATRIX.iter().fold(0.0, |sum, row| sum * x + row.iter().zip(knots).map(|(m, k)| m * k).sum::<f64>())
}

fn tables(seed: u64) -> (LectureTables, Listing) {
    let permutation = PermutationTable::new(seed as u32);
    let (mut values, mut gradients) = (Random(seed), Random(seed));
    let tables = LectureTables::new(permutation, || values.uniform(), || gradients.uniform());
    (tables, Listing::new(*permutation.entries(), seed))
}

/// Returns points within ±512, two periods, with sixteen fractional bits as far as `f32` permits.
fn points() -> impl Iterator<Item = Vec3> {
    let mut random = Random(1994);
    std::iter::repeat_with(move || {
        Vec3::from_array(std::array::from_fn(|_| (1024.0 * random.uniform() - 512.0) as f32))
    })
    .take(POINTS)
}

/// Returns the maximum errors of values and gradients.
fn errors(sample: impl Fn(Vec3) -> Sample<Vec3>, expected: impl Fn([f64; 3]) -> f64) -> [f64; 2] {
    let h = 1e-5;
    let mut worst = [0.0_f64; 2];
    for p in points() {
        let (got, wide) = (sample(p), p.to_array().map(f64::from));
        worst[0] = worst[0].max((f64::from(got.value) - expected(wide)).abs());
        for axis in 0..3 {
            let moved = |step: f64| {
                let mut q = wide;
                q[axis] += step;
                expected(q)
            };
            let difference = (moved(h) - moved(-h)) / (2.0 * h);
            worst[1] = worst[1].max((f64::from(got.gradient[axis]) - difference).abs());
        }
    }
    worst
}

fn close(name: &str, [value, gradient]: [f64; 2]) {
    assert!(value < VALUE_TOLERANCE && gradient < GRADIENT_TOLERANCE, "{name}: {value:e}, {gradient:e}");
}

#[test]
fn tables_match_the_listings() {
    let (tables, listing) = tables(665);
    for i in 0..256 {
        assert_eq!(f64::from(tables.values()[i]), listing.value_tab[i]);
        for axis in 0..3 {
            // Sine and cosine are rounded from `f64` on both sides: at most an ulp if they are
            // halfway. Maximum seen 0.
            let error = f64::from(tables.gradients()[i][axis]) - listing.gradient_tab[3 * i + axis];
            assert_abs_diff_eq!(error, 0.0, epsilon = 1.2e-7, "{i}, axis {axis}: {error:e}");
        }
    }
}

#[test]
fn gnoise_matches_the_listing() {
    let (tables, listing) = tables(665);
    close("gnoise", errors(|p| Gnoise(&tables).sample(p), |p| listing.gnoise(p)));
}

#[test]
fn vnoise_matches_the_listing() {
    let (tables, listing) = tables(665);
    close("vnoise", errors(|p| Vnoise(&tables).sample(p), |p| listing.vnoise(p)));
}

#[test]
fn vgnoise_is_the_weighted_sum() {
    let (tables, listing) = tables(666);
    let noise = Vgnoise::new(&tables, 0.6).expect("a weight");
    let expected = |p| f64::from(0.4_f32) * listing.vnoise(p) + f64::from(0.6_f32) * listing.gnoise(p);
    close("vgnoise", errors(|p| noise.sample(p), expected));
}

/// Gradient noise of 1985 on a permutation equals the lecture's times 2/√3, with differently
/// selected gradients.
#[test]
fn perlin_1985_on_a_permutation_is_gnoise() {
    let (_, mut listing) = tables(665);
    let permutation = PermutationTable::from_entries(listing.perm).expect("a permutation");
    let seed = 31;
    for z in 0..256 {
        let index = listing.index(0, 0, z);
        let gradient = PerlinClassic::gradient::<3>(permutation.word([0, 0, z as i32], seed));
        for (to, from) in listing.gradient_tab[3 * index..].iter_mut().zip(gradient) {
            *to = f64::from(from);
        }
    }
    // The noise is below the bound by 2e-6, against rounding.
    let scale = 2.0 / 3.0_f64.sqrt() * (1.0 - 2e-6);
    let noise = PerlinClassic::default().with_lattice(permutation);
    close("Perlin 1985", errors(|p| noise.with_seed(seed).sample(p), |p| scale * listing.gnoise(p)));
}

/// The thesis's listing in `f32`, with a repeating byte texture and point sampling.
fn prng(texture: &[u8; 256], pos: [f32; 3], size: f32) -> f32 {
    let tex2d = |u: f32| {
        let texel = (f64::from(u - u.floor()) * 256.0).floor() as usize % 256;
        f32::from(texture[texel]) / 255.0
    };
    let mut permute_val = 0.0;
    let pos = pos.map(|x| x / (size * 256.0));
    for x in pos {
        permute_val = tex2d(x + permute_val);
    }
    permute_val
}

#[test]
fn chained_table_matches_the_thesis_listing() {
    let permutation = PermutationTable::new(2008);
    let table = ChainedTable(permutation);
    let mut random = Random(2008);
    for p in points() {
        for size in [1.0, 0.01 + random.uniform() as f32] {
            let expected = prng(permutation.entries(), p.to_array(), size);
            assert_eq!(table.prng(p.to_array(), size).to_bits(), expected.to_bits(), "{p}, size {size}");
        }
        let cell = p.floor();
        let byte = table.index([cell.x as i32, cell.y as i32, cell.z as i32]);
        assert_eq!(f32::from(byte) / 255.0, prng(permutation.entries(), cell.to_array(), 1.0), "{cell}");
    }
}
