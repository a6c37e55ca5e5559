//! An isotropic NDF from a table over the cosine.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use core::f64::consts::PI;
use core::ops::Deref;

use glam::{Vec2, Vec3};

use crate::coordinates::bounded;
use crate::density::isotropic_cell::{Cell, invert};
use crate::density::mixture::{tilted, untilted};
use crate::error::{IS_DENSITY, NdfError};
use crate::ndf::Ndf;
use crate::radial::Radial;
use crate::storage::Entries;
use asperity_core::math;

/// The maximum number of nodes of a table.
const MAX_NODES: usize = 1 << 20;

/// The numbers of a node: its density, and the CDF at the node in two parts.
const PER_NODE: usize = 3;

/// The density at a node, and the CDF there in two parts.
pub(crate) type Node = [f32; PER_NODE];

/// An isotropic NDF that is linear between the nodes of a table over `cos θ`.
///
/// ```text
/// D(m) = d_i + (d_{i+1} − d_i) x   for  cos θ = (i + x)/n,  i in 0..n,  x in [0, 1]             in sr⁻¹
/// C(c) = 2π ∫₀^c D t dt,   T(z): C(cos θ) = exp(−ρ²/2), direction of z,   ρ² = z₁² + z₂²
/// ```
///
/// `C` is a cubic between nodes. It is evaluated and inverted exactly, by bisection over the nodes
/// and Newton's method in the cell, so a sample costs O(log n). The nodes are equally spaced in
/// `cos θ`. Near the zenith this is a tilt of `√(2/n)`, so lobes narrower than a few such tilts
/// need another NDF or [`NdfMap`](crate::NdfMap).
///
/// - **Storage:** three numbers per node, owned or, as `Isotropic<&[_]>`, borrowed, e.g. in flash.
/// - **Masking and visible normals:** by [`Masked`](crate::Masked).
/// - **Domain:** unit `m`, only its slope matters; `D = 0` for `m.z ≤ 0` and NaN.
/// - **Accuracy:** `C` 1e-14; `T⁻¹(T(z)) = z` within 1e-5 where the density is not 0.
///
/// Kautz, Heidrich, Seidel 2001, section 4, in the radial case, with one table instead of two.
///
/// ```
/// use asperity_ndf_sampling::{Isotropic, Ndf, glam::Vec2};
///
/// let mut storage = [0.0; 3 * 3];
/// let table = Isotropic::pack(&[0.0, 0.5, 2.0], &mut storage)?;
/// let z = Vec2::new(0.7, -1.2);
/// assert!(table.invert(table.warp_gaussian(z)).abs_diff_eq(z, 1e-5));
/// # #[cfg(feature = "alloc")]
/// assert_eq!(Isotropic::new(&[0.0, 0.5, 2.0])?.view(), table);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isotropic<S = Entries<Node>> {
    nodes: S,
}

#[cfg(feature = "alloc")]
impl Isotropic<Vec<Node>> {
    /// Creates the NDF proportional to `values` at equally spaced cosines.
    ///
    /// The first value is at the horizon, the last at the zenith.
    ///
    /// # Errors
    /// Fewer than 2 or more than 2²⁰ values; a negative or non-finite value; only zeros. The error
    /// contains the invalid value.
    pub fn new(values: &[f32]) -> Result<Self, NdfError> {
        let mut nodes = alloc::vec![[0.0; PER_NODE]; values.len()];
        Isotropic::pack(values, nodes.as_flattened_mut())?;
        Ok(Self { nodes })
    }

    /// Creates the NDF proportional to `density(cos θ)` at `nodes` cosines from 0 to 1, and linear
    /// between.
    ///
    /// # Errors
    /// See [`new`](Self::new).
    pub fn from_fn(nodes: usize, density: impl Fn(f32) -> f32) -> Result<Self, NdfError> {
        if !(2..=MAX_NODES).contains(&nodes) {
            return Err(nodes_error(nodes));
        }
        let values: Vec<f32> = (0..nodes).map(|k| density(k as f32 / (nodes - 1) as f32)).collect();
        Self::new(&values)
    }
}

