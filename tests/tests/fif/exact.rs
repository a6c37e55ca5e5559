//! Exact integrals of fractal interpolation functions, in fixed point with 576 fractional bits.
#![expect(clippy::unwrap_used, reason = "a test that cannot build its system has failed")]

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

const LIMBS: usize = 10;

/// A number of magnitude below 2⁶⁴; the last limb is the integer part. Every `f64` that is a
/// multiple of 2⁻⁵²⁰ is exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Big {
    negative: bool,
    limbs: [u64; LIMBS],
}

impl Big {
    pub(super) const ZERO: Self = Self { negative: false, limbs: [0; LIMBS] };

    pub(super) fn one() -> Self {
        1.0.into()
    }

    fn compare(&self, other: &Self) -> Ordering {
        self.limbs.iter().rev().cmp(other.limbs.iter().rev())
    }

    pub(super) fn abs(self) -> Self {
        Self { negative: false, ..self }
    }

    /// Rounds toward 0; parts below 2⁻¹⁰⁷⁴ are dropped.
    pub(super) fn approx(self) -> f64 {
        let Some(top) = self.limbs.iter().rposition(|&limb| limb != 0) else { return 0.0 };
        let low = if top > 0 { self.limbs[top - 1] } else { 0 };
        let all = u128::from(self.limbs[top]) << 64 | u128::from(low);
        let shift = all.leading_zeros();
        // 53 bits, so that nothing rounds.
        let bits = (all << shift) >> 75;
        let exponent = 75 - i32::try_from(shift).unwrap() + 64 * (i32::try_from(top).unwrap() - 10);
        let half = exponent / 2;
        let size = bits as f64 * 2f64.powi(half) * 2f64.powi(exponent - half);
        if self.negative { -size } else { size }
    }

    /// Divides, by Newton's iteration for the reciprocal.
    pub(super) fn over(self, divisor: Self) -> Self {
        // 2^shift times the divisor is near one.
        let top = divisor.limbs.iter().rposition(|&limb| limb != 0).expect("the divisor is not 0");
        let bits = 63 - i32::try_from(divisor.limbs[top].leading_zeros()).unwrap();
        let shift = 64 * (i32::try_from(LIMBS - 1).unwrap() - i32::try_from(top).unwrap()) - bits;
        let near = divisor.scaled(shift);
        let mut inverse = Self::from(1.0 / near.approx());
        let two = Self::from(2.0);
        for _ in 0..5 {
            inverse = inverse * (two - near * inverse);
        }
        (self * inverse).scaled(shift)
    }

    /// Multiplies by a power of two.
    pub(super) fn scaled(self, power: i32) -> Self {
        let mut limbs = [0; LIMBS];
        let (whole, part) = (power.div_euclid(64), power.rem_euclid(64));
        for (k, &limb) in self.limbs.iter().enumerate() {
            let wide = u128::from(limb) << part;
            for (at, bits) in [(0, wide as u64), (1, (wide >> 64) as u64)] {
                let place = i32::try_from(k).unwrap() + whole + at;
                if let Some(out) = usize::try_from(place).ok().and_then(|place| limbs.get_mut(place)) {
                    *out |= bits;
                } else {
                    assert!(place < 0 || bits == 0, "the number is too large");
                }
            }
        }
        Self { limbs, ..self }
    }
}

impl From<f64> for Big {
    fn from(x: f64) -> Self {
        let bits = x.to_bits();
        let (exponent, fraction) = ((bits >> 52) as i32 & 0x7FF, bits & ((1 << 52) - 1));
        let mantissa = if exponent == 0 { fraction } else { fraction | 1 << 52 };
        let mut limbs = [0; LIMBS];
        limbs[LIMBS - 1] = mantissa;
        Self { negative: x < 0.0, limbs }.scaled(exponent.max(1) - 1075)
    }
}

impl Neg for Big {
    type Output = Self;
    fn neg(self) -> Self {
        Self { negative: !self.negative, ..self }
    }
}

