//! `simdnoise`: simplex and cellular noise for SSE2, SSE4.1 and AVX2; every block allocates a new
//! vector.
#![expect(unsafe_code, reason = "its functions for one instruction set are unsafe to call")]

use std::arch::x86_64;

use simdnoise::{NoiseBuilder, NoiseType, avx2, scalar, sse2, sse41};

use crate::{
    arrays,
    inputs::{self, Grid, SEED},
    measure::Contender,
    row::{Kind, Order, Row},
    scalar::values,
};

const NAME: &str = "simdnoise";

pub(crate) fn contenders(row: Row, step: f32) -> Vec<Contender> {
    match row.dimension {
        _ if row.kind == Kind::Cellular && row.order != Order::Grid => Vec::new(),
        _ if !matches!(row.kind, Kind::Simplex | Kind::Cellular) => Vec::new(),
        _ if row.order == Order::Calls => calls(row, step).into_iter().collect(),
        2 => levels().map(|level| contender::<2>(row, step, level)).collect(),
        3 => levels().map(|level| contender::<3>(row, step, level)).collect(),
        _ => Vec::new(),
    }
}

fn levels() -> impl Iterator<Item = &'static str> {
    let levels = [
        ("sse2", is_x86_feature_detected!("sse2")),
        ("sse4.1", is_x86_feature_detected!("sse4.1")),
        ("avx2", is_x86_feature_detected!("avx2")),
    ];
    levels.into_iter().filter_map(|(level, there)| there.then_some(level))
}

fn calls(row: Row, step: f32) -> Option<Contender> {
    match row.dimension {
        2 => Some(values(NAME, row, step, |[x, y]: [f32; 2]| {
            // SAFETY: plain arithmetic on floats, without special instructions.
            unsafe { scalar::simplex_2d(x, y, SEED as i32) }
        })),
        3 => Some(values(NAME, row, step, |[x, y, z]: [f32; 3]| {
            // SAFETY: as above.
            unsafe { scalar::simplex_3d(x, y, z, SEED as i32) }
        })),
        4 => Some(values(NAME, row, step, |[x, y, z, w]: [f32; 4]| {
            // SAFETY: as above.
            unsafe { scalar::simplex_4d(x, y, z, w, SEED as i32) }
        })),
        _ => None,
    }
}

fn contender<const N: usize>(row: Row, step: f32, level: &'static str) -> Contender {
    if row.order == Order::Grid {
        let grid = Grid::<N>::new(step);
        return arrays::contender(NAME, level, row, move |moved, values| {
            *values = block::<N>(level, &settings(row.kind, &grid.moved(moved)));
        });
    }
    let points = inputs::points::<N>();
    // SAFETY: `levels` contains only levels of this processor, and the arrays of points and values
    // have equal lengths.
    arrays::contender(NAME, level, row, move |moved, values| unsafe {
        match level {
            "avx2" => fill_avx2(&points, moved, values),
            "sse4.1" => fill_sse41(&points, moved, values),
            _ => fill_sse2(&points, moved, values),
        }
    })
}

/// Its grids have step 1 and are scaled by the frequency afterward.
fn settings<const N: usize>(kind: Kind, grid: &Grid<N>) -> NoiseType {
    let at = |axis: usize| grid.origin[axis] / grid.step;
    if kind == Kind::Cellular {
        // The squared Euclidean distance, which the library calls Euclidean.
        let mut settings = if N == 2 {
            NoiseBuilder::cellular_2d_offset(at(0), grid.size[0], at(1), grid.size[1])
        } else {
            NoiseBuilder::cellular_3d_offset(at(0), grid.size[0], at(1), grid.size[1], at(2), grid.size[2])
        };
        settings.with_freq(grid.step).with_seed(SEED as i32);
        return settings.wrap();
    }
    let mut settings = if N == 2 {
        NoiseBuilder::gradient_2d_offset(at(0), grid.size[0], at(1), grid.size[1])
    } else {
        NoiseBuilder::gradient_3d_offset(at(0), grid.size[0], at(1), grid.size[1], at(2), grid.size[2])
    };
    settings.with_freq(grid.step).with_seed(SEED as i32);
    settings.wrap()
}

fn block<const N: usize>(level: &str, settings: &NoiseType) -> Vec<f32> {
    // SAFETY: `levels` contains only levels of this processor.
    unsafe {
        match (level, N) {
            ("avx2", 2) => avx2::get_2d_noise(settings).0,
            ("avx2", _) => avx2::get_3d_noise(settings).0,
            ("sse4.1", 2) => sse41::get_2d_noise(settings).0,
            ("sse4.1", _) => sse41::get_3d_noise(settings).0,
            (_, 2) => sse2::get_2d_noise(settings).0,
            (_, _) => sse2::get_3d_noise(settings).0,
        }
    }
}

macro_rules! fill {
    ($name:ident, $feature:literal, $module:ident, $load:ident, $add:ident, $splat:ident, $store:ident, $lanes:literal) => {
        /// Loads, shifts, evaluates and stores a register at a time; `POINTS` is a multiple of its
        /// width.
        #[target_feature(enable = $feature)]
        unsafe fn $name<const N: usize>(points: &[Vec<f32>; N], moved: [f32; N], values: &mut [f32]) {
            for start in (0..values.len()).step_by($lanes) {
                // SAFETY: `start` is a multiple of the width and less than the length, which is
                // also a multiple of the width.
                unsafe {
                    let at = |axis: usize| {
                        x86_64::$add(
                            x86_64::$load(points[axis].as_ptr().add(start)),
                            x86_64::$splat(moved[axis]),
                        )
                    };
                    let value = if N == 2 {
                        $module::simplex_2d(at(0), at(1), SEED as i32)
                    } else {
                        $module::simplex_3d(at(0), at(1), at(2), SEED as i32)
                    };
                    x86_64::$store(values.as_mut_ptr().add(start), value);
                }
            }
        }
    };
}

fill!(fill_sse2, "sse2", sse2, _mm_loadu_ps, _mm_add_ps, _mm_set1_ps, _mm_storeu_ps, 4);
fill!(fill_sse41, "sse4.1", sse41, _mm_loadu_ps, _mm_add_ps, _mm_set1_ps, _mm_storeu_ps, 4);
fill!(fill_avx2, "avx2", avx2, _mm256_loadu_ps, _mm256_add_ps, _mm256_set1_ps, _mm256_storeu_ps, 8);
