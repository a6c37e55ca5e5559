//! A wedge of the hemisphere: an interval of tilts and an interval of azimuths.

use glam::Vec3;

use asperity_core::lanes::Scalar;
use asperity_core::lanes::elementary::cos_sin_turns;
use asperity_core::math;

/// A part of the hemisphere of normals between two tilts and two azimuths.
///
/// It is uniform in `1 − cos θ` and `φ`, like solid angle.
///
/// ```text
/// 1 − cos θ in [tilts₀, tilts₁] of [0, 1],    φ/2π in [turns₀, turns₁] of [−½, ½]
/// ```
///
/// ```
/// use asperity_ndf_sampling::{Bounded, Isotropic, Wedge};
///
/// let table = Isotropic::new(&[0.0, 0.5, 2.0])?;
/// // Between the horizon and 60°, the density is at most the value at 60°.
/// let low = Wedge { tilts: [0.5, 1.0], turns: [-0.5, 0.5] };
/// assert!(table.most(low) <= table.most(Wedge::HEMISPHERE));
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wedge {
    /// `1 − cos θ` at its beginning and end.
    pub tilts: [f64; 2],
    /// The azimuth from x towards y at its beginning and end, in turns.
    pub turns: [f64; 2],
}

impl Wedge {
    /// The whole hemisphere.
    pub const HEMISPHERE: Self = Self { tilts: [0.0, 1.0], turns: [-0.5, 0.5] };

    /// The solid angle.
    pub(crate) fn solid_angle(self) -> f64 {
        core::f64::consts::TAU * (self.tilts[1] - self.tilts[0]) * (self.turns[1] - self.turns[0])
    }

    /// The direction at its center, and the largest angle between it and a direction of the wedge.
    pub(crate) fn center(self) -> (Vec3, f64) {
        let ([low, high], turns) = (self.tilts.map(tilt), self.turns);
        let (middle, half) = (0.5 * (low + high), core::f64::consts::PI * (turns[1] - turns[0]));
        let (sin, cos) = (math::sin_f64(middle), math::cos_f64(middle));
        // The cosine between the center and a direction of the wedge is smallest at the corners.
        let cosine =
            |theta: f64| sin * math::sin_f64(theta) * math::cos_f64(half) + cos * math::cos_f64(theta);
        let reach = math::sqrt_f64((2.0 - 2.0 * cosine(low).min(cosine(high))).max(0.0));
        let azimuth = core::f64::consts::PI * (turns[0] + turns[1]);
        let (x, y) = (sin * math::cos_f64(azimuth), sin * math::sin_f64(azimuth));
        (Vec3::new(x as f32, y as f32, cos as f32), reach)
    }

    /// Its halves, divided across the longer side.
    pub(crate) fn halves(self) -> [Self; 2] {
        let [low, high] = self.tilts.map(tilt);
        let [from, to] = self.turns;
        if high - low > core::f64::consts::TAU * (to - from) * math::sin_f64(high) {
            let sin = math::sin_f64(0.25 * (low + high));
            let middle = 2.0 * sin * sin;
            [Self { tilts: [self.tilts[0], middle], ..self }, Self { tilts: [middle, self.tilts[1]], ..self }]
        } else {
            let middle = 0.5 * (from + to);
            [Self { turns: [from, middle], ..self }, Self { turns: [middle, to], ..self }]
        }
    }

    /// The ranges of `n_x` and `n_y`.
    pub(crate) fn sides(self) -> [[f64; 2]; 2] {
        let sines = self.tilts.map(|d| math::sqrt_f64((d * (2.0 - d)).max(0.0)));
        let [from, to] = self.turns;
        let ranges = |quarter: f64| {
            // The range of the cosine of the angle to the axis at `quarter` turns.
            let at = [from, to].map(|turn| math::cos_f64(core::f64::consts::TAU * (turn - quarter)));
            let holds = |turn: f64| (-1..=1).any(|k| (from..=to).contains(&(turn + f64::from(k))));
            let most = if holds(quarter) { 1.0 } else { at[0].max(at[1]) };
            let least = if holds(quarter + 0.5) { -1.0 } else { at[0].min(at[1]) };
            let ends = |c: f64| sines.map(|sin| sin * c);
            let ([a, b], [c, d]) = (ends(least), ends(most));
            [a.min(b), c.max(d)]
        };
        [ranges(0.0), ranges(0.25)]
    }
}

/// The angle to the zenith with `1 − cos θ = d`.
fn tilt(d: f64) -> f64 {
    2.0 * math::asin_f64(math::sqrt_f64(0.5 * d.clamp(0.0, 1.0)))
}

/// The direction at `d = 1 − cos θ` and an azimuth in turns.
pub(crate) fn direction(d: f32, turn: f32) -> Vec3 {
    let [cos, sin] = cos_sin_turns(Scalar, turn);
    let across = math::sqrt((d * (2.0 - d)).max(0.0));
    Vec3::new(across * cos, across * sin, (1.0 - d).max(f32::EPSILON))
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn wedges_lie_within_their_radius_and_sides() {
        let mut wedges = alloc::vec![Wedge::HEMISPHERE];
        for k in 0..60 {
            let [low, high] = wedges[k].halves();
            assert_abs_diff_eq!(
                low.solid_angle() + high.solid_angle(),
                wedges[k].solid_angle(),
                epsilon = 1e-12
            );
            wedges.extend([low, high]);
        }
        for wedge in wedges {
            let ((center, reach), [xs, ys]) = (wedge.center(), wedge.sides());
            for (s, t) in (0..=8).flat_map(|s| (0..=8).map(move |t| (f64::from(s) / 8.0, f64::from(t) / 8.0)))
            {
                let at = |[from, to]: [f64; 2], t: f64| (from + (to - from) * t) as f32;
                let m = direction(at(wedge.tilts, s), at(wedge.turns, t));
                assert!(f64::from((m - center).length()) <= reach + 1e-6, "{wedge:?} {m} {center} {reach}");
                for (n, [least, most]) in [(m.x, xs), (m.y, ys)] {
                    assert!((least - 1e-6..=most + 1e-6).contains(&f64::from(n)), "{wedge:?} {m}");
                }
            }
        }
    }
}