impl Add for Big {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let same = self.negative == other.negative;
        let (large, small) =
            if self.compare(&other) == Ordering::Less { (other, self) } else { (self, other) };
        let mut limbs = large.limbs;
        let mut carry = false;
        for (limb, part) in limbs.iter_mut().zip(small.limbs) {
            let step = |a: u64, b: u64| if same { a.overflowing_add(b) } else { a.overflowing_sub(b) };
            let (sum, first) = step(*limb, part);
            let (sum, second) = step(sum, u64::from(carry));
            (*limb, carry) = (sum, first || second);
        }
        assert!(!carry, "the sum is too large");
        Self { negative: large.negative, limbs }
    }
}

impl Sub for Big {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Big {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let mut product = [0_u64; 2 * LIMBS];
        for (i, &a) in self.limbs.iter().enumerate().filter(|(_, a)| **a != 0) {
            let mut carry = 0_u128;
            for (out, &b) in product[i..].iter_mut().zip(&other.limbs) {
                carry += u128::from(a) * u128::from(b) + u128::from(*out);
                *out = carry as u64;
                carry >>= 64;
            }
            product[i + LIMBS] = carry as u64;
        }
        assert_eq!(product[2 * LIMBS - 1], 0, "the product is too large");
        let limbs = std::array::from_fn(|k| product[k + LIMBS - 1]);
        Self { negative: self.negative != other.negative, limbs }
    }
}

/// A system over the unit interval: `f(s_j + a_j u) = α_j f(u) + q_j(u)`.
#[derive(Clone, Debug)]
pub(super) struct Exact {
    /// Knots as given, and in units of the domain.
    x: Vec<f64>,
    s: Vec<Big>,
    alpha: Vec<Big>,
    q: Vec<Vec<Big>>,
    equal: bool,
}

/// Returns the product of two polynomials `Σ_k c_k u^k`.
fn product(a: &[Big], b: &[Big]) -> Vec<Big> {
    let mut out = vec![Big::ZERO; a.len() + b.len() - 1];
    for (i, &a) in a.iter().enumerate() {
        for (j, &b) in b.iter().enumerate() {
            out[i + j] = out[i + j] + a * b;
        }
    }
    out
}

fn power(a: &[Big], n: usize) -> Vec<Big> {
    (0..n).fold(vec![Big::one()], |all, _| product(&all, a))
}

fn binomial(n: usize, k: usize) -> Big {
    (1..=k).fold(1.0, |all, i| all * (n + 1 - i) as f64 / i as f64).into()
}

impl Exact {
    /// `equal` rounds the inner knots to the crate's positions for equal spacing.
    fn over(x: &[f64], alpha: &[f64], equal: bool) -> Self {
        let (first, last) = (Big::from(x[0]), Big::from(*x.last().unwrap()));
        let maps = x.len() - 1;
        let place = |j: usize| {
            if equal {
                Big::from(j as f64).over(Big::from(maps as f64))
            } else {
                (Big::from(x[j]) - first).over(last - first)
            }
        };
        let mut s: Vec<_> = (0..=maps).map(place).collect();
        s[maps] = Big::one();
        let alpha = alpha.iter().map(|&alpha| alpha.into()).collect();
        Self { x: x.to_vec(), s, alpha, q: Vec::new(), equal }
    }

    pub(super) fn affine(x: &[f64], y: &[f64], alpha: &[f64], equal: bool) -> Self {
        let mut all = Self::over(x, alpha, equal);
        let y: Vec<Big> = y.iter().map(|&y| y.into()).collect();
        let rise = *y.last().unwrap() - y[0];
        all.q = (0..alpha.len())
            .map(|j| vec![y[j] - all.alpha[j] * y[0], y[j + 1] - y[j] - all.alpha[j] * rise])
            .collect();
        all
    }

