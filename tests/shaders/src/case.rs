//! WGSL functions compared with the crates: inputs, references and bounds, for any shader backend.

use std::ops::Range;

use asperity_wgsl::{Binding, Bindings, Part, compose, ordered};

use asperity_interpreter::Interpreter;

/// Input words of a case.
pub const INPUTS: usize = 16;
/// Output words of a case.
pub const OUTPUTS: usize = 16;

/// One WGSL function, or several with the same inputs, compared with the crates.
pub struct Case {
    /// Concept and dimension: `noise/kinds/value, 3-D`.
    pub name: String,
    /// Parts that the body calls.
    pub parts: Vec<&'static Part>,
    /// The body of `fn evaluate(a: vec4<f32>, b: vec4<f32>, c: vec4<u32>, d: vec4<u32>) ->
    /// Outcome`, see [`Case::wgsl`].
    pub body: String,
    /// Words of uniforms and tables, by the names of the parts' bindings.
    pub resources: Vec<(&'static str, Vec<u32>)>,
    /// The i-th input: the words of a, b, c and d. Every case has at least [`Case::COUNT`] inputs,
    /// the first few of which are invalid.
    pub input: Box<dyn Fn(u32) -> [u32; INPUTS] + Send + Sync>,
    /// Outputs of the crates.
    pub reference: Box<dyn Fn([u32; INPUTS]) -> [u32; OUTPUTS] + Send + Sync>,
    /// Names of the output words, and their tolerances.
    pub outputs: Vec<Output>,
}

/// Some words of an outcome.
pub struct Output {
    /// The quantity: `value`, `gradient`.
    pub name: &'static str,
    /// Its words.
    pub words: Range<usize>,
    /// Bound if every operation is computed as written.
    pub written: Bound,
    /// Bound on any adapter: products and sums may be fused, and divisions and roots may be off by
    /// a few units in the last place.
    pub adapter: Bound,
}

/// Required accuracy of floats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Equal bits; −0 equals 0.
    Equal,
    /// |got − expected| at most this.
    Absolute(f32),
    /// |got − expected| at most this times the larger of |expected| and 1, for results of sums of
    /// numbers up to 1, whose rounding grows with a result above 1.
    Rounding(f32),
    /// |got − expected| at most this times |expected|, or at most 10⁻³⁰ if that is larger.
    Relative(f32),
}

impl Output {
    /// Creates an output from words and bounds.
    #[must_use]
    pub const fn new(name: &'static str, words: Range<usize>, written: Bound, adapter: Bound) -> Self {
        Self { name, words, written, adapter }
    }
}

impl Case {
    /// Number of tested inputs.
    pub const COUNT: u32 = 10_000;

    /// Returns the module with `evaluate`.
    #[must_use]
    pub fn wgsl(&self) -> String {
        format!(
            "{}\n\
             struct Outcome {{ a: vec4<u32>, b: vec4<u32>, c: vec4<u32>, d: vec4<u32> }}\n\
             fn bits(x: vec4<f32>) -> vec4<u32> {{ return bitcast<vec4<u32>>(x); }}\n\
             fn evaluate(a: vec4<f32>, b: vec4<f32>, c: vec4<u32>, d: vec4<u32>) -> Outcome {{\n\
             \x20   var outcome: Outcome;\n{}\n    return outcome;\n}}\n",
            compose(&self.parts, Bindings::Textures { group: 0 }),
            self.body
        )
    }
}

impl Case {
    /// Returns an interpreter of the module with its resources.
    ///
    /// # Errors
    ///
    /// If the module is invalid, or the words of a resource are missing or have the wrong number.
    pub fn interpreter(&self) -> Result<Interpreter, String> {
        self.bound(Interpreter::new(&self.wgsl())?)
    }

    /// Binds the case's resources to a module with the same names.
    ///
    /// # Errors
    ///
    /// If the words of a resource are missing or have the wrong number.
    pub fn bound(&self, mut shader: Interpreter) -> Result<Interpreter, String> {
        for binding in ordered(&self.parts).iter().flat_map(|part| part.bindings()) {
            let name = binding.name();
            let words = self.resources.iter().find(|(resource, _)| *resource == name);
            let (_, words) = words.ok_or_else(|| format!("no words for `{name}`"))?;
            match *binding {
                Binding::Uniform { .. } => shader.uniform(name, words)?,
                Binding::Table { width, .. } => {
                    let mut words = words.clone();
                    words.resize(words.len().next_multiple_of(width as usize), 0);
                    shader.texture(&format!("{name}_table"), width, words)?;
                }
                _ => return Err(format!("`{name}` is neither uniform nor table")),
            }
        }
        Ok(shader)
    }
}

impl Bound {
    /// Returns the error in the bound's measure: 0 for equal bits, and ∞ for NaN against a number.
    /// Unless bits must be equal, two NaN values, and 0 in place of a denormal, which WGSL allows,
    /// are also 0.
    #[must_use]
    pub fn error(self, got: u32, expected: u32) -> f32 {
        let [g, e] = [got, expected].map(f32::from_bits);
        if got == expected || g == e {
            return 0.0;
        }
        // NaN differs from every number, and a denormal result may be flushed to 0.
        if self != Self::Equal && (g.is_nan() && e.is_nan() || g == 0.0 && e.is_subnormal()) {
            return 0.0;
        }
        let error = match self {
            // A product whose factors were flushed to 0 may be missing in the smallest numbers.
            Self::Relative(_) => (g - e).abs() / e.abs().max(1e-30),
            Self::Equal | Self::Absolute(_) => (g - e).abs(),
            Self::Rounding(_) => (g - e).abs() / e.abs().max(1.0),
        };
        if error.is_nan() { f32::INFINITY } else { error }
    }

    /// Returns the maximum allowed error.
    #[must_use]
    pub fn limit(self) -> f32 {
        match self {
            Self::Equal => 0.0,
            Self::Absolute(limit) | Self::Rounding(limit) | Self::Relative(limit) => limit,
        }
    }
}

/// Returns the words of a struct or of an array of structs.
#[must_use]
pub fn packed(of: &impl bytemuck::NoUninit) -> Vec<u32> {
    bytemuck::cast_slice(std::slice::from_ref(of)).to_vec()
}

/// Returns random words, the k-th number of the i-th input.
#[must_use]
pub fn any(i: u32, k: u32) -> u32 {
    let mut h = i.wrapping_mul(0x9e37_79b9) ^ k.wrapping_mul(0x85eb_ca6b).wrapping_add(0x1234_5678);
    for _ in 0..2 {
        h = (h ^ h >> 16).wrapping_mul(0x7feb_352d);
        h = (h ^ h >> 15).wrapping_mul(0x846c_a68b);
    }
    h ^ h >> 16
}

/// Returns uniform numbers in [low, high), the k-th of the i-th input.
#[must_use]
pub fn between(i: u32, k: u32, low: f32, high: f32) -> f32 {
    low + (high - low) * (any(i, k) >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// A denormal number, the only one among all inputs: a GPU may flush it to 0.
pub const DENORMAL: f32 = 1e-40;

/// Coordinates that every function must handle.
pub const BAD: [f32; 10] = [
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::MAX,
    f32::MIN,
    3e9,
    -3e9,
    -0.0,
    DENORMAL,
    2_147_483_648.0,
];
