//! FastNoise2: C++ with SIMD, `f32`, hashes; fused multiply-add and relaxed floats where the level
//! supports them.
#![expect(unsafe_code, reason = "a C interface")]

use std::ffi::{CStr, c_void};

use fastnoise2_sys as sys;

use crate::{
    arrays,
    inputs::{self, Grid, SEED},
    measure::Contender,
    row::{Kind, Order, Row},
};

const NAME: &str = "fastnoise2";

/// Returns the library's feature sets supported by this processor, one bit per extension. The
/// library itself does not check.
#[cfg(target_arch = "x86_64")]
fn levels() -> Vec<(&'static str, u32)> {
    // Bits 1 to 13: x86, SSE, SSE2, SSE3, SSSE3, SSE4.1, SSE4.2, AVX, AVX2 and four parts of
    // AVX-512.
    let up_to = |bit: u32| (2 << bit) - 2;
    let avx512 = is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512bw");
    // Its AVX2 code is compiled with fused multiply-add.
    let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    [
        ("sse2", up_to(3), true),
        ("sse4.1", up_to(6), is_x86_feature_detected!("sse4.1")),
        ("avx2", up_to(9), avx2),
        ("avx512", up_to(13), avx512),
    ]
    .into_iter()
    .filter_map(|(level, features, there)| there.then_some((level, features)))
    .collect()
}

/// Returns the library's feature set where NEON is the baseline.
#[cfg(not(target_arch = "x86_64"))]
fn levels() -> Vec<(&'static str, u32)> {
    // Bits 14 to 16: ARM, NEON, AArch64.
    vec![("neon", 0b111 << 14)]
}

pub(crate) fn contenders(row: Row, step: f32) -> Vec<Contender> {
    match row.dimension {
        // A single call of this library traverses a tree of virtual functions and fills a whole
        // register.
        _ if row.order == Order::Calls => Vec::new(),
        2 => levels().into_iter().filter_map(|level| contender::<2>(row, step, level)).collect(),
        3 => levels().into_iter().filter_map(|level| contender::<3>(row, step, level)).collect(),
        _ => Vec::new(),
    }
}

