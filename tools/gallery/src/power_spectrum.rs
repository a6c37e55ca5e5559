//! Power spectra of noise in the plane, from Fourier transforms of windowed samples.

use std::f64::consts::TAU;

use glam::DVec2;
use rayon::prelude::*;

/// The mean power spectrum of square samples: the variance per unit of frequency space at each
/// frequency.
pub(crate) struct PowerSpectrum {
    /// Samples along an axis, a power of two.
    size: usize,
    /// Frequency step along an axis, 1/(size · spacing).
    step: f64,
    /// By row and column, frequency 0 first and negative frequencies from the end.
    power: Vec<f64>,
}

impl PowerSpectrum {
    /// Computes the mean over `2 · pairs` samples of `size`² numbers (a power of two), `spacing`
    /// apart; `sample(k)` returns the k-th.
    ///
    /// The bits do not depend on the number of threads, because spectra are summed in order.
    pub(crate) fn mean(
        size: usize,
        spacing: f64,
        pairs: usize,
        sample: impl Fn(usize) -> Vec<f32> + Sync,
    ) -> Self {
        // Hann window, ½ − ½ cos: leakage is limited to neighboring frequencies.
        let hann = |k: usize| 0.5 - 0.5 * (TAU * (k as f64 + 0.5) / size as f64).cos();
        let window: Vec<f64> = (0..size).map(hann).collect();
        let gain: f64 = window.iter().map(|w| w * w).sum::<f64>().powi(2);
        let spectrum = |pair: usize| -> Vec<f64> {
            let (a, b) = (sample(2 * pair), sample(2 * pair + 1));
            let windowed = |(i, (&a, &b)): (usize, (&f32, &f32))| {
                window[i / size] * window[i % size] * DVec2::new(a.into(), b.into())
            };
            let mut z: Vec<_> = a.iter().zip(&b).enumerate().map(windowed).collect();
            transform_square(&mut z, size);
            // Two real samples in one transform: the mean of a point and its mirror image contains
            // the mean of both powers.
            let mirror = |i: usize| (size - i / size) % size * size + (size - i % size) % size;
            let power = |i: usize| 0.25 * (z[i].length_squared() + z[mirror(i)].length_squared());
            (0..z.len()).map(power).collect()
        };
        let spectra: Vec<Vec<f64>> = (0..pairs).into_par_iter().map(spectrum).collect();
        let mut power = vec![0.0; size * size];
        for spectrum in &spectra {
            for (sum, p) in power.iter_mut().zip(spectrum) {
                *sum += p * spacing * spacing / (gain * pairs as f64);
            }
        }
        Self { size, step: 1.0 / (size as f64 * spacing), power }
    }

    /// Returns the power at an integer multiple of the step along each axis.
    fn entry(&self, kx: i64, ky: i64) -> f64 {
        let index = |k: i64| k.rem_euclid(self.size as i64) as usize;
        self.power[index(ky) * self.size + index(kx)]
    }

    /// Returns the density at a frequency, with bilinear interpolation; periodic above the highest
    /// frequency.
    pub(crate) fn at(&self, fx: f64, fy: f64) -> f64 {
        let (x, y) = (fx / self.step, fy / self.step);
        let (tx, ty) = (x - x.floor(), y - y.floor());
        let (kx, ky) = (x.floor() as i64, y.floor() as i64);
        let along = |ky| self.entry(kx, ky) * (1.0 - tx) + self.entry(kx + 1, ky) * tx;
        along(ky) * (1.0 - ty) + along(ky + 1) * ty
    }

    /// Returns frequency and mean density over rings, six per doubling, from `range[0]` to
    /// `range[1]`.
    ///
    /// Only directions accepted by `wanted` count. Its argument is the cosine of four times the
    /// angle: 1 along the axes and −1 along the diagonals.
    pub(crate) fn rings(&self, range: [f64; 2], wanted: impl Fn(f64) -> bool) -> Vec<[f64; 2]> {
        const PER_DOUBLING: f64 = 6.0;
        let count = ((range[1] / range[0]).log2() * PER_DOUBLING).round().max(1.0) as usize;
        let mut rings = vec![[0.0_f64; 3]; count];
        let half = (self.size / 2) as i64;
        for (ky, kx) in (-half..half).flat_map(|ky| (-half..half).map(move |kx| (ky, kx))) {
            let (x, y) = (kx as f64, ky as f64);
            let square = x * x + y * y;
            let place = ((square.sqrt() * self.step / range[0]).log2() * PER_DOUBLING).floor();
            let cos_4 = 1.0 - 8.0 * (x * y / square).powi(2);
            if (0.0..count as f64).contains(&place) && wanted(cos_4) {
                let [n, log, power] = &mut rings[place as usize];
                (*n, *log, *power) = (*n + 1.0, *log + 0.5 * square.log2(), *power + self.entry(kx, ky));
            }
        }
        let mean = |[n, log, power]: [f64; 3]| (n > 0.0).then(|| [(log / n).exp2() * self.step, power / n]);
        rings.into_iter().filter_map(mean).collect()
    }
}