impl<'a> Isotropic<&'a [Node]> {
    /// Creates the NDF proportional to `values` at equally spaced cosines in a given `storage`.
    ///
    /// The first value is at the horizon, the last at the zenith. The storage has three numbers per
    /// value.
    ///
    /// # Errors
    /// Fewer than 2 or more than 2²⁰ values; a negative or non-finite value; only zeros; a storage
    /// of another length. The error contains the invalid value.
    pub fn pack(values: &[f32], storage: &'a mut [f32]) -> Result<Self, NdfError> {
        check(values)?;
        if storage.len() != PER_NODE * values.len() {
            return Err(NdfError::Length {
                parameter: "storage",
                expected: PER_NODE * values.len(),
                got: storage.len(),
            });
        }
        let nodes = storage.as_chunks_mut().0;
        fill(values, nodes)?;
        Ok(Self { nodes })
    }

    /// Creates the NDF from a table that [`pack`](Self::pack) filled.
    ///
    /// # Errors
    /// An invalid length; a negative or non-finite density; a CDF that does not increase from 0 to
    /// 1.
    pub fn from_packed(packed: &'a [f32]) -> Result<Self, NdfError> {
        let nodes = packed.len() / PER_NODE;
        if !(2..=MAX_NODES).contains(&nodes) {
            return Err(nodes_error(nodes));
        }
        if !packed.len().is_multiple_of(PER_NODE) {
            return Err(NdfError::Length {
                parameter: "packed",
                expected: PER_NODE * nodes,
                got: packed.len(),
            });
        }
        let mut last = 0.0;
        for (index, &[density, high, low]) in packed.as_chunks::<PER_NODE>().0.iter().enumerate() {
            check_value("packed", PER_NODE * index, density)?;
            let cumulative = f64::from(high) + f64::from(low);
            let rises = cumulative >= last && cumulative <= 1.000_001 && (index > 0 || cumulative == 0.0);
            if !rises || (index + 1 == nodes && cumulative < 0.999_999) {
                return Err(NdfError::Cdf { index });
            }
            last = cumulative;
        }
        Ok(Self { nodes: packed.as_chunks().0 })
    }
}

impl<S: Deref<Target = [Node]>> Isotropic<S> {
    /// The table in borrowed storage.
    #[inline]
    #[must_use]
    pub fn view(&self) -> Isotropic<&[Node]> {
        Isotropic { nodes: &self.nodes }
    }

    /// The packed table: for each node its density and the CDF `C` in two parts.
    #[must_use]
    pub fn packed(&self) -> &[f32] {
        self.nodes.as_flattened()
    }

    /// An upper bound of the density between two cosines.
    #[cfg(feature = "alloc")]
    pub(crate) fn most_between(&self, low: f64, high: f64) -> f32 {
        let cells = self.cells() as f64;
        // One more node, because cosines are rounded.
        let at = |cos: f64| (cos.clamp(0.0, 1.0) * cells) as usize;
        let nodes = at(low - 1e-6)..=at(high + 1e-6) + 1;
        let most = nodes.fold(0.0_f32, |most, k| most.max(self.node(k.min(self.cells())).0));
        most.next_up().min(f32::MAX)
    }

    /// The number of cells.
    #[inline]
    fn cells(&self) -> usize {
        self.nodes.len().saturating_sub(1)
    }

    /// The density and `C` at a node.
    #[inline]
    fn node(&self, index: usize) -> (f32, f64) {
        let [density, high, low] = self.nodes.get(index).copied().unwrap_or([0.0; PER_NODE]);
        (density, f64::from(high) + f64::from(low))
    }

    /// A cell with `C` at its ends.
    #[inline]
    fn cell(&self, index: usize) -> (Cell, f64, f64) {
        let ((low, from), (high, to)) = (self.node(index), self.node(index + 1));
        (Cell::new(index, low, high), from, to)
    }