fn contender<const N: usize>(
    row: Row,
    step: f32,
    (level, features): (&'static str, u32),
) -> Option<Contender> {
    let node = Node::of(row.kind, features)?;
    Some(if row.order == Order::Grid {
        let grid = Grid::<N>::new(step);
        arrays::contender(NAME, level, row, move |moved, values| node.fill_grid(&grid.moved(moved), values))
    } else {
        let points = inputs::points::<N>();
        arrays::contender(NAME, level, row, move |moved, values| node.fill_points(&points, moved, values))
    })
}

/// A reference to a generator of the library.
struct Node(*mut c_void);

impl Drop for Node {
    fn drop(&mut self) {
        // SAFETY: the handle came from the library and is released once.
        unsafe { sys::fnDeleteNodeRef(self.0) }
    }
}

impl Node {
    /// Returns the generator at one level, or `None` if the processor or the library's build does
    /// not support it.
    fn of(kind: Kind, features: u32) -> Option<Self> {
        let generator = match kind {
            Kind::Perlin | Kind::Fbm => c"Perlin",
            Kind::Value => c"Value",
            Kind::Simplex => c"Simplex",
            Kind::Cellular => c"Cellular Distance",
        };
        let source = Self::named(generator, features)
            .or_else(|| (kind == Kind::Cellular).then(|| Self::named(c"CellularDistance", features))?)?;
        source.set("Feature Scale", 1.0);
        if kind != Kind::Fbm {
            return Some(source);
        }
        // Gain 0.5 and lacunarity 2 are its defaults.
        let sum = Self::named(c"Fractal FBm", features).or_else(|| Self::named(c"FractalFBm", features))?;
        // SAFETY: both handles are alive. The source is passed as the address of its handle, which
        // is the library's smart pointer representation, and the sum increments its reference
        // count.
        let done = unsafe { sys::fnSetNodeLookup(sum.0, 0, (&raw const source.0).cast()) };
        assert!(done, "FastNoise2: a sum of octaves takes a source");
        sum.set_int("Octaves", 5);
        sum.set("Lacunarity", 2.0);
        Some(sum)
    }

    fn named(name: &CStr, features: u32) -> Option<Self> {
        // SAFETY: names of the library are strings that live as long as the program.
        let id = (0..unsafe { sys::fnGetMetadataCount() })
            .find(|&id| unsafe { CStr::from_ptr(sys::fnGetMetadataName(id)) } == name)?;
        // SAFETY: the number is a valid index of the library.
        let node = Self(unsafe { sys::fnNewFromMetadata(id, features) });
        // SAFETY: the handle is alive where it is not null.
        (!node.0.is_null() && unsafe { sys::fnGetSIMDLevel(node.0) } == features).then_some(node)
    }

    fn variable(&self, name: &str) -> i32 {
        // SAFETY: the handle is alive, the indices are below the count, and the names live as long
        // as the program.
        unsafe {
            let id = sys::fnGetMetadataID(self.0);
            (0..sys::fnGetMetadataVariableCount(id))
                .find(|&index| {
                    CStr::from_ptr(sys::fnGetMetadataVariableName(id, index)).to_bytes() == name.as_bytes()
                })
                .unwrap_or_else(|| panic!("FastNoise2 has no variable `{name}` here"))
        }
    }

    fn set(&self, name: &str, value: f32) {
        let variable = self.variable(name);
        // SAFETY: the handle is alive and the variable belongs to it.
        let done = unsafe { sys::fnSetVariableFloat(self.0, variable, value) };
        assert!(done, "FastNoise2 does not take {value} for `{name}`");
    }

    fn set_int(&self, name: &str, value: i32) {
        let variable = self.variable(name);
        // SAFETY: as for `set`.
        let done = unsafe { sys::fnSetVariableIntEnum(self.0, variable, value) };
        assert!(done, "FastNoise2 does not take {value} for `{name}`");
    }

    fn fill_grid<const N: usize>(&self, grid: &Grid<N>, values: &mut [f32]) {
        assert_eq!(values.len(), grid.samples());
        let size = grid.size.map(|side| side as i32);
        let (o, step, seed, none) = (grid.origin, grid.step, SEED as i32, std::ptr::null_mut());
        let out = values.as_mut_ptr();
        // SAFETY: the array holds the whole grid, and no range is requested.
        unsafe {
            if N == 2 {
                sys::fnGenUniformGrid2D(self.0, out, o[0], o[1], size[0], size[1], step, step, seed, none);
            } else {
                let [x, y, z] = [0, 1, 2].map(|axis| o[axis]);
                let [nx, ny, nz] = [0, 1, 2].map(|axis| size[axis]);
                sys::fnGenUniformGrid3D(self.0, out, x, y, z, nx, ny, nz, step, step, step, seed, none);
            }
        }
    }

    fn fill_points<const N: usize>(&self, points: &[Vec<f32>; N], moved: [f32; N], values: &mut [f32]) {
        assert!(points.iter().all(|axis| axis.len() == values.len()));
        let (count, seed, none) = (values.len() as i32, SEED as i32, std::ptr::null_mut());
        let out = values.as_mut_ptr();
        let at = |axis: usize| points[axis].as_ptr();
        // SAFETY: all arrays hold `count` floats, and no range is requested.
        unsafe {
            if N == 2 {
                sys::fnGenPositionArray2D(self.0, out, count, at(0), at(1), moved[0], moved[1], seed, none);
            } else {
                let [x, y, z] = [0, 1, 2].map(|axis| moved[axis]);
                sys::fnGenPositionArray3D(self.0, out, count, at(0), at(1), at(2), x, y, z, seed, none);
            }
        }
    }
}
