//! An interpreter of WGSL: every `f32` operation is Rust's, in the order that is written.

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

/// A validated module of WGSL, what its names are bound to, and how its sums and quotients are rounded.
///
/// ```
/// use asperity_wgsl::Interpreter;
///
/// let shader = Interpreter::new("fn square(x: f32) -> f32 { return x * x; }")?;
/// assert_eq!(shader.call("square", &[1.5.into()])?, 2.25.into());
/// # Ok::<(), String>(())
/// ```
#[derive(Debug)]
pub struct Interpreter(Shader);

impl Interpreter {
    /// Parses and validates.
    ///
    /// # Errors
    /// Error as naga prints it, with the line of the source.
    pub fn new(wgsl: &str) -> Result<Self, String> {
        let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| error.emit_to_string(wgsl))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .map_err(|error| error.emit_to_string(wgsl))?;
        let bindings = Bindings::new(&module);
        Ok(Self(Shader { module, info, bindings, rounding: Rounding::default() }))
    }

    /// Rounds sums of products as `arithmetic` says.
    #[must_use]
    pub fn arithmetic(mut self, arithmetic: Arithmetic) -> Self {
        self.0.rounding.arithmetic = arithmetic;
        self
    }

    /// Moves every quotient and every square root by so many units in the last place: WGSL allows 2.5 of them.
    #[must_use]
    pub fn division_ulps(mut self, ulps: i32) -> Self {
        self.0.rounding.division_ulps = ulps;
        self
    }

    /// Takes denormals for zero, as operands and as results of `f32` operations, which WGSL allows.
    #[must_use]
    pub fn flush_denormals(mut self, flush: bool) -> Self {
        self.0.rounding.flush_denormals = flush;
        self
    }

    /// Binds a `texture_2d<f32>` by bits, a `texture_2d<u32>` or a `texture_2d<i32>`, row after row: component x.
    ///
    /// # Errors
    /// No such texture, or rows that are not full.
    pub fn texture(&mut self, name: &str, width: u32, words: Vec<u32>) -> Result<(), String> {
        self.0.bindings.texture(&self.0.module, name, width, words)
    }

    /// Binds a uniform by its words as they lie in memory, padding included.
    ///
    /// # Errors
    /// No such uniform, or not as many words as naga lays out.
    pub fn uniform(&mut self, name: &str, words: &[u32]) -> Result<(), String> {
        self.0.bindings.buffer(&self.0.module, name, words, "uniform")
    }

    /// Binds a buffer that is read only, by its words as they lie in memory, padding included.
    ///
    /// # Errors
    /// No such buffer, or words that do not make up its type.
    #[expect(clippy::needless_pass_by_value, reason = "a large table is handed over, as to `texture`")]
    pub fn storage(&mut self, name: &str, words: Vec<u32>) -> Result<(), String> {
        self.0.bindings.buffer(&self.0.module, name, &words, "storage buffer")
    }

    /// Calls a function at one point.
    ///
    /// # Errors
    /// No such function, other arguments, nothing bound, an index outside, an expression that is not known, or a loop
    /// without an end.
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

    /// Calls a function at many points, over all cores; an input is the words of all arguments, one after the other.
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
        // Of many points at once, so that a machine is made once for all of them.
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

    /// A function and the numbers of words of its arguments.
    fn function(&self, name: &str) -> Result<(Handle<Function>, Vec<usize>), String> {
        let mut functions = self.0.module.functions.iter();
        let found = functions.find(|(_, function)| function.name.as_deref() == Some(name));
        let (handle, function) = found.ok_or_else(|| format!("no function is called `{name}`"))?;
        let words = |of| layout::words_of(&self.0.module, of).map(|words| words as usize);
        let words = function.arguments.iter().map(|argument| words(argument.ty)).collect::<Result<_, _>>()?;
        Ok((handle, words))
    }
}