    /// The exponent at the cosine `1 − d`, given both.
    #[inline]
    fn exponent_at(&self, cos: f64, d: f64) -> f64 {
        let cells = self.cells() as f64;
        let index = ((cos * cells) as usize).min(self.cells().saturating_sub(1));
        let (cell, from, to) = self.cell(index);
        let total = self.node(self.cells()).1;
        let scale = 2.0 * PI / (cells * cells);
        if 2.0 * from > total {
            // From above, which keeps small tilts: the distance to the upper end.
            let y = (d * cells - (cells - 1.0 - index as f64)).clamp(0.0, 1.0);
            -math::ln_1p_f64(-((total - to) + scale * cell.above(y)) / total)
        } else {
            let x = (cos * cells - index as f64).clamp(0.0, 1.0);
            -math::ln_f64((from + scale * cell.below(x)) / total)
        }
    }
}

impl<S: Deref<Target = [Node]>> Ndf for Isotropic<S> {
    #[inline]
    fn d(&self, m: Vec3) -> f32 {
        let (x, y, z) = (f64::from(m.x), f64::from(m.y), f64::from(m.z));
        let cos = z / math::sqrt_f64(x * x + y * y + z * z);
        let at = cos * self.cells() as f64;
        let index = (at as usize).min(self.cells().saturating_sub(1));
        let (low, high) = (f64::from(self.node(index).0), f64::from(self.node(index + 1).0));
        let density = low + (high - low) * (at - index as f64).clamp(0.0, 1.0);
        if m.z > 0.0 && density >= 0.0 { density as f32 } else { 0.0 }
    }

    #[inline]
    fn warp_gaussian(&self, z: Vec2) -> Vec3 {
        let z = bounded(z);
        let (x, y) = (f64::from(z.x), f64::from(z.y));
        let exponent = 0.5 * (x * x + y * y);
        let total = self.node(self.cells()).1;
        let (cumulative, rest) = (total * math::exp_f64(-exponent), -total * math::exp_m1_f64(-exponent));
        // The first cell at whose end the fraction is reached.
        let last = self.cells().saturating_sub(1);
        let reached =
            self.nodes.partition_point(|&[_, high, low]| f64::from(high) + f64::from(low) < cumulative);
        let index = reached.saturating_sub(1).min(last);
        let (cell, from, to) = self.cell(index);
        let cells = self.cells() as f64;
        let scale = 2.0 * PI / (cells * cells);
        // 1 − cos θ, in cells.
        let d = if 2.0 * from > total {
            let y =
                invert(((rest - (total - to)) / scale).max(0.0), |y| (cell.above(y), cell.weight(1.0 - y)));
            (last - index) as f64 + y
        } else {
            let x = invert(((cumulative - from) / scale).max(0.0), |x| (cell.below(x), cell.weight(x)));
            (last - index) as f64 + (1.0 - x)
        } / cells;
        let (cos, sin2) = ((1.0 - d).max(f64::from(f32::MIN_POSITIVE)), d * (2.0 - d));
        if exponent > 0.0 { tilted(z, math::sqrt_f64(sin2) / cos) } else { Vec3::Z }
    }

    #[inline]
    fn invert(&self, m: Vec3) -> Vec2 {
        untilted(m, |slope| self.exponent(slope).unwrap_or(0.0))
    }
}

impl<S: Deref<Target = [Node]>> Radial for Isotropic<S> {
    #[inline]
    fn exponent(&self, slope: f64) -> Option<f64> {
        let cos = 1.0 / math::sqrt_f64(1.0 + slope * slope);
        // 1 − cos θ = sin² θ/(1 + cos θ) without the difference.
        let d = slope * cos * slope * cos / (1.0 + cos);
        Some(if slope < 1e150 { self.exponent_at(cos, d).max(0.0) } else { f64::MAX })
    }
}