    pub(super) fn hermite(x: &[f64], y: &[f64], slope: &[f64], alpha: &[f64], equal: bool) -> Self {
        let mut all = Self::over(x, alpha, equal);
        let big = |list: &[f64]| list.iter().map(|&v| Big::from(v)).collect::<Vec<_>>();
        let (y, slope, width) = (big(y), big(slope), all.width());
        let last = y.len() - 1;
        all.q = (0..alpha.len())
            .map(|j| {
                let (a, alpha) = (all.s[j + 1] - all.s[j], all.alpha[j]);
                let (p0, p1) = (y[j] - alpha * y[0], y[j + 1] - alpha * y[last]);
                let m0 = width * (a * slope[j] - alpha * slope[0]);
                let m1 = width * (a * slope[j + 1] - alpha * slope[last]);
                let (rise, two) = (p1 - p0, Big::from(2.0));
                vec![p0, m0, Big::from(3.0) * rise - two * m0 - m1, m0 + m1 - two * rise]
            })
            .collect();
        all
    }

    pub(super) fn derivative(&self) -> Self {
        let mut all = self.clone();
        let width = self.width();
        for j in 0..self.alpha.len() {
            let a = self.s[j + 1] - self.s[j];
            all.alpha[j] = self.alpha[j].over(a);
            all.q[j] =
                (1..self.q[j].len()).map(|k| (Big::from(k as f64) * self.q[j][k]).over(a * width)).collect();
        }
        all
    }

    fn width(&self) -> Big {
        Big::from(*self.x.last().unwrap()) - Big::from(self.x[0])
    }

    /// Returns the map that contains a position, and the position's preimage in the domain.
    fn step(&self, t: Big) -> (usize, Big) {
        let right = |s: &Big| !(t - *s).negative || (t - *s) == Big::ZERO;
        let j = self.s.iter().take(self.alpha.len()).rposition(right).unwrap_or(0);
        (j, (t - self.s[j]).over(self.s[j + 1] - self.s[j]))
    }

    fn place(&self, x: f64) -> Big {
        // An equally spaced knot represents the position that the crate assigns to it.
        match self.x.iter().position(|&knot| knot == x) {
            Some(j) if !self.equal => self.s[j],
            _ => (Big::from(x) - Big::from(self.x[0])).over(self.width()),
        }
    }

    /// `f(x)`.
    pub(super) fn value(&self, x: f64) -> Big {
        let (mut t, mut weight, mut sum) = (self.place(x), Big::one(), Big::ZERO);
        while weight.approx().abs() > 2f64.powi(-200) {
            let (j, u) = self.step(t);
            sum = sum + weight * self.q[j].iter().rev().fold(Big::ZERO, |all, &c| all * u + c);
            (t, weight) = (u, weight * self.alpha[j]);
        }
        sum
    }

    /// Returns the integrals of `v^m f^n` over `[0, t]` for every `n ≤ p` and
    /// `m ≤ k + degree (p − n)`. An integral over a map follows from the integrals over its source.
    fn rows(&self, k: usize, p: usize) -> Vec<(usize, usize)> {
        let degree = self.q[0].len() - 1;
        (0..=p).flat_map(|n| (0..=k + degree * (p - n)).map(move |m| (m, n))).collect()
    }

    fn expand(&self, rows: &[(usize, usize)], (m, n): (usize, usize), j: usize) -> Vec<Big> {
        let a = self.s[j + 1] - self.s[j];
        let weight = power(&[self.s[j], a], m);
        let mut out = vec![Big::ZERO; rows.len()];
        for i in 0..=n {
            let rest = product(&weight, &power(&self.q[j], n - i));
            let factor = a * binomial(n, i) * (0..i).fold(Big::one(), |all, _| all * self.alpha[j]);
            for (m, c) in rest.into_iter().enumerate().filter(|(_, c)| *c != Big::ZERO) {
                let place = rows.iter().position(|&row| row == (m, i)).unwrap();
                out[place] = out[place] + factor * c;
            }
        }
        out
    }

    /// `∫ x^k f^p` from `l` to `r`.
    pub(super) fn moment(&self, k: usize, p: usize, l: f64, r: f64) -> Big {
        self.moments(k, p).over(l, r)
    }

