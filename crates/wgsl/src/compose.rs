//! Parts joined into modules of WGSL.

use alloc::{format, string::String, vec::Vec};
use core::fmt::Write;

use crate::part::{Binding, Part};

/// Resource types of a composition, and their bind group.
///
/// Bindings are numbered from 0 in the order of [`ordered`] and of the [`bindings`](Part::bindings)
/// of each part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bindings {
    /// Tables are textures, which WebGPU, WebGL 2, GLSL, HLSL and MSL all support.
    Textures {
        /// The bind group.
        group: u32,
    },
    /// Tables are read-only storage buffers.
    Buffers {
        /// The bind group.
        group: u32,
    },
}

/// Returns the parts and their transitive dependencies in topological order, without duplicates.
#[must_use]
pub fn ordered(parts: &[&'static Part]) -> Vec<&'static Part> {
    let (mut begun, mut found) = (Vec::new(), Vec::new());
    parts.iter().for_each(|part| add(part, &mut begun, &mut found));
    found
}

/// Appends the dependencies of a part and then the part, unless a part with its name is in `found`
/// or `begun`.
pub(crate) fn add(part: &'static Part, begun: &mut Vec<&'static str>, found: &mut Vec<&'static Part>) {
    if !begun.contains(&part.name()) {
        begun.push(part.name());
        part.needs().iter().for_each(|needed| add(needed, begun, found));
        found.push(part);
    }
}

/// Joins parts and their dependencies into one WGSL module with their bindings.
///
/// In a dependency cycle each part occurs once, not necessarily after its dependencies. WGSL does
/// not require an order.
#[must_use]
pub fn compose(parts: &[&'static Part], bindings: Bindings) -> String {
    let parts = ordered(parts);
    let mut wgsl = String::new();
    let resources = parts.iter().flat_map(|part| part.bindings());
    for (index, resource) in resources.enumerate() {
        wgsl += &declared(resource, bindings, index);
    }
    for part in parts {
        let _ = write!(wgsl, "\n// {}\n\n{}", part.name(), part.source());
    }
    wgsl
}

/// Declares a resource as a variable, and for a table the function that reads it.
pub(crate) fn declared(resource: &Binding, bindings: Bindings, index: usize) -> String {
    let (group, textures) = match bindings {
        Bindings::Textures { group } => (group, true),
        Bindings::Buffers { group } => (group, false),
    };
    let at = format!("@group({group}) @binding({index})");
    match *resource {
        Binding::Uniform { name, of } => format!("{at} var<uniform> {name}: {of};\n"),
        Binding::Texture { name } => format!("{at} var {name}: texture_2d<f32>;\n"),
        Binding::Sampler { name } => format!("{at} var {name}: sampler;\n"),
        Binding::Table { name, element, width } => {
            let element = element.wgsl();
            if textures {
                let width = width.max(1);
                let (last, shift) = (width - 1, width.trailing_zeros());
                format!(
                    "{at} var {name}_table: texture_2d<{element}>;\n\
                     fn {name}(i: u32) -> {element} {{\n    \
                     return textureLoad({name}_table, vec2<i32>(i32(i & {last}u), i32(i >> {shift}u)), 0).x;\n}}\n"
                )
            } else {
                format!(
                    "{at} var<storage, read> {name}_table: array<{element}>;\n\
                     fn {name}(i: u32) -> {element} {{\n    return {name}_table[i];\n}}\n"
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::part::Element;

    static BASE: Part = Part::new("base", "fn base() {}\n", &[]).with_bindings(&[Binding::Table {
        name: "level",
        element: Element::Word,
        width: 64,
    }]);
    static LEFT: Part = Part::new("left", "fn left() {}\n", &[&BASE])
        .with_bindings(&[Binding::Uniform { name: "sum", of: "Sum" }]);
    static RIGHT: Part = Part::new("right", "fn right() {}\n", &[&BASE, &LEFT]);

    #[test]
    fn compose_orders_dependencies() {
        let names =
            |parts: &[&'static Part]| ordered(parts).iter().map(|part| part.name()).collect::<Vec<_>>();
        assert_eq!(names(&[&RIGHT]), ["base", "left", "right"]);
        assert_eq!(names(&[&LEFT, &RIGHT, &BASE]), ["base", "left", "right"]);
    }

    /// Two parts that depend on each other, and one that depends on itself.
    static HEN: Part = Part::new("hen", "fn hen() {}\n", &[&EGG]);
    static EGG: Part = Part::new("egg", "fn egg() {}\n", &[&EGG, &HEN]);

    #[test]
    fn compose_terminates_on_cycles() {
        let names = |parts: &[&'static Part]| ordered(parts).iter().map(|p| p.name()).collect::<Vec<_>>();
        assert_eq!(names(&[&HEN]), ["egg", "hen"]);
        assert_eq!(names(&[&EGG, &HEN]), ["hen", "egg"]);
        assert_eq!(compose(&[&HEN], Bindings::Buffers { group: 0 }).matches("fn egg").count(), 1);
    }

    #[test]
    fn compose_declares_table_of_width_0() {
        static NONE: Part = Part::new("none", "", &[]).with_bindings(&[Binding::Table {
            name: "none",
            element: Element::Word,
            width: 0,
        }]);
        assert!(compose(&[&NONE], Bindings::Textures { group: 0 }).contains("i32(i & 0u), i32(i >> 0u)"));
    }

    #[test]
    fn compose_numbers_bindings() {
        let wgsl = compose(&[&RIGHT], Bindings::Textures { group: 1 });
        assert!(wgsl.starts_with(
            "@group(1) @binding(0) var level_table: texture_2d<u32>;\n\
             fn level(i: u32) -> u32 {\n    \
             return textureLoad(level_table, vec2<i32>(i32(i & 63u), i32(i >> 6u)), 0).x;\n}\n\
             @group(1) @binding(1) var<uniform> sum: Sum;\n"
        ));
        let wgsl = compose(&[&BASE], Bindings::Buffers { group: 0 });
        assert!(wgsl.contains("var<storage, read> level_table: array<u32>;\n"));
        assert!(wgsl.contains("return level_table[i];"));
    }
}