/// Computes the discrete Fourier transform along both axes.
fn transform_square(z: &mut [DVec2], size: usize) {
    let root = |k: usize| DVec2::from_angle(-TAU * k as f64 / size as f64);
    let roots: Vec<_> = (0..size / 2).map(root).collect();
    for _ in 0..2 {
        z.chunks_exact_mut(size).for_each(|row| transform(row, &roots));
        for y in 0..size {
            for x in 0..y {
                z.swap(y * size + x, x * size + y);
            }
        }
    }
}

/// Computes Σ_j z_j exp(−2πi jk/n) for all k, in place: Cooley and Tukey 1965, radix 2.
fn transform(z: &mut [DVec2], roots: &[DVec2]) {
    let n = z.len();
    let bits = n.trailing_zeros();
    for i in 0..n {
        let j = i.reverse_bits() >> (usize::BITS - bits).min(usize::BITS - 1);
        if i < j {
            z.swap(i, j);
        }
    }
    let mut half = 1;
    while half < n {
        for block in z.chunks_exact_mut(2 * half) {
            let (low, high) = block.split_at_mut(half);
            for ((a, b), w) in low.iter_mut().zip(high).zip(roots.iter().step_by(n / (2 * half))) {
                let t = w.rotate(*b);
                (*a, *b) = (*a + t, *a - t);
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    use super::*;

    /// Returns numbers without a pattern.
    fn arbitrary(k: usize, count: usize) -> Vec<f32> {
        (0..count).map(|i| ((i * i * 37 + i * 11 + k * 101) % 997) as f32 / 498.5 - 1.0).collect()
    }

    #[test]
    fn transform_matches_its_definition() {
        const N: usize = 8;
        let mut z: Vec<_> =
            arbitrary(3, N * N).into_iter().map(|a| f64::from(a) * DVec2::new(1.0, 0.5)).collect();
        let before = z.clone();
        transform_square(&mut z, N);
        for (k, got) in z.iter().enumerate() {
            let turns = |j: usize| (j / N * (k / N) + j % N * (k % N)) as f64 / N as f64;
            let terms = before.iter().enumerate().map(|(j, v)| DVec2::from_angle(-TAU * turns(j)).rotate(*v));
            assert_abs_diff_eq!(*got, terms.sum(), epsilon = 1e-12);
        }
    }

    #[test]
    fn white_noise_density_integrates_to_the_variance() {
        const N: usize = 64;
        let spectrum = PowerSpectrum::mean(N, 0.25, 8, |k| arbitrary(k * k, N * N));
        let total: f64 = spectrum.power.iter().sum::<f64>() * spectrum.step * spectrum.step;
        // Uniform numbers in (−1, 1). The window leaves 64²/4 independent numbers in each of 16
        // samples: 1 % is 1.5 standard errors.
        assert_abs_diff_eq!(total, 1.0 / 3.0, epsilon = 0.02);
    }

    #[test]
    fn wave_is_at_its_frequency_and_ring() {
        const N: usize = 64;
        let wave = |i: usize| (TAU * (5 * (i % N) + 9 * (i / N)) as f64 / N as f64).cos() as f32;
        let spectrum = PowerSpectrum::mean(N, 1.0 / 8.0, 1, |_| (0..N * N).map(wave).collect());
        let (fx, fy) = (5.0 / 8.0, 9.0 / 8.0);
        let peak = spectrum.at(fx, fy);
        // A real sample has a symmetric spectrum.
        assert_relative_eq!(spectrum.at(-fx, -fy), peak, max_relative = 1e-9);
        assert!(spectrum.at(fy, fx) < 1e-9 * peak && spectrum.at(-fx, fy) < 1e-9 * peak);
        let rings = spectrum.rings([0.25, 4.0], |_| true);
        let top = rings.iter().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
        assert!((top[0] / fx.hypot(fy)).log2().abs() < 1.0 / 6.0, "{top:?}");
    }

    #[test]
    fn spectrum_is_independent_of_threads() {
        let power = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| PowerSpectrum::mean(32, 0.1, 6, |k| arbitrary(k, 32 * 32)).power)
        };
        assert_eq!(power(1), power(3));
    }
}
