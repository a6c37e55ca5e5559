//! The weights that blend lattice points along one axis, with their derivatives.

/// The weight w(t) of the upper lattice point and its derivative.
#[derive(Clone, Copy)]
pub(crate) struct Fade {
    pub(crate) weight: f32,
    pub(crate) slope: f32,
}

impl Fade {
    /// 3t² − 2t³, of Perlin 1985 and of Ebert (ed.) 1994: C¹.
    #[inline(always)]
    pub(crate) fn cubic(t: f32) -> Self {
        Self { weight: t * t * (3.0 - 2.0 * t), slope: 6.0 * t * (1.0 - t) }
    }

    /// 6t⁵ − 15t⁴ + 10t³, of Perlin 2002: C².
    #[inline(always)]
    pub(crate) fn quintic(t: f32) -> Self {
        let up = t * t;
        let down = (1.0 - t) * (1.0 - t);
        Self { weight: up * t * (t * (6.0 * t - 15.0) + 10.0), slope: 30.0 * up * down }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_rise_from_zero_to_one_with_level_ends() {
        for fade in [Fade::cubic, Fade::quintic] {
            let [start, middle, end] = [0.0, 0.5, 1.0].map(fade);
            assert_eq!([start.weight, middle.weight, end.weight], [0.0, 0.5, 1.0]);
            assert_eq!([start.slope, end.slope], [0.0, 0.0]);
        }
        assert_eq!([Fade::cubic(0.5).slope, Fade::quintic(0.5).slope], [1.5, 1.875]);
    }
}
