//! Adaptive sampling: every pixel is sampled until the standard error of its mean is small.

use glam::Vec3;

use crate::{
    failure::Failure,
    geometry::camera::Camera,
    image::Image,
    integrator::{
        non_local_means,
        pixels::{Sampling, Watch, each_row, pixel_hash},
    },
    sampling::sampler::Sampler,
    scene::Scene,
};

/// The noise target of an image.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// Standard error of a pixel's displayed luminance, relative to the displayed luminance. The
    /// median over the pixels is at most this value, and any pixel is at most at twice this value,
    /// unless it reaches the maximum number of samples. Both limits are 1.25 times as large where
    /// neighbors are combined.
    pub error: f32,
    /// Maps linear luminance to displayed luminance, by the tone curve and the display's transfer
    /// curve.
    pub shown: fn(f32) -> f32,
    /// Displayed luminance below which errors are relative to this value, because darker errors are
    /// not visible.
    pub dark: f32,
    /// Minimum and maximum number of samples per pixel.
    pub samples: [u32; 2],
    pub detail: Detail,
}

/// The size of visible detail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Larger than pixels, or with more contrast than the target: noise is removed by averaging
    /// similar neighbors.
    Coarse,
    /// At the size of pixels, e.g. fibers and glints: pixels keep their own samples.
    Fine,
}

impl Goal {
    /// Returns the median error of the samples before smoothing.
    fn of_samples(&self) -> f32 {
        match self.detail {
            Detail::Coarse => SHARED * self.error,
            Detail::Fine => self.error,
        }
    }

    /// Returns the target sample error at `lenience` times the median, for a pixel that displays
    /// `shown`.
    fn at(&self, shown: f32, lenience: f32) -> f32 {
        lenience * self.of_samples() * shown.max(self.dark)
    }
}

/// The noise of a finished image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Standard error of a pixel's displayed luminance, relative to it: the median over the pixels
    /// with any.
    pub median: f32,
    /// Mean number of samples per pixel.
    pub samples: f32,
}

/// Candidates for the maximum error of a pixel relative to the target median. The largest that
/// reaches the target is used, or else the target itself.
const LENIENCE: [f32; 5] = [2.0, 1.7, 1.5, 1.3, 1.1];

/// Sample errors relative to the target, where neighbors are combined.
const SHARED: f32 = 1.25;

/// Half the side of the square of pixels whose variances are pooled.
const REACH: usize = 3;

/// Maximum growth factor of a pixel's samples per pass, because few samples estimate a variance
/// poorly.
const GROWTH: u32 = 2;

/// Weights of a pixel and of its two neighbors along each axis. Together with the pixel's own box
/// this is a filter of deviation 0.58 pixels, similar to the usual Gaussian of renderers.
const FILTER: [f32; 2] = [0.75, 0.125];

/// The fraction of the variance of pixels that remains in their filtered mean.
const KEPT: f32 = {
    let along = FILTER[0] * FILTER[0] + 2.0 * FILTER[1] * FILTER[1];
    along * along
};

/// Samples of one pixel in two halves with independent points, so that their difference estimates
/// the error of their mean.
#[derive(Clone, Copy, Default)]
struct Halves {
    sums: [Vec3; 2],
    /// Samples in each half.
    count: u32,
}

impl Halves {
    fn mean(&self) -> Vec3 {
        (self.sums[0] + self.sums[1]) / (2 * self.count).max(1) as f32
    }

    /// Returns the variance of one sample's luminance, an estimate with one degree of freedom.
    fn variance(&self) -> f32 {
        let difference = luminance(self.sums[0] - self.sums[1]);
        difference * difference / (2 * self.count).max(1) as f32
    }
}

