//! Elementary functions and the Gaussian distribution, compared with `f64`.

use asperity_ndf_sampling::{gaussian_cdf, inverse_gaussian_cdf};
use asperity_wgsl::ndf::BECKMANN;

use super::{floats, words};
use crate::case::{Bound, Case, INPUTS, Output, between};

pub(super) fn cases() -> Vec<Case> {
    vec![functions()]
}

/// The crate's own functions are private. Their bits are tested through the densities that use
/// them.
fn functions() -> Case {
    // Quotients off by two units add to the measured errors.
    let output = |name, words, bound: Bound| {
        let adapter = match bound {
            Bound::Relative(limit) => Bound::Relative(2.0 * limit),
            Bound::Absolute(limit) | Bound::Rounding(limit) => Bound::Absolute(2.0 * limit),
            Bound::Equal => Bound::Absolute(f32::MIN_POSITIVE),
        };
        Output { name, words, written: bound, adapter }
    };
    Case {
        name: "ndf/numeric/elementary, normal_distribution".into(),
        parts: vec![&BECKMANN],
        body: "\
    let root = elementary_exp(-0.5 * a.z);
    let turn = elementary_cos_sin_turns(b.x);
    outcome.a = bits(vec4<f32>(
        elementary_exp(a.x), elementary_ln(a.y), elementary_ln_1p(a.w), elementary_one_minus_exp_ratio(a.z, root),
    ));
    outcome.b = bits(vec4<f32>(turn, gaussian_cdf(b.y), inverse_gaussian_cdf(b.z)));
    outcome.c = bits(vec4<f32>(
        gaussian_excess(abs(b.y)), gaussian_mills_ratio(abs(b.y)),
        elementary_bounded(bitcast<f32>(c.x), 13.0), elementary_number(bitcast<f32>(c.x)),
    ));"
        .into(),
        resources: vec![],
        input: Box::new(|i| {
            let mut inputs = [0; INPUTS];
            let power = |k, low, high| between(i, k, low, high).exp2();
            let numbers = [
                between(i, 0, -60.0, 60.0),
                power(1, -10.0, 30.0),
                power(2, -20.0, 7.0),
                // A difference in the shader would be combined with the addition there.
                power(1, -10.0, 30.0) - 0.999,
                between(i, 4, -2.0, 2.0),
                between(i, 5, -6.0, 6.0),
                if i % 2 == 0 { between(i, 6, 1e-6, 1.0) } else { power(6, -31.0, -1.0) },
            ];
            for (input, number) in inputs.iter_mut().zip(numbers) {
                *input = number.to_bits();
            }
            inputs[8] = super::number(i, i / 2, numbers[0]).to_bits();
            inputs
        }),
        reference: Box::new(|inputs| {
            let [x, y, t, y1, u, z, p, _, bad] = floats::<9>(inputs, 0);
            let wide = |x: f32| f64::from(x);
            let density = |z: f64| (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
            let (z, y1, turn) = (wide(z), wide(y1), wide(u) * std::f64::consts::TAU);
            let tail = gaussian_cdf(-z.abs());
            let got = [
                wide(x).exp(),
                wide(y).ln(),
                y1.ln_1p(),
                -(-wide(t)).exp_m1() / wide(t),
                turn.cos(),
                turn.sin(),
                gaussian_cdf(z),
                inverse_gaussian_cdf(wide(p)),
                density(z) - z.abs() * tail,
                tail / density(z),
                wide(if bad.is_nan() { 0.0 } else { bad.clamp(-13.0, 13.0) }),
                wide(if bad.is_nan() { 0.0 } else { bad }),
            ];
            words(&got.map(|x| x as f32))
        }),
        outputs: vec![
            output("exp", 0..1, Bound::Relative(2e-7)),
            output("ln", 1..2, Bound::Relative(3e-7)),
            output("ln_1p", 2..3, Bound::Relative(3e-7)),
            output("(1 − exp(−t))/t", 3..4, Bound::Relative(3e-7)),
            output("cos and sin of turns", 4..6, Bound::Absolute(1.2e-7)),
            output("Φ", 6..7, Bound::Absolute(2.5e-7)),
            output("Φ⁻¹", 7..8, Bound::Absolute(3e-6)),
            output("mean excess", 8..9, Bound::Relative(2e-6)),
            output("Mills' ratio", 9..10, Bound::Relative(5e-7)),
            output("numbers in bounds", 10..12, Bound::Equal),
        ],
    }
}
