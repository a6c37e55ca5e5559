//! The reference systems of `tests/data/fif`, built with the crate.
#![expect(
    clippy::unwrap_used,
    clippy::missing_panics_doc,
    reason = "a test that cannot read its reference has failed"
)]

use asperity_fif::Fif;
use serde_json::Value;

use crate::reference;

/// Returns a file of the reference.
#[must_use]
pub fn read(name: &str) -> Value {
    reference::read(&format!("fif/{name}.json"))
}

/// Parses `"p/q"` or `"p"`, correctly rounded if p and q are doubles.
#[must_use]
pub fn ratio(text: &str) -> f64 {
    match text.split_once('/') {
        Some((p, q)) => p.parse::<f64>().unwrap() / q.parse::<f64>().unwrap(),
        None => text.parse().unwrap(),
    }
}

/// Parses a list of ratios.
#[must_use]
pub fn ratios(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| ratio(v.as_str().unwrap())).collect()
}

/// Parses a decimal number given as text.
#[must_use]
pub fn decimal(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

/// Parses `p/q` to small integers.
#[must_use]
pub fn integers(text: &str) -> (i64, i64) {
    match text.split_once('/') {
        Some((p, q)) => (p.parse().unwrap(), q.parse().unwrap()),
        None => (text.parse().unwrap(), 1),
    }
}

/// Parses text such as `-0x1.a476310a1a7bep-2`.
#[must_use]
pub fn hexadecimal(text: &str) -> f64 {
    let (sign, text) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
    let (mantissa, exponent) = text.strip_prefix("0x").unwrap().split_once('p').unwrap();
    let (whole, fraction) = mantissa.split_once('.').unwrap();
    let bits = u64::from_str_radix(&format!("{whole}{fraction}"), 16).unwrap();
    sign * bits as f64
        * 2f64.powi(exponent.parse::<i32>().unwrap() - 4 * i32::try_from(fraction.len()).unwrap())
}

/// One system of the reference.
pub struct Reference<const C: usize> {
    /// Its name.
    pub name: String,
    /// The whole file.
    pub json: Value,
    /// The system, built by the crate.
    pub system: Fif<C>,
}

/// A point given by its address.
pub struct Point {
    prefix: Vec<usize>,
    period: Vec<usize>,
    /// The point as a ratio.
    pub x: String,
    /// The value.
    pub y_dec: f64,
    /// The integral from the left end.
    pub int1_dec: f64,
    /// The second integral.
    pub int2_dec: f64,
    /// The slope, if it exists.
    pub dy_dec: Option<f64>,
}

impl Point {
    /// Returns its infinite address, indices from 0.
    pub fn address(&self) -> impl Iterator<Item = usize> + '_ {
        // An empty period means x_0, whose address is the first map repeated.
        let period: &[usize] = if self.period.is_empty() { &[1] } else { &self.period };
        self.prefix.iter().chain(period.iter().cycle()).map(|j| j - 1)
    }
}

/// A double with its exact value.
pub struct Double {
    /// The point.
    pub x: f64,
    /// The value.
    pub y: f64,
    /// The integral from the left end.
    pub int1: f64,
    /// The slope, if it exists.
    pub dy: Option<f64>,
}

impl<const C: usize> Reference<C> {
    /// Reads and builds a system.
    #[must_use]
    pub fn load(name: &str) -> Self {
        let json = read(name);
        let q: Vec<[f64; C]> = json["q"]
            .as_array()
            .unwrap()
            .iter()
            .map(|q| {
                let mut out = [0.0; C];
                let q = ratios(q);
                out[..q.len()].copy_from_slice(&q);
                out
            })
            .collect();
        let knots = ratios(&json["knots"]);
        let alpha = ratios(&json["alpha"]);
        let system = Fif::new(&knots, &alpha, &q).unwrap_or_else(|e| panic!("{name}: {e}"));
        for (j, y) in ratios(&json["y"]).into_iter().enumerate() {
            let got = system.evaluate(knots[j], 1e-14).value;
            crate::assert_abs_diff_eq!(got, y, epsilon = 4e-15 * (1.0 + y.abs()), "{name} knot {j}");
        }
        Self { name: name.to_owned(), json, system }
    }