    /// `∫ x^k f^p` over any interval.
    pub(super) fn moments(&self, k: usize, p: usize) -> Moments<'_> {
        let rows = self.rows(k, p);
        let maps: Vec<Vec<Vec<Big>>> = (0..self.alpha.len())
            .map(|j| rows.iter().map(|&row| self.expand(&rows, row, j)).collect())
            .collect();
        // Over the whole domain, where lower powers are computed before higher ones.
        let mut whole = vec![Big::ZERO; rows.len()];
        for (i, &(m, n)) in rows.iter().enumerate() {
            if n == 0 {
                whole[i] = Big::one().over(Big::from((m + 1) as f64));
                continue;
            }
            let (mut sum, mut rest) = (Big::ZERO, Big::one());
            for map in &maps {
                for (at, &c) in map[i].iter().enumerate() {
                    match at.cmp(&i) {
                        Ordering::Less => sum = sum + c * whole[at],
                        Ordering::Equal => rest = rest - c,
                        Ordering::Greater => assert_eq!(c, Big::ZERO),
                    }
                }
            }
            whole[i] = sum.over(rest);
        }
        let mut before = vec![vec![Big::ZERO; rows.len()]];
        for (map, j) in maps.iter().zip(0..) {
            let next = map.iter().zip(&before[j]).map(|(row, &sum)| sum + dot(row, &whole)).collect();
            before.push(next);
        }
        // x^k = (x_0 + W v)^k
        let mut weights = vec![Big::ZERO; rows.len()];
        for (m, c) in power(&[Big::from(self.x[0]), self.width()], k).into_iter().enumerate() {
            weights[rows.iter().position(|&row| row == (m, p)).unwrap()] = c * self.width();
        }
        Moments { exact: self, maps, before, weights }
    }
}

/// Returns `Σ_i a_i b_i`, skipping zeros of `a`.
fn dot(a: &[Big], b: &[Big]) -> Big {
    a.iter().zip(b).fold(Big::ZERO, |all, (&a, &b)| all + a * b)
}

/// Integrals of `x^k f^p`.
pub(super) struct Moments<'a> {
    exact: &'a Exact,
    /// For each map its rows, and the integrals over all previous maps.
    maps: Vec<Vec<Vec<Big>>>,
    before: Vec<Vec<Big>>,
    weights: Vec<Big>,
}

impl Moments<'_> {
    /// From `l` to `r`.
    pub(super) fn over(&self, l: f64, r: f64) -> Big {
        self.to(self.exact.place(r)) - self.to(self.exact.place(l))
    }

    fn to(&self, mut t: Big) -> Big {
        let (mut weights, mut sum) = (self.weights.clone(), Big::ZERO);
        while weights.iter().any(|w| w.approx().abs() > 2f64.powi(-250)) && t != Big::ZERO {
            let (j, u) = self.exact.step(t);
            sum = sum + dot(&weights, &self.before[j]);
            let mut next = vec![Big::ZERO; weights.len()];
            for (&weight, row) in weights.iter().zip(&self.maps[j]).filter(|(w, _)| **w != Big::ZERO) {
                for (next, &c) in next.iter_mut().zip(row).filter(|(_, c)| **c != Big::ZERO) {
                    *next = *next + weight * c;
                }
            }
            (t, weights) = (u, next);
        }
        sum
    }
}

#[test]
fn big_arithmetic_is_exact() {
    for x in [1.0, -0.1, 3.0e-150, 1e15] {
        assert_eq!(Big::from(x).approx(), x);
    }
    let third = Big::one().over(Big::from(3.0));
    let rest = third * Big::from(3.0) - Big::one();
    assert!(rest.approx().abs() < 2f64.powi(-500), "{}", rest.approx());
    assert_eq!((Big::from(0.5) - Big::from(2.0)).approx(), -1.5);
    assert_eq!((Big::from(-1.5) * Big::from(3.0)).approx(), -4.5);
    assert_eq!(Big::from(3.0e-90).over(Big::from(-1e-100).scaled(2)).approx(), -7.5e9);
}
