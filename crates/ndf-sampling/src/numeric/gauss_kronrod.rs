//! Adaptive Gauss–Kronrod quadrature.

/// The integral of `f` over the interval between the first and the last of the ascending `cuts`.
///
/// Every part between two cuts is halved, at most [`DEPTH`] times, until the rules of 7 and 15
/// nodes agree within `tolerance` of the first estimate of the whole. The result is from the longer
/// rule, whose error is far smaller than the difference.
pub(crate) fn integrate<const N: usize>(cuts: [f64; N], tolerance: f64, f: impl Fn(f64) -> f64) -> f64 {
    let mut ends = cuts.iter().zip(cuts.iter().skip(1));
    // One part less than cuts; the last place stays empty.
    let parts: [_; N] = core::array::from_fn(|_| {
        ends.next().filter(|(from, to)| from < to).map(|(&from, &to)| ([from, to], rule(from, to, &f)))
    });
    let whole: f64 = parts.iter().flatten().map(|(_, [long, _])| long).sum();
    let allowed = tolerance * whole.abs();
    parts.into_iter().flatten().map(|(ends, sums)| refined(ends, sums, allowed, DEPTH, &f)).sum()
}

/// The maximum number of halvings of a part.
const DEPTH: u32 = 14;

/// The integral over an interval, given its integrals by 15 nodes and by 7 of them.
fn refined(
    [from, to]: [f64; 2],
    [long, short]: [f64; 2],
    allowed: f64,
    depth: u32,
    f: &impl Fn(f64) -> f64,
) -> f64 {
    if depth == 0 || (long - short).abs() <= allowed {
        return long;
    }
    let middle = 0.5 * (from + to);
    let halves = [[from, middle], [middle, to]].map(|ends| (ends, rule(ends[0], ends[1], f)));
    halves.map(|(ends, sums)| refined(ends, sums, allowed, depth - 1, f)).iter().sum()
}

/// The integral by 15 nodes and by 7 of them.
fn rule(from: f64, to: f64, f: &impl Fn(f64) -> f64) -> [f64; 2] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let center = f(middle);
    let (mut long, mut short) = (CENTRE[0] * center, CENTRE[1] * center);
    for (node, kronrod, gauss) in NODES {
        let both = f(middle - half * node) + f(middle + half * node);
        long += kronrod * both;
        short += gauss * both;
    }
    [half * long, half * short]
}

/// Both weights of the node 0.
const CENTRE: [f64; 2] = [0.209_482_141_084_727_83, 0.417_959_183_673_469_4];

/// The positive nodes on [−1, 1] and their weights in the rules of 15 and of 7; Kronrod 1965, by
/// Piessens et al. 1983.
const NODES: [(f64, f64, f64); 7] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_56, 0.129_484_966_168_869_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_19, 0.0),
    (0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
];

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn polynomials_are_exact() {
        for power in 0..=22 {
            let [long, short] = rule(-1.0, 2.0, &|x: f64| x.powi(power));
            let exact = (2.0_f64.powi(power + 1) - (-1.0_f64).powi(power + 1)) / f64::from(power + 1);
            assert_abs_diff_eq!(long / exact, 1.0, epsilon = 1e-14, "{power}");
            assert!(power > 13 || (short / exact - 1.0).abs() < 1e-14, "{power}: {short} != {exact}");
        }
    }

    #[test]
    fn narrow_peaks_and_kinks_are_found() {
        let peak = integrate([0.0, 0.3, 1.0], 1e-8, |x| 1.0 / ((x - 0.3) * (x - 0.3) + 1e-6));
        let exact = 1e3 * ((0.7e3_f64).atan() + (0.3e3_f64).atan());
        assert_abs_diff_eq!(peak / exact, 1.0, epsilon = 1e-9, "{peak}");
        let kink = integrate([-1.0, 2.0], 1e-6, |x| if x > 0.1 { x - 0.1 } else { 0.0 });
        assert_abs_diff_eq!(kink, 0.5 * 1.9 * 1.9, epsilon = 1e-6, "{kink}");
    }
}
