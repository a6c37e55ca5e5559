//! Numbers of every class from fuzz input: ordinary numbers, arbitrary bits, and neighbors of
//! problematic numbers.

use arbitrary::Unstructured;
use glam::{Vec2, Vec3};

/// The bytes, followed by zeros when they are used up.
pub(crate) struct Numbers<'a>(Unstructured<'a>, &'a [u8]);

/// Values at which formulas change, overflow, or lose all precision.
const SPECIAL: [f64; 32] = [
    0.0,
    1e-45,
    1.175_494_350_822_287_5e-38,
    2.225_073_858_507_201_4e-308,
    5e-324,
    1e-30,
    1e-20,
    1e-10,
    1e-6,
    0.25,
    0.5,
    1.0,
    2.0,
    std::f64::consts::FRAC_PI_2,
    std::f64::consts::PI,
    std::f64::consts::TAU,
    13.0,
    88.722_84,
    177.4,
    709.78,
    1e6,
    1e9,
    4_194_304.0,
    8_388_608.0,
    16_777_216.0,
    2_147_483_648.0,
    4_294_967_296.0,
    9_007_199_254_740_992.0,
    9_223_372_036_854_775_808.0,
    1e19,
    3.402_823_466_385_288_6e38,
    f64::INFINITY,
];

impl<'a> Numbers<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self(Unstructured::new(bytes), bytes)
    }

    /// Whether this is one of the few inputs, one in `many`, that may run expensive checks.
    ///
    /// All bytes decide together, so that a coverage-guided fuzzer does not learn to be slow.
    pub(crate) fn is_one_in(&self, many: u32) -> bool {
        let mixed = |hash: u32, byte: &u8| (hash ^ u32::from(*byte)).wrapping_mul(0x0100_0193);
        (self.1.iter().fold(0x811c_9dc5, mixed) >> 8).is_multiple_of(many)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the remaining bytes.
    pub(crate) fn rest(&mut self) -> &'a [u8] {
        self.0.bytes(self.0.len()).unwrap_or_default()
    }

    pub(crate) fn byte(&mut self) -> u8 {
        self.0.arbitrary().unwrap_or_default()
    }

    pub(crate) fn word(&mut self) -> u32 {
        self.0.arbitrary().unwrap_or_default()
    }

    /// Returns a count from 0 to `most`.
    pub(crate) fn count(&mut self, most: usize) -> usize {
        self.0.int_in_range(0..=most).unwrap_or_default()
    }

    pub(crate) fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.count(from.len() - 1)]
    }

    pub(crate) fn double(&mut self) -> f64 {
        let kind = self.byte();
        let sign = if kind & 1 == 0 { 1.0 } else { -1.0 };
        match kind {
            0..=99 => f64::from(self.word() as i32) / f64::from(1 << 29),
            100..=139 => f64::from_bits(self.0.arbitrary().unwrap_or_default()),
            140..=199 => {
                let (at, steps) = (self.pick(&SPECIAL), self.byte() as i8);
                sign * (0..steps.unsigned_abs() % 4)
                    .fold(at, |x, _| if steps < 0 { x.next_down() } else { x.next_up() })
            }
            200..=229 => sign * f64::from(self.word() >> 8) / f64::from(1 << 24),
            _ => sign * (1.0 + f64::from(self.byte()) / 256.0) * 2f64.powi(i32::from(self.byte() as i8)),
        }
    }

    pub(crate) fn float(&mut self) -> f32 {
        let kind = self.byte();
        let sign = if kind & 1 == 0 { 1.0 } else { -1.0 };
        match kind {
            0..=99 => f32::from(self.word() as i16) / 8192.0,
            100..=139 => f32::from_bits(self.word()),
            140..=199 => {
                let (at, steps) = (self.pick(&SPECIAL) as f32, self.byte() as i8);
                sign * (0..steps.unsigned_abs() % 4)
                    .fold(at, |x, _| if steps < 0 { x.next_down() } else { x.next_up() })
            }
            200..=229 => sign * (self.word() >> 8) as f32 / (1 << 24) as f32,
            _ => sign * (1.0 + f32::from(self.byte()) / 256.0) * 2f32.powi(i32::from(self.byte() as i8)),
        }
    }

    pub(crate) fn pair(&mut self) -> Vec2 {
        Vec2::new(self.float(), self.float())
    }

    pub(crate) fn vector(&mut self) -> Vec3 {
        Vec3::new(self.float(), self.float(), self.float())
    }

    /// Returns a number from 0 to 1, including both ends.
    pub(crate) fn share(&mut self) -> f32 {
        match self.byte() {
            0 => 0.0,
            1 => 1.0,
            2 => f32::from_bits(1),
            3 => 1.0_f32.next_down(),
            _ => (self.word() >> 8) as f32 / (1 << 24) as f32,
        }
    }

    /// Returns a number of any magnitude between two positive numbers.
    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        match self.byte() {
            0 => low,
            1 => high,
            _ => (low * (high / low).powf(self.share())).clamp(low, high),
        }
    }

    pub(crate) fn color(&mut self) -> Vec3 {
        Vec3::new(self.share(), self.share(), self.share())
    }

    /// Returns a unit vector, including along the horizon.
    pub(crate) fn unit(&mut self) -> Vec3 {
        let (z, turn) = (2.0 * self.share() - 1.0, std::f32::consts::TAU * self.share());
        let r = (1.0 - z * z).sqrt();
        Vec3::new(r * turn.cos(), r * turn.sin(), z).normalize()
    }

    /// Returns a unit vector, or a vector without direction or of another length.
    pub(crate) fn direction(&mut self) -> Vec3 {
        match self.byte() {
            0..=127 => self.unit(),
            128..=191 => {
                let v = self.vector();
                let unit = v.as_dvec3().normalize_or_zero().as_vec3();
                if unit == Vec3::ZERO || !unit.is_finite() { v } else { unit }
            }
            _ => self.vector(),
        }
    }

    /// Returns a tolerance for a function of this range: mostly one that is reached quickly, or
    /// any.
    pub(crate) fn tolerance(&mut self, width: f64) -> f64 {
        match self.byte() {
            0..=249 => width * f64::from(self.between(1e-4, 1.0)),
            _ => self.double(),
        }
    }

    /// Returns at most `most` items, as long as there are bytes.
    pub(crate) fn list<T>(&mut self, most: usize, mut make: impl FnMut(&mut Self) -> T) -> Vec<T> {
        let count = self.count(most);
        (0..count).map_while(|_| (!self.is_empty()).then(|| make(self))).collect()
    }
}
