//! From naga's expressions and statements to operations on words.

mod body;
mod contraction;
mod dead_code;
mod expression;
mod math;
mod matrix;
mod memory;
mod place;
mod rounding;
mod statement;

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{AddressSpace, GlobalVariable, Handle, Module, StorageAccess, TypeInner};

use self::body::{Body, Compiled};
use self::memory::Memory;
use self::place::Place;
use super::arithmetic::{Arithmetic, Rounding};
use super::layout;
use super::program::{Function, Program};

/// Compiles all functions; one with anything that is not known becomes its error.
pub(super) fn program(module: &Module, info: &ModuleInfo, rounding: Rounding) -> Program {
    let mut memory = Memory::default();
    let globals: Vec<Result<Compiled, String>> = module
        .global_variables
        .iter()
        .map(|(handle, variable)| global(module, handle, variable, &mut memory))
        .collect();
    let mut functions: Vec<Result<Function, String>> = Vec::new();
    for (handle, function) in module.functions.iter() {
        let name = function.name.clone().unwrap_or_default();
        let compiled = compile(module, &info[handle], function, &globals, &functions, &mut memory, rounding);
        functions.push(compiled.map_err(|error| format!("{error}, in `{name}`")));
    }
    memory.program(functions)
}

fn compile(
    module: &Module,
    info: &FunctionInfo,
    function: &naga::Function,
    globals: &[Result<Compiled, String>],
    callees: &[Result<Function, String>],
    memory: &mut Memory,
    rounding: Rounding,
) -> Result<Function, String> {
    let mut compiled = Body::new(module, info, function, globals, callees, memory)?.compile()?;
    dead_code::remove(&mut compiled.steps);
    if rounding.arithmetic == Arithmetic::Fused {
        contraction::fuse(&mut compiled.steps);
    }
    rounding::round(&mut compiled.steps, rounding, memory);
    Ok(compiled)
}

fn global(
    module: &Module,
    handle: Handle<GlobalVariable>,
    variable: &GlobalVariable,
    memory: &mut Memory,
) -> Result<Compiled, String> {
    let name = variable.name.as_deref().unwrap_or_default();
    let index = handle.index() as u32;
    match variable.space {
        AddressSpace::Handle if matches!(module.types[variable.ty].inner, TypeInner::Image { .. }) => {
            Ok(Compiled::Texture(memory.constant(index)))
        }
        AddressSpace::Uniform => Ok(Compiled::Place(Place::buffer(index))),
        AddressSpace::Storage { access } if !access.contains(StorageAccess::STORE) => {
            Ok(Compiled::Place(Place::buffer(index)))
        }
        AddressSpace::Private => {
            let words = match variable.init {
                Some(init) => memory::constant_words(module, &module.global_expressions, init)?,
                None => vec![0; layout::words_of(module, variable.ty)? as usize],
            };
            Ok(Compiled::Place(Place::memory(memory.variable(&words))))
        }
        space => Err(format!("`{name}` lies in the space {space:?}, which is not known")),
    }
}
