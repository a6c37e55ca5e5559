//! Reconstruction of an NDF between the texels of a map.

/// Reconstruction of an NDF between the texels of a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Reconstruction {
    /// Constant on each texel.
    #[default]
    Constant,
    /// Bilinear between the centers of texels; the outermost values extend to the border.
    Bilinear,
}

impl Reconstruction {
    /// Distance, in cells, of the first line of the reconstruction grid before the border of the
    /// map.
    pub(crate) const fn offset(self) -> f64 {
        match self {
            Self::Constant => 0.0,
            Self::Bilinear => 0.5,
        }
    }

    /// Number of cells of the reconstruction grid on a map of `n` texels.
    pub(crate) const fn cells(self, n: usize) -> usize {
        match self {
            Self::Constant => n,
            Self::Bilinear => n + 1,
        }
    }

    /// Number of columns of values at the sides of a cell.
    pub(crate) const fn sides(self) -> usize {
        match self {
            Self::Constant => 1,
            Self::Bilinear => 2,
        }
    }

    #[cfg(feature = "alloc")]
    /// Position of line `k` of the grid on a map of `n` texels.
    pub(crate) fn line(self, k: usize, n: usize) -> f64 {
        (k as f64 - self.offset()) / n as f64
    }

    #[cfg(feature = "alloc")]
    /// The cell that contains `x`, consistent with the lines of [`Reconstruction::line`].
    pub(crate) fn cell(self, x: f64, n: usize) -> usize {
        let last = self.cells(n) - 1;
        let k = ((x * n as f64 + self.offset()) as usize).min(last);
        // The product may round across a line: just below 4/6 it is 4, and 15/22 times 22 is below
        // 15.
        if k > 0 && x < self.line(k, n) {
            k - 1
        } else if k < last && x >= self.line(k + 1, n) {
            k + 1
        } else {
            k
        }
    }
}
