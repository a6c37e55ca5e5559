//! Time per evaluation, value and gradient, of every kind in 2-D and 3-D and of the Gaussian octaves.

use std::{hint::black_box, time::Duration};

use asperity_noise::{
    Gaussian, GaussianOctaves, Kernel, Noise, Octaves, Perlin1985, Perlin2002, PermutationTable, Point,
    Simplex, Spectrum,
    glam::{Vec2, Vec3},
};
use criterion::{
    BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main, measurement::WallTime,
};

/// Evaluations per iteration.
const POINTS: u16 = 1024;

/// Points along a line that crosses a cell boundary every few steps, as a scan line of a picture does.
trait Line<const N: usize>: Point<N> {
    fn line(i: u16) -> Self;
}

impl Line<2> for Vec2 {
    fn line(i: u16) -> Self {
        let t = f32::from(i);
        Self::new(0.3 + 0.21 * t, -7.0 + 0.17 * t)
    }
}

impl Line<3> for Vec3 {
    fn line(i: u16) -> Self {
        let t = f32::from(i);
        Self::new(0.3 + 0.21 * t, -7.0 + 0.17 * t, 2.0 - 0.13 * t)
    }
}

fn along_line<V: Line<N>, T, const N: usize>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    evaluate: impl Fn(V) -> T,
) {
    let points: Vec<V> = (0..POINTS).map(V::line).collect();
    group.throughput(Throughput::Elements(u64::from(POINTS)));
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            for &p in &points {
                black_box(evaluate(black_box(p)));
            }
        });
    });
}

fn kinds<V: Line<N>, const N: usize>(criterion: &mut Criterion, dimension: &str)
where
    Perlin1985: Kernel<N> + Noise<V>,
    Perlin2002: Kernel<N> + Noise<V>,
    Perlin2002<PermutationTable>: Kernel<N> + Noise<V>,
    Simplex: Kernel<N> + Noise<V>,
    Gaussian: Kernel<N> + Noise<V>,
{
    let mut group = criterion.benchmark_group(dimension);
    along_line(&mut group, "perlin-1985", |p: V| Perlin1985::default().sample(p, 1));
    along_line(&mut group, "perlin-2002", |p: V| Perlin2002::default().sample(p, 1));
    along_line(&mut group, "perlin-2002-value", |p: V| Perlin2002::default().value(p, 1));
    let permutation = Perlin2002(PermutationTable::new(1));
    along_line(&mut group, "perlin-2002-permutation", |p: V| permutation.sample(p, 1));
    along_line(&mut group, "simplex-continuous", |p: V| Simplex::CONTINUOUS.sample(p, 1));
    along_line(&mut group, "simplex-wide", |p: V| Simplex::WIDE.sample(p, 1));
    along_line(&mut group, "gaussian", |p: V| Gaussian::default().sample(p, 1));
    along_line(&mut group, "gaussian-value", |p: V| Gaussian::default().value(p, 1));
    along_line(&mut group, "gaussian-pair", |p: V| Gaussian::default().pair(p, 1));
    let octaves = Octaves::<_, N>::new(Perlin2002::default(), Spectrum::default(), Default::default(), 1);
    along_line(&mut group, "perlin-2002-octaves-8", |p: V| octaves.sample(p, 8.0));
    let octaves = GaussianOctaves::<N>::new(Spectrum::default(), 1);
    along_line(&mut group, "gaussian-octaves-8", |p: V| octaves.sample(p, 8.0));
    along_line(&mut group, "gaussian-octaves-8-pair", |p: V| octaves.pair(p, 8.0));
    group.finish();
}

fn benches(criterion: &mut Criterion) {
    kinds::<Vec2, 2>(criterion, "2-d");
    kinds::<Vec3, 3>(criterion, "3-d");
}

criterion_group! {
    name = noise;
    config = Criterion::default().warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    targets = benches
}
criterion_main!(noise);
