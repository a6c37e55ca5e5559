//! A WGSL interpreter that evaluates every `f32` operation in Rust, in source order.

mod arithmetic;
mod binding;
mod expression;
mod layout;
mod machine;
mod operators;
mod shader;
mod value;

use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Function, Handle};
use rayon::prelude::*;

pub use self::arithmetic::Arithmetic;
use self::arithmetic::Rounding;
use self::binding::Bindings;
use self::machine::Machine;
use self::operators::LANES;
use self::shader::Shader;
pub use self::value::Value;

/// A validated WGSL module with bound resources and rounding options.
///
/// ```
/// use asperity_interpreter::Interpreter;
///
/// let shader = Interpreter::new("fn square(x: f32) -> f32 { return x * x; }")?;
/// assert_eq!(shader.call("square", &[1.5.into()])?, 2.25.into());
/// # Ok::<(), String>(())
/// ```
#[derive(Debug)]
pub struct Interpreter(Shader);

impl Interpreter {
    /// Parses and validates a module.
    ///
    /// # Errors
    ///
    /// Returns naga's error with the source line.
    pub fn new(wgsl: &str) -> Result<Self, String> {
        let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| error.emit_to_string(wgsl))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .map_err(|error| error.emit_to_string(wgsl))?;
        let bindings = Bindings::new(&module);
        Ok(Self(Shader { module, info, bindings, rounding: Rounding::default() }))
    }

    /// Sets the rounding of sums of products.
    #[must_use]
    pub fn arithmetic(mut self, arithmetic: Arithmetic) -> Self {
        self.0.rounding.arithmetic = arithmetic;
        self
    }

    /// Moves every quotient and every square root by `ulps` units in the last place; WGSL allows
    /// 2.5.
    #[must_use]
    pub fn division_ulps(mut self, ulps: i32) -> Self {
        self.0.rounding.division_ulps = ulps;
        self
    }

    /// Flushes denormals to zero, as operands and as results of `f32` operations, as WGSL allows.
    #[must_use]
    pub fn flush_denormals(mut self, flush: bool) -> Self {
        self.0.rounding.flush_denormals = flush;
        self
    }

    /// Binds a `texture_2d<f32>` by bits, a `texture_2d<u32>` or a `texture_2d<i32>`, row by row:
    /// component x.
    ///
    /// # Errors
    ///
    /// If the texture does not exist, or a row is incomplete.
    pub fn texture(&mut self, name: &str, width: u32, words: Vec<u32>) -> Result<(), String> {
        self.0.bindings.texture(&self.0.module, name, width, words)
    }

    /// Binds a uniform by its words in memory layout, including padding.
    ///
    /// # Errors
    ///
    /// If the uniform does not exist, or the number of words differs from naga's layout.
    pub fn uniform(&mut self, name: &str, words: &[u32]) -> Result<(), String> {
        self.0.bindings.buffer(&self.0.module, name, words, "uniform")
    }

    /// Binds a read-only buffer by its words in memory layout, including padding.
    ///
    /// # Errors
    ///
    /// If the buffer does not exist, or the words do not fit its type.
    #[expect(clippy::needless_pass_by_value, reason = "a large table is handed over, as to `texture`")]
    pub fn storage(&mut self, name: &str, words: Vec<u32>) -> Result<(), String> {
        self.0.bindings.buffer(&self.0.module, name, &words, "storage buffer")
    }

    /// Calls a function at one point.
    ///
    /// # Errors
    ///
    /// If the function does not exist, the arguments do not match, a resource is missing, an index
    /// is out of bounds, an expression is unsupported, or a loop does not end.
    pub fn call(&self, function: &str, arguments: &[Value]) -> Result<Value, String> {
        let (called, wanted) = self.function(function)?;
        let given: Vec<usize> = arguments.iter().map(|value| value.words().len()).collect();
        if given != wanted {
            return Err(format!("function `{function}` has arguments of {wanted:?} words, got {given:?}"));
        }
        let words: Vec<u32> = arguments.iter().flat_map(Value::words).copied().collect();
        let mut values = Machine::new(&self.0).call(called, &[&words[..]])?;
        values.pop().ok_or_else(|| format!("function `{function}` was not called"))
    }

    /// Calls a function at many points on all cores. An input is the concatenated words of all
    /// arguments.
    ///
    /// # Errors
    /// If [`Self::call`] fails for one of the inputs.
    pub fn call_many<W: AsRef<[u32]> + Sync>(
        &self,
        function: &str,
        inputs: &[W],
    ) -> Result<Vec<Value>, String> {
        let (called, wanted) = self.function(function)?;
        let wanted: usize = wanted.into_iter().sum();
        if let Some(other) = inputs.iter().find(|input| input.as_ref().len() != wanted) {
            let given = other.as_ref().len();
            return Err(format!("function `{function}` has arguments of {wanted} words, got {given}"));
        }
        // Many points per batch, so that a machine is created once for all of them.
        let chunks: Vec<Vec<Value>> = inputs
            .par_chunks(32 * LANES)
            .map_init(
                || Machine::new(&self.0),
                |machine, chunk| {
                    let mut values = Vec::with_capacity(chunk.len());
                    for points in chunk.chunks(LANES) {
                        let points: Vec<&[u32]> = points.iter().map(AsRef::as_ref).collect();
                        values.append(&mut machine.call(called, &points)?);
                    }
                    Ok(values)
                },
            )
            .collect::<Result<_, String>>()?;
        Ok(chunks.into_iter().flatten().collect())
    }

    /// Returns a function and the numbers of words of its arguments.
    fn function(&self, name: &str) -> Result<(Handle<Function>, Vec<usize>), String> {
        let mut functions = self.0.module.functions.iter();
        let found = functions.find(|(_, function)| function.name.as_deref() == Some(name));
        let (handle, function) = found.ok_or_else(|| format!("no function `{name}`"))?;
        let words = |of| layout::words_of(&self.0.module, of).map(|words| words as usize);
        let words = function.arguments.iter().map(|argument| words(argument.ty)).collect::<Result<_, _>>()?;
        Ok((handle, words))
    }
}
