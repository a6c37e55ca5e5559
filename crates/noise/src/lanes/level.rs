//! The SIMD levels of batches.

use core::fmt;

#[cfg(not(all(
    feature = "simd",
    any(target_arch = "x86", target_arch = "x86_64"),
    target_feature = "sse2"
)))]
use asperity_core::lanes::Scalar;
#[cfg(feature = "simd")]
use asperity_core::lanes::best_level;
use asperity_core::lanes::{Lanes, Task};

/// A set of SIMD instructions.
///
/// ```
/// use asperity_noise::simd::Level;
///
/// assert!(Level::available().any(|level| level == Level::best()));
/// assert_eq!(Level::available().last(), Some(Level::best()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Level {
    /// One point at a time. A batch of this level uses the four lanes of the baseline if the
    /// baseline has lanes.
    Scalar,
    /// Four lanes, the minimum of x86-64. SSE4.2, for machines before 2013, has no separate level.
    Sse2,
    /// Eight lanes, x86-64-v3.
    Avx2,
    /// Sixteen lanes, available from Ice Lake on.
    Avx512,
    /// Four lanes on 64-bit Arm.
    Neon,
    /// Four lanes on WebAssembly.
    Wasm128,
}

impl Level {
    const ALL: [Self; 6] = [Self::Scalar, Self::Sse2, Self::Avx2, Self::Avx512, Self::Neon, Self::Wasm128];

    /// Returns the best level of this machine.
    ///
    /// Without `std` it is the best level that the program is compiled for; without `simd`,
    /// [`Level::Scalar`].
    #[must_use]
    pub fn best() -> Self {
        Self::available().last().unwrap_or(Self::Scalar)
    }

    /// Iterates over all levels of this machine, in ascending order.
    pub fn available() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|level| level.is_available())
    }

    /// Returns whether this machine has the level.
    #[must_use]
    pub fn is_available(self) -> bool {
        #[cfg(feature = "simd")]
        return self == Self::Scalar || self.token().is_some();
        #[cfg(not(feature = "simd"))]
        return self == Self::Scalar;
    }

    /// Returns the level's name in lower case, for instance `sse2` or `avx2`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            Self::Sse2 => "sse2",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
            Self::Neon => "neon",
            Self::Wasm128 => "wasm128",
        }
    }

    /// A token that proves that the machine has the level.
    #[cfg(feature = "simd")]
    #[inline]
    fn token(self) -> Option<fearless_simd::Level> {
        let best = best_level();
        match self {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Sse2 => best.as_sse2().map(fearless_simd::Level::Sse2),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Avx2 => best.as_avx2().map(fearless_simd::Level::Avx2),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Avx512 => best.as_avx512().map(fearless_simd::Level::Avx512),
            #[cfg(target_arch = "aarch64")]
            Self::Neon => best.as_neon().map(fearless_simd::Level::Neon),
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Self::Wasm128 => best.as_wasm_simd128().map(fearless_simd::Level::WasmSimd128),
            _ => {
                // Used on some architectures only.
                let _ = best;
                None
            }
        }
    }

    /// The instructions of the level, or single lanes if the machine does not have it.
    #[inline]
    pub(crate) fn instructions(self) -> Instructions {
        Instructions {
            #[cfg(feature = "simd")]
            token: self.token(),
        }
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Whether values are evaluated without gradients.
///
/// On x86 processors without AVX2 they are not, although they would be 1.2 times as fast, because
/// each variant of a kind takes time to compile.
#[must_use]
pub(crate) const fn has_values_alone<S: Lanes>() -> bool {
    S::LEN != 4 || !cfg!(any(target_arch = "x86", target_arch = "x86_64"))
}

/// A token that proves that the machine has a level, obtained once for all rows of a batch.
#[derive(Clone, Copy, Debug)]
pub struct Instructions {
    #[cfg(feature = "simd")]
    token: Option<fearless_simd::Level>,
}

/// Runs the work of a single point, which fills at most four or eight lanes; `None` if there is
/// only one lane.
///
/// On x86 it uses AVX2 only, since each level takes time to compile for every noise, and few
/// processors lack AVX2. Never inlined: a program calls each sum in many places, and the called
/// code runs once.
#[inline(never)]
pub(crate) fn run_at_point(task: impl Task<Output = ()>) -> Option<()> {
    #[cfg(not(feature = "simd"))]
    drop(task);
    #[cfg(all(feature = "simd", any(target_arch = "x86", target_arch = "x86_64")))]
    return best_level().as_avx2().map(|simd| at(simd, task));
    #[cfg(all(feature = "simd", not(any(target_arch = "x86", target_arch = "x86_64"))))]
    if !best_level().is_fallback() {
        return Some(asperity_core::lanes::run_at(best_level(), task));
    }
    #[cfg(not(all(feature = "simd", any(target_arch = "x86", target_arch = "x86_64"))))]
    None
}

/// Runs a task with the instructions of a level.
#[cfg(all(feature = "simd", any(target_arch = "x86", target_arch = "x86_64")))]
#[inline(always)]
fn at<T: Task>(simd: impl fearless_simd::Simd, task: T) -> T::Output {
    simd.vectorize(
        #[inline(always)]
        || task.run(asperity_core::lanes::Registers::new(simd)),
    )
}

impl Instructions {
    /// Whether a register holds sixteen numbers.
    pub(crate) fn are_wide(self) -> bool {
        #[cfg(all(feature = "simd", any(target_arch = "x86", target_arch = "x86_64")))]
        return self.token.is_some_and(|level| level.as_avx512().is_some());
        #[cfg(not(all(feature = "simd", any(target_arch = "x86", target_arch = "x86_64"))))]
        false
    }

    /// Runs a task at the level, or at the next lower level that tasks are compiled for: on x86 the
    /// baseline, AVX2 or AVX-512.
    #[inline(always)]
    pub(crate) fn run(self, task: impl Task<Output = ()>) {
        #[cfg(all(feature = "simd", any(target_arch = "x86", target_arch = "x86_64")))]
        if let Some(simd) = self.token.and_then(fearless_simd::Level::as_avx512) {
            return at(simd, task);
        }
        self.run_in_eight(task);
    }

    /// Runs a task at the level or below it, in at most eight lanes.
    #[cfg(all(feature = "simd", any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
    #[inline(always)]
    pub(crate) fn run_in_eight<T: Task>(self, task: T) -> T::Output
    where
        T::Output: Default,
    {
        let level = self.token.unwrap_or(fearless_simd::Level::baseline());
        match (level.as_avx2(), level.as_sse2()) {
            (Some(simd), _) => at(simd, task),
            (None, Some(simd)) => at(simd, task),
            (None, None) => T::Output::default(),
        }
    }

    /// Runs a task.
    #[cfg(not(all(
        feature = "simd",
        any(target_arch = "x86", target_arch = "x86_64"),
        target_feature = "sse2"
    )))]
    #[inline(always)]
    pub(crate) fn run_in_eight<T: Task>(self, task: T) -> T::Output {
        #[cfg(feature = "simd")]
        if let Some(level) = self.token {
            return asperity_core::lanes::run_at(level, task);
        }
        task.run(Scalar)
    }
}