const fn nodes_error(value: usize) -> NdfError {
    NdfError::Size { parameter: "nodes", value, min: 2, max: MAX_NODES }
}

fn check_value(parameter: &'static str, index: usize, value: f32) -> Result<(), NdfError> {
    if (0.0..f32::INFINITY).contains(&value) {
        Ok(())
    } else {
        Err(NdfError::Element { parameter, index, value, rule: IS_DENSITY })
    }
}

/// Fills the nodes of a table with checked values.
fn fill(values: &[f32], nodes: &mut [Node]) -> Result<(), NdfError> {
    let cells = (values.len() - 1) as f64;
    let masses = || values.iter().zip(values.iter().skip(1)).enumerate();
    let mass = |(k, (&low, &high)): (usize, (&f32, &f32))| {
        Cell::new(k, low, high).below(1.0) * 2.0 * PI / (cells * cells)
    };
    let total: f64 = masses().map(mass).sum();
    if total <= 0.0 {
        return Err(NdfError::NoWeight { parameter: "values" });
    }
    let mut cumulative = 0.0;
    let mut rest = masses().map(mass);
    for (node, &value) in nodes.iter_mut().zip(values) {
        let high = cumulative as f32;
        *node = [(f64::from(value) / total) as f32, high, (cumulative - f64::from(high)) as f32];
        cumulative = (cumulative + rest.next().unwrap_or(0.0) / total).min(1.0);
    }
    Ok(())
}

/// Checks that `values` are valid densities at the nodes of a table.
fn check(values: &[f32]) -> Result<(), NdfError> {
    if !(2..=MAX_NODES).contains(&values.len()) {
        return Err(nodes_error(values.len()));
    }
    values.iter().enumerate().try_for_each(|(index, &value)| check_value("values", index, value))
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn constant_table_is_the_diffuse_lobe() {
        let (table, diffuse) = (Isotropic::new(&[3.0; 5]).unwrap(), crate::BlinnPhong::new(0.0).unwrap());
        for k in 0..=240 {
            let z = Vec2::new(0.6, -0.8) * (k as f32 * 0.05);
            let m = diffuse.warp_gaussian(z);
            assert_abs_diff_eq!(table.warp_gaussian(z), m, epsilon = 1e-6, "T({z})");
            assert_abs_diff_eq!(table.invert(m), z, epsilon = 2e-5, "T⁻¹({m})");
            assert_abs_diff_eq!(table.d(m) * core::f32::consts::PI, 1.0, epsilon = 1e-6, "{z}");
        }
        let m = table.warp_gaussian(Vec2::new(1e-5, 0.0));
        assert_abs_diff_eq!(m.x / (1e-5 * 0.5_f32.sqrt()), 1.0, epsilon = 1e-5);
    }

    #[test]
    fn round_trip_with_gaps_and_peaks() {
        let ring = Isotropic::new(&[0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0]).unwrap();
        let peak = Isotropic::from_fn(1000, |cos| cos.powi(200) + 0.01).unwrap();
        let spike = Isotropic::new(&[0.0, 0.0, 0.0, 1e-30]).unwrap();
        for table in [&ring, &peak, &spike] {
            let mut last = 1.0;
            for k in 0..=150 {
                let z = Vec2::new(0.6, -0.8) * (k as f32 * 0.03 + 1e-3);
                let m = table.warp_gaussian(z);
                assert_abs_diff_eq!(m.length(), 1.0, epsilon = 1e-6, "{z}");
                assert!(m.z <= last, "{z}: {m}");
                assert_abs_diff_eq!(table.invert(m), z, epsilon = 2e-4, "T⁻¹({m})");
                last = m.z;
            }
        }
    }

    #[test]
    fn packed_tables_are_borrowed() {
        let table = Isotropic::new(&[0.5, 1.0, 4.0]).unwrap();
        let borrowed = Isotropic::from_packed(table.packed()).unwrap();
        assert_eq!(borrowed.packed(), table.packed());
    }
}