    /// Returns the maximum of the function.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.system.range().magnitude()
    }

    /// Returns the points given by address.
    #[must_use]
    pub fn points(&self) -> Vec<Point> {
        let indices =
            |v: &Value| v.as_array().unwrap().iter().map(|j| j.as_u64().unwrap() as usize).collect();
        self.json["points"]
            .as_array()
            .unwrap()
            .iter()
            .map(|p| Point {
                prefix: indices(&p["prefix"]),
                period: indices(&p["period"]),
                x: p["x"].as_str().unwrap().to_owned(),
                y_dec: decimal(&p["y_dec"]),
                int1_dec: decimal(&p["int1_dec"]),
                int2_dec: decimal(&p["int2_dec"]),
                dy_dec: p.get("dy_dec").map(decimal),
            })
            .collect()
    }

    /// Returns `(x, f, ∫f, address)` for easy rationals on equally spaced knots.
    #[must_use]
    pub fn simple(&self) -> Vec<(String, f64, f64, Vec<usize>)> {
        let maps = self.system.pieces().len() as i128;
        let (p0, q0) = integers(self.json["knots"][0].as_str().unwrap());
        let (p1, q1) = integers(self.json["knots"].as_array().unwrap().last().unwrap().as_str().unwrap());
        assert!(q0 == 1 && q1 == 1);
        let simple = self.json["simple"].as_array().unwrap().iter();
        simple
            .map(|s| {
                let x = s["x"].as_str().unwrap();
                let (p, q) = integers(x);
                // x as a fraction of the domain, then one base-N digit per step.
                let (mut p, q) = (i128::from(p - p0 * q), i128::from(q * (p1 - p0)));
                let mut address = Vec::new();
                for _ in 0..200 {
                    p *= maps;
                    address.push(usize::try_from((p / q).min(maps - 1)).unwrap());
                    p -= q * (p / q).min(maps - 1);
                }
                (x.to_owned(), decimal(&s["y_dec"]), ratio(s["int1"].as_str().unwrap()), address)
            })
            .collect()
    }

    /// Returns the random doubles.
    #[must_use]
    pub fn doubles(&self) -> Vec<Double> {
        self.json["f64_points"]
            .as_array()
            .unwrap()
            .iter()
            .map(|p| {
                assert!(decimal(&p["err"]) < 1e-15);
                Double {
                    x: hexadecimal(p["x_hex"].as_str().unwrap()),
                    y: decimal(&p["y_dec"]),
                    int1: decimal(&p["int1_dec"]),
                    dy: p.get("dy_dec").map(decimal),
                }
            })
            .collect()
    }

    /// Returns `(l, r, ∫ from l to r)`.
    #[must_use]
    pub fn integrals(&self) -> Vec<(f64, f64, f64)> {
        let all = self.json["integrals"].as_array().unwrap().iter();
        all.map(|i| (ratio(i["l"].as_str().unwrap()), ratio(i["r"].as_str().unwrap()), decimal(&i["dec"])))
            .collect()
    }

    /// Returns `∫ xᵏ f`.
    #[must_use]
    pub fn moment(&self, k: usize) -> f64 {
        decimal(&self.json["moments_dec"][k])
    }

    /// Compares a map of an integral with the reference.
    pub fn check_integral(&self, key: &str, j: usize, alpha: f64, q: &[f64], y: [f64; 2]) {
        let system = &self.json[key];
        let close = |got: f64, want: f64, what: &str| {
            let name = &self.name;
            crate::assert_abs_diff_eq!(
                got,
                want,
                epsilon = 4e-15 * (1.0 + want.abs()),
                "{name} {key} map {j} {what}"
            );
        };
        close(alpha, ratios(&system["alpha"])[j], "factor");
        let want = ratios(&system["q"][j]);
        for (i, &got) in q.iter().enumerate() {
            close(got, want.get(i).copied().unwrap_or(0.0), "coefficient");
        }
        let want = ratios(&system["y"]);
        close(y[0], want[j], "left ordinate");
        close(y[1], want[j + 1], "right ordinate");
    }
}