/// Returns the luminance of linear RGB, ITU-R BT.709.
fn luminance(color: Vec3) -> f32 {
    color.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// Renders the mean of `radiance` per pixel, with as many samples as the error target requires.
///
/// The samples of a pixel alternate between two independent sequences of [`Sampler`]. A quarter of
/// the squared difference of their means is the variance of the overall mean, whatever structure
/// each sequence has. These variances are averaged over squares of pixels, so that a pixel that
/// missed all bright samples by chance is judged by its neighbors too. The two halves follow
/// Rousselle, Knaus and Zwicker 2012, "Adaptive Rendering with Non-Local Means Filtering". Each
/// half is denoised with weights from the other, to the extent that the target permits. The
/// difference afterward estimates the error of the image.
///
/// The image does not depend on the number of threads.
pub fn render_until(
    sampling: Sampling,
    goal: &Goal,
    watch: Watch<'_>,
    radiance: impl Fn(f32, f32, &mut Sampler) -> Vec3 + Sync,
) -> Result<(Image, Grain), Failure> {
    let Sampling { width, height, .. } = sampling;
    let pixels = sampled(sampling, goal, watch, radiance)?;
    let samples = pixels.iter().map(|pixel| 2.0 * f64::from(pixel.count)).sum::<f64>();
    let halves = pictures(&pixels, [width, height], goal, watch)?;
    let median = median(errors(&halves, goal.shown).into_iter());
    let grain = Grain { median, samples: (samples / pixels.len().max(1) as f64) as f32 };
    Ok((mean(&halves), grain))
}

/// Returns the images of both halves.
fn pictures(
    pixels: &[Halves],
    [width, height]: [u32; 2],
    goal: &Goal,
    watch: Watch<'_>,
) -> Result<[Image; 2], Failure> {
    let halves = smoothed(pixels, width as usize, goal, watch)?;
    Ok([0, 1].map(|half| {
        let pixels = halves.iter().map(|halves| halves[half]).collect();
        reconstructed(&Image { width, height, pixels })
    }))
}

fn mean([first, second]: &[Image; 2]) -> Image {
    let pairs = first.pixels.iter().zip(&second.pixels);
    let pixels = pairs.map(|(first, second)| 0.5 * (first + second)).collect();
    Image { pixels, ..*first }
}

/// Returns the means of both halves. For coarse detail, most of the noise that the target permits
/// is removed.
fn smoothed(
    pixels: &[Halves],
    columns: usize,
    goal: &Goal,
    watch: Watch<'_>,
) -> Result<Vec<[Vec3; 2]>, Failure> {
    let halves: Vec<_> =
        pixels.iter().map(|pixel| pixel.sums.map(|sum| sum / pixel.count.max(1) as f32)).collect();
    if goal.detail == Detail::Fine {
        return Ok(halves);
    }
    let sample = |(pixel, [first, second]): (&Halves, &[Vec3; 2])| {
        pixel.count as f32 * (first - second).length_squared() / 6.0
    };
    let own: Vec<_> = pixels.iter().zip(&halves).map(sample).collect();
    let variance = |((pixel, shown), variance): ((&Halves, Shown), f32)| {
        let most = goal.at(shown.value, 2.0 * LENIENCE[0]);
        let count = pixel.count.max(1) as f32;
        // Pixels far above the target with the maximum samples are glints, which smoothing would
        // turn into squares.
        if shown.variance / count > most * most { 0.0 } else { variance / count }
    };
    let about = shown_of(pixels, columns, goal.shown);
    let variances: Vec<_> =
        pixels.iter().zip(about).zip(averaged(&own, columns, REACH)).map(variance).collect();
    non_local_means::Halves { columns, halves: &halves, variances: &variances }.smoothed(watch)
}

/// Returns the samples of every pixel.
fn sampled(
    Sampling { width, height, seed, .. }: Sampling,
    goal: &Goal,
    watch: Watch<'_>,
    radiance: impl Fn(f32, f32, &mut Sampler) -> Vec3 + Sync,
) -> Result<Vec<Halves>, Failure> {
    let [least, most] = goal.samples.map(|count| count.div_ceil(2).max(1));
    let columns = width as usize;
    let mut pixels = vec![Halves::default(); columns * height as usize];
    let mut wanted = vec![least; pixels.len()];
    while pixels.iter().zip(&wanted).any(|(pixel, &wanted)| pixel.count < wanted) {
        each_row(&mut pixels, columns, watch, |y, row| {
            for (x, (pixel, &wanted)) in row.iter_mut().zip(&wanted[y * columns..]).enumerate() {
                let (x, y) = (x as u32, y as u32);
                let hashed = [0, 1].map(|half| pixel_hash(x, y, pixel_hash(seed, half, 0)));
                for k in pixel.count..wanted {
                    for (sum, hashed) in pixel.sums.iter_mut().zip(hashed) {
                        let mut sampler = Sampler::new(k, hashed);
                        let place = sampler.point();
                        *sum += radiance(x as f32 + place.x, y as f32 + place.y, &mut sampler);
                    }
                }
                pixel.count = pixel.count.max(wanted);
            }
        })?;
        let enough = enough(&pixels, columns, goal, most.max(least));
        for ((pixel, wanted), enough) in pixels.iter().zip(&mut wanted).zip(enough) {
            *wanted = enough.min(pixel.count.saturating_mul(GROWTH)).max(pixel.count);
        }
    }
    Ok(pixels)
}

/// Returns the number of samples in each half of every pixel that reaches the target, at most
/// `most`.
fn enough(pixels: &[Halves], columns: usize, goal: &Goal, most: u32) -> Vec<u32> {
    let about = shown_of(pixels, columns, goal.shown);
    let counts = |lenience: f32| {
        pixels.iter().zip(&about).map(move |(pixel, shown)| {
            let error = goal.at(shown.value, lenience);
            ((shown.variance / (error * error)).ceil() as u32).clamp(pixel.count, most)
        })
    };
    let misses = |lenience: &f32| {
        median(counts(*lenience).zip(&about).map(|(count, shown)| shown.error(count))) > goal.of_samples()
    };
    let lenience = LENIENCE.get(LENIENCE.partition_point(misses)).copied().unwrap_or(1.0);
    counts(lenience).collect()
}

/// Displayed luminance around a pixel.
struct Shown {
    value: f32,
    /// Its variance with one sample in each half.
    variance: f32,
}

impl Shown {
    /// Returns the relative standard error with `count` samples in each half.
    fn error(&self, count: u32) -> f32 {
        (self.variance / count.max(1) as f32).sqrt() / self.value
    }
}

fn shown_of(pixels: &[Halves], columns: usize, curve: fn(f32) -> f32) -> Vec<Shown> {
    let (variances, means) = pooled(pixels, columns);
    let shown = |(variance, mean): (f32, f32)| Shown {
        value: curve(mean),
        variance: 0.5 * KEPT * variance * slope(curve, mean).powi(2),
    };
    variances.into_iter().zip(means).map(shown).collect()
}

/// Returns the relative standard errors of the displayed luminance of the mean of two images.
fn errors(halves: &[Image; 2], curve: fn(f32) -> f32) -> Vec<f32> {
    let pairs =
        || halves[0].pixels.iter().zip(&halves[1].pixels).map(|(a, b)| [luminance(*a), luminance(*b)]);
    let columns = halves[0].width as usize;
    let variances: Vec<_> = pairs().map(|[a, b]| 0.25 * (a - b) * (a - b)).collect();
    let means: Vec<_> = pairs().map(|[a, b]| 0.5 * (a + b)).collect();
    let error = |(variance, mean): (f32, f32)| variance.sqrt() * slope(curve, mean) / curve(mean);
    averaged(&variances, columns, REACH).into_iter().zip(averaged(&means, columns, 1)).map(error).collect()
}

/// Returns the slope of a curve at a luminance, over a tenth of it. Where the curve saturates,
/// errors are invisible.
fn slope(shown: fn(f32) -> f32, luminance: f32) -> f32 {
    let step = 0.05 * luminance.max(1e-4);
    (shown(luminance + step) - shown(luminance - step)) / (2.0 * step)
}

/// Returns the median of the nonzero errors.
fn median(errors: impl Iterator<Item = f32>) -> f32 {
    let mut errors: Vec<f32> = errors.filter(|error| error.is_finite() && *error > 0.0).collect();
    let middle = errors.len() / 2;
    if errors.is_empty() { 0.0 } else { *errors.select_nth_unstable_by(middle, f32::total_cmp).1 }
}

/// Applies the reconstruction filter, with clamped borders.
fn reconstructed(image: &Image) -> Image {
    let along = |image: &Image, [dx, dy]: [u32; 2]| {
        let at = |x: u32, y: u32| {
            let [x, y] = [x.min(image.width - 1), y.min(image.height - 1)];
            image.pixels[(y * image.width + x) as usize]
        };
        Image::from_fn(image.width, image.height, |x, y| {
            let beside = at(x.saturating_sub(dx), y.saturating_sub(dy)) + at(x + dx, y + dy);
            FILTER[0] * at(x, y) + FILTER[1] * beside
        })
    };
    along(&along(image, [1, 0]), [0, 1])
}

/// Returns the variance of a sample and the mean luminance around every pixel.
fn pooled(pixels: &[Halves], columns: usize) -> (Vec<f32>, Vec<f32>) {
    let variances = pixels.iter().map(Halves::variance).collect::<Vec<_>>();
    let means = pixels.iter().map(|pixel| luminance(pixel.mean())).collect::<Vec<_>>();
    (averaged(&variances, columns, REACH), averaged(&means, columns, 1))
}

/// Returns means over squares of pixels, clipped to the image.
fn averaged(values: &[f32], columns: usize, reach: usize) -> Vec<f32> {
    let along = |values: &[f32], count: usize, step: usize, index: usize| {
        let place = index / step % count;
        let range = place.saturating_sub(reach)..=(place + reach).min(count - 1);
        let sum: f32 = range.clone().map(|other| values[index - place * step + other * step]).sum();
        sum / range.count() as f32
    };
    let rows = values.len() / columns.max(1);
    let across: Vec<f32> = (0..values.len()).map(|index| along(values, columns, 1, index)).collect();
    (0..values.len()).map(|index| along(&across, rows, columns, index)).collect()
}

impl Scene<'_, '_> {
    /// Renders linear radiance until the noise target is reached.
    pub fn draw_until(
        &self,
        sampling: Sampling,
        goal: &Goal,
        camera: &Camera,
        watch: Watch<'_>,
    ) -> Result<(Image, Grain), Failure> {
        let camera = camera.about(self.focus);
        render_until(sampling, goal, watch, |x, y, sampler| {
            let place = [x / sampling.width as f32, y / sampling.height as f32];
            self.seen(&camera.ray(x, y), place, sampler).radiance
        })
    }
}

#[cfg(test)]
mod tests {
    use asperity_shading::Lambert;

    use super::*;
    use crate::{
        light::environments::Studio,
        sampling::sampler::hash,
        scene::{Backdrop, Light},
        scenes::{PLAIN, Set, backdrop},
    };

    const SIDE: u32 = 32;

    const SAMPLING: Sampling = Sampling { width: SIDE, height: SIDE, samples_per_pixel: 1024, seed: 3 };

    /// Light that few samples hit on the left and all on the right, with a mean of 1 on both sides.
    fn speckled(x: f32, _: f32, sampler: &mut Sampler) -> Vec3 {
        // Without stratification, like hashed points.
        let bits = sampler.point().to_array().map(f32::to_bits);
        let [u, v] = [0, 1].map(|k| (hash(bits[k] ^ hash(bits[1 - k])) >> 8) as f32 / 16_777_216.0);
        let share = if x < 20.0 { 0.02 } else { 1.0 };
        Vec3::splat(if u < share { (0.5 + v) / share } else { 0.0 })
    }

    fn sampled_by(
        goal: &Goal,
        threads: usize,
        radiance: impl Fn(f32, f32, &mut Sampler) -> Vec3 + Sync + Send,
    ) -> Vec<Halves> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| sampled(SAMPLING, goal, Watch::unseen(), radiance)).unwrap()
    }

    #[test]
    fn reported_error_matches_error_against_the_limit() {
        let studio = Studio::new(1.0);
        let chalk = Lambert::new(Vec3::splat(0.5)).unwrap();
        let objects = Set::Sphere.objects(Box::new(chalk), PLAIN).unwrap();
        let scene = Scene::new(objects, Light::Around(&studio), Backdrop::Color(backdrop()));
        let camera = Set::Sphere.view().camera(1.0, SAMPLING);
        let limit = scene.draw(SAMPLING, &camera, Watch::unseen()).unwrap();
        let limit = reconstructed(&limit).pixels;
        let mut told_medians = Vec::new();
        for detail in [Detail::Fine, Detail::Coarse] {
            let goal = Goal { error: 0.05, shown: |x| x, dark: 0.0, samples: [4, 256], detail };
            let radiance =
                |x, y, sampler: &mut Sampler| scene.seen(&camera.ray(x, y), [0.0; 2], sampler).radiance;
            let pixels = sampled_by(&goal, 2, radiance);
            let halves = pictures(&pixels, [SIDE; 2], &goal, Watch::unseen()).unwrap();
            let (told, pixels) = (errors(&halves, goal.shown), mean(&halves).pixels);
            told_medians.push(median(told.iter().copied()));
            let pairs = pixels.iter().zip(&limit).zip(told).filter(|(_, told)| *told > 0.0);
            let mut ratios: Vec<f32> = pairs
                .map(|((pixel, limit), told)| (luminance(*pixel) / luminance(*limit) - 1.0).abs() / told)
                .collect();
            ratios.sort_by(f32::total_cmp);
            assert!(ratios.len() > 700);
            // Half of all Gaussian errors are below 0.674 of their deviation.
            let median = ratios[ratios.len() / 2];
            assert!((0.5..0.85).contains(&median), "{detail:?}: half are below {median} of what is told");
        }
        // Neighbors more than compensate for few samples.
        assert!(told_medians[1] < told_medians[0], "{told_medians:?}");
    }

    #[test]
    fn sample_count_just_reaches_the_target() {
        // Light of mean 1 whose deviation increases to the right.
        let rising = |scale: f32| {
            move |x: f32, y: f32, sampler: &mut Sampler| {
                let deviation = scale * (x / SIDE as f32).powi(3);
                Vec3::splat(1.0 + deviation * (speckled(x.max(20.0), y, sampler).x - 1.0) * 12.0_f32.sqrt())
            }
        };
        // In the middle eight samples have a filtered error of 0.026 times the scale. Half of the
        // pixels need no more, or nearly all do.
        for (scale, even) in [(1.5, false), (8.0, true)] {
            let goal =
                Goal { error: 0.05, shown: |x| x, dark: 0.0, samples: [8, 1 << 16], detail: Detail::Fine };
            let pixels = sampled_by(&goal, 2, rising(scale));
            let shown = shown_of(&pixels, SIDE as usize, goal.shown);
            let errors = pixels.iter().zip(shown).map(|(pixel, shown)| shown.error(pixel.count));
            let mut errors: Vec<f32> = errors.filter(|error| *error > 0.0).collect();
            errors.sort_by(f32::total_cmp);
            // Among the noisiest pixels except a few.
            let most = errors[errors.len() * 9 / 10] / goal.error;
            let median = errors[errors.len() / 2] / goal.error;
            let range = if even { 0.8..1.05 } else { 0.0..1.0 };
            assert!(range.contains(&median), "{median}, {most}");
            // At least a tenth of the pixels have the maximum number.
            assert!((1.65..2.2).contains(&most), "{median}, {most}");
        }
    }

    #[test]
    fn unlucky_dark_pixels_still_get_samples() {
        let goal = Goal { error: 0.25, shown: |x| x, dark: 0.0, samples: [4, 4096], detail: Detail::Fine };
        let pixels = sampled_by(&goal, 2, speckled);
        let counts = |left: bool| {
            let own =
                pixels.iter().zip(0..).filter(|(_, k)| (k % SIDE < 10) == left && (k % SIDE > 22) != left);
            own.map(|(pixel, _)| f64::from(2 * pixel.count)).collect::<Vec<_>>()
        };
        let [left, right] = [true, false].map(counts);
        // A sample's variance is ((0.5 + v)² over v)/0.02 − 1 = 53: 16 times that for an error of a
        // quarter, of which the filter keeps 0.35.
        let mean = left.iter().sum::<f64>() / left.len() as f64;
        assert!((200.0..500.0).contains(&mean), "{mean}");
        assert!(left.iter().all(|&count| count > 60.0), "{left:?}");
        assert!(right.iter().all(|&count| count == 4.0), "{right:?}");
    }

    #[test]
    fn glints_survive_next_to_smoothed_noise() {
        let goal = Goal { error: 0.05, shown: |x| x, dark: 0.0, samples: [8, 8], detail: Detail::Coarse };
        let pixels = sampled_by(&goal, 2, speckled);
        let [own, shared] = [Detail::Fine, Detail::Coarse].map(|detail| {
            smoothed(&pixels, SIDE as usize, &Goal { detail, ..goal }, Watch::unseen()).unwrap()
        });
        let columns = |range: std::ops::Range<u32>| {
            let own = own.iter().zip(&shared).zip(0..).filter(move |(_, k)| range.contains(&(k % SIDE)));
            own.map(|(pair, _)| pair)
        };
        // Errors are 1.5 on the left and 0.06 on the right. Errors up to 0.25 are removed.
        assert!(columns(0..14).all(|(own, shared)| own == shared));
        let deviation = |of: fn(&([Vec3; 2], [Vec3; 2])) -> f32| {
            columns(24..SIDE).map(|(own, shared)| of(&(*own, *shared)).powi(2)).sum::<f32>().sqrt()
        };
        let [before, after] =
            [deviation(|(own, _)| own[0].x - 1.0), deviation(|(_, shared)| shared[0].x - 1.0)];
        assert!(after < 0.5 * before, "{after} of {before}");
    }

    #[test]
    fn filter_keeps_the_mean_and_its_variance_fraction() {
        let noise = |x: u32, y: u32| (hash(x ^ hash(y)) >> 8) as f32 / 16_777_216.0 - 0.5;
        let image = reconstructed(&Image::from_fn(128, 128, |x, y| Vec3::splat(noise(x, y))));
        let variance = image.pixels.iter().map(|p| p.x * p.x).sum::<f32>() / 16_384.0;
        // 16384 squares of 7 dependent each: three standard errors are 6 %.
        assert!((variance * 12.0 / KEPT - 1.0).abs() < 0.06, "{variance}");
        assert!(
            reconstructed(&Image::from_fn(9, 9, |_, _| Vec3::ONE)).pixels.iter().all(|p| *p == Vec3::ONE)
        );
    }

    #[test]
    fn image_is_independent_of_threads_and_within_sample_bounds() {
        let goal = Goal { error: 0.1, shown: |x| x, dark: 0.0, samples: [6, 64], detail: Detail::Fine };
        let [one, three] = [1, 3].map(|threads| sampled_by(&goal, threads, speckled));
        assert!(one.iter().zip(&three).all(|(a, b)| a.sums == b.sums && a.count == b.count));
        assert!(one.iter().all(|pixel| (3..=32).contains(&pixel.count)));
    }
}