/// Four lanes of the level that the program is compiled for, which a single call may use.
#[cfg(all(
    feature = "simd",
    any(
        target_arch = "x86",
        target_arch = "x86_64",
        target_arch = "aarch64",
        all(target_arch = "wasm32", target_feature = "simd128")
    )
))]
macro_rules! four {
    ($level:ty, $token:ident) => {
        #[inline(always)]
        pub(crate) fn four() -> Option<asperity_core::lanes::Registers<$level>> {
            fearless_simd::Level::baseline().$token().map(asperity_core::lanes::Registers::new)
        }
    };
}

#[cfg(all(feature = "simd", any(target_arch = "x86", target_arch = "x86_64")))]
four!(fearless_simd::x86::Sse2, as_sse2);
#[cfg(all(feature = "simd", target_arch = "aarch64"))]
four!(fearless_simd::aarch64::Neon, as_neon);
#[cfg(all(feature = "simd", target_arch = "wasm32", target_feature = "simd128"))]
four!(fearless_simd::wasm32::WasmSimd128, as_wasm_simd128);

/// Four lanes of the level that the program is compiled for: `None` if the architecture has no SIMD
/// level.
#[cfg(all(
    feature = "simd",
    not(any(
        target_arch = "x86",
        target_arch = "x86_64",
        target_arch = "aarch64",
        all(target_arch = "wasm32", target_feature = "simd128")
    ))
))]
#[inline(always)]
pub(crate) fn four() -> Option<Scalar> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn levels_have_distinct_names_and_ascend_from_the_baseline() {
        let names = Level::ALL.map(|level| level.to_string());
        assert_eq!(names, ["scalar", "sse2", "avx2", "avx512", "neon", "wasm128"]);
        assert!(Level::Scalar.is_available());
        assert_eq!(Level::available().last(), Some(Level::best()));
        // No machine has the instructions of two of them.
        let families = [Level::Sse2, Level::Neon, Level::Wasm128];
        assert!(families.into_iter().filter(|level| level.is_available()).count() <= 1);
    }
}