/// Returns the address of a double on the exact rational knots, in fixed point with 2048 fractional
/// bits. Each step loses at most log₂(1/a) ≤ 4.4 bits, so 200 digits are certain.
#[must_use]
pub fn digits_of_double<const C: usize>(reference: &Reference<C>, x: f64) -> Vec<usize> {
    let knots: Vec<(i64, i64)> =
        reference.json["knots"].as_array().unwrap().iter().map(|k| integers(k.as_str().unwrap())).collect();
    let (x0, x1) = (knots[0], knots[knots.len() - 1]);
    assert!(x0.1 == 1 && x1.1 == 1, "the reference's domains have whole ends");
    let mut point = Fixed::from_f64(x, x0.0);
    let width = x1.0 - x0.0;
    let mut digits = Vec::new();
    for _ in 0..200 {
        // The last map whose left knot is not to the right of the point.
        let mut j = knots.len() - 2;
        while j > 0
            && point.compare_ratio(knots[j].0 - x0.0 * knots[j].1, knots[j].1) == std::cmp::Ordering::Less
        {
            j -= 1;
        }
        digits.push(j);
        // (u − x_{j−1}) · width/(x_j − x_{j−1}), all from x_0.
        let (p, q) = (knots[j].0 - x0.0 * knots[j].1, knots[j].1);
        point.subtract_ratio(p, q);
        let (p1, q1) = (knots[j + 1].0 - x0.0 * knots[j + 1].1, knots[j + 1].1);
        // Length of the interval as a ratio.
        let (length_p, length_q) = (p1 * q - p * q1, q1 * q);
        point.multiply(u32::try_from(width * length_q).unwrap());
        point.divide(u32::try_from(length_p).unwrap());
    }
    digits
}

/// A nonnegative fixed-point number: an integer word, then 64 fractional words, most significant
/// first.
#[derive(Clone)]
struct Fixed([u32; 65]);

impl Fixed {
    /// Returns `x − x0`, exactly.
    fn from_f64(x: f64, x0: i64) -> Self {
        let mut words = [0; 65];
        let mut add = |mut value: f64| {
            for word in &mut words {
                let whole = value.floor();
                *word = whole as u32;
                value = (value - whole) * 4_294_967_296.0;
            }
        };
        // Separate the integer part first, so that no difference rounds.
        let whole = x.floor();
        add(x - whole);
        let mut out = Self(words);
        out.0[0] = u32::try_from(whole as i64 - x0).unwrap();
        out
    }

    fn from_ratio(p: i64, q: i64) -> Self {
        let mut out = Self([0; 65]);
        out.0[0] = u32::try_from(p).unwrap();
        out.divide(u32::try_from(q).unwrap());
        out
    }

    fn compare_ratio(&self, p: i64, q: i64) -> std::cmp::Ordering {
        self.0.cmp(&Self::from_ratio(p, q).0)
    }

    fn subtract_ratio(&mut self, p: i64, q: i64) {
        let other = Self::from_ratio(p, q);
        let mut borrow = 0;
        for (word, other) in self.0.iter_mut().zip(other.0).rev() {
            let difference = i64::from(*word) - i64::from(other) - borrow;
            borrow = i64::from(difference < 0);
            *word = (difference + (borrow << 32)) as u32;
        }
        assert_eq!(borrow, 0);
    }

    fn multiply(&mut self, factor: u32) {
        let mut carry = 0;
        for word in self.0.iter_mut().rev() {
            let product = u64::from(*word) * u64::from(factor) + carry;
            *word = product as u32;
            carry = product >> 32;
        }
        assert_eq!(carry, 0);
    }

    fn divide(&mut self, divisor: u32) {
        let mut rest = 0_u64;
        for word in &mut self.0 {
            let value = (rest << 32) | u64::from(*word);
            *word = (value / u64::from(divisor)) as u32;
            rest = value % u64::from(divisor);
        }
    }
}

/// Applies a function to the reference systems on equally spaced knots, and returns an array of the
/// results.
#[macro_export]
macro_rules! even_systems {
    ($check:ident $(, $more:expr)*) => {
        [
            $check::<1>("cantor"),
            $check::<2>("paper_f"),
            $check::<2>("paper_g"),
            $check::<3>("paper_f_int"),
            $check::<4>("paper_f_int2"),
            $check::<3>("paper_g_int"),
            $check::<2>("parabola"),
            $check::<2>("takagi"),
            $($more),*
        ]
    };
}

/// Applies a function to every reference system with its number of coefficients, and returns an
/// array of the results.
#[macro_export]
macro_rules! systems {
    ($check:ident) => {
        $crate::even_systems!($check, $check::<4>("cubic5"), $check::<2>("nonuni3"))
    };
}
