//! Parts joined into modules of WGSL.

use alloc::{format, string::String, vec::Vec};
use core::fmt::Write;

use crate::part::{Binding, Part};

/// Forms of the resources of a composition, and the group that they are bound in.
///
/// Bindings are numbered from 0 in the order of [`ordered`] and of each part's [`bindings`](Part::bindings).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bindings {
    /// Tables are textures: the form that WebGPU, WebGL 2, GLSL, HLSL and MSL share.
    Textures {
        /// The group.
        group: u32,
    },
    /// Tables are read-only storage buffers.
    Buffers {
        /// The group.
        group: u32,
    },
}

/// The parts and all that they need, each once, what is needed before what needs it.
#[must_use]
pub fn ordered(parts: &[&'static Part]) -> Vec<&'static Part> {
    let (mut begun, mut found) = (Vec::new(), Vec::new());
    parts.iter().for_each(|part| add(part, &mut begun, &mut found));
    found
}

/// Appends all that a part needs and then itself, unless a part of its name is there or on the way.
pub(crate) fn add(part: &'static Part, begun: &mut Vec<&'static str>, found: &mut Vec<&'static Part>) {
    if !begun.contains(&part.name()) {
        begun.push(part.name());
        part.needs().iter().for_each(|needed| add(needed, begun, found));
        found.push(part);
    }
}

/// One WGSL module of parts and all that they need, with their bindings.
///
/// A part of a circle of needs is there once, but not after all that it needs; WGSL does not ask for an order.
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

/// A resource as a variable, with the function that reads it where it is a table.
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
    fn parts_stand_once_and_after_what_they_need() {
        let names =
            |parts: &[&'static Part]| ordered(parts).iter().map(|part| part.name()).collect::<Vec<_>>();
        assert_eq!(names(&[&RIGHT]), ["base", "left", "right"]);
        assert_eq!(names(&[&LEFT, &RIGHT, &BASE]), ["base", "left", "right"]);
    }

    /// Two parts that need one another, and one that needs itself.
    static HEN: Part = Part::new("hen", "fn hen() {}\n", &[&EGG]);
    static EGG: Part = Part::new("egg", "fn egg() {}\n", &[&EGG, &HEN]);

    #[test]
    fn circles_of_needs_come_to_an_end() {
        let names = |parts: &[&'static Part]| ordered(parts).iter().map(|p| p.name()).collect::<Vec<_>>();
        assert_eq!(names(&[&HEN]), ["egg", "hen"]);
        assert_eq!(names(&[&EGG, &HEN]), ["hen", "egg"]);
        assert_eq!(compose(&[&HEN], Bindings::Buffers { group: 0 }).matches("fn egg").count(), 1);
    }

    #[test]
    fn a_table_without_texels_in_a_row_is_declared_too() {
        static NONE: Part = Part::new("none", "", &[]).with_bindings(&[Binding::Table {
            name: "none",
            element: Element::Word,
            width: 0,
        }]);
        assert!(compose(&[&NONE], Bindings::Textures { group: 0 }).contains("i32(i & 0u), i32(i >> 0u)"));
    }

    #[test]
    fn bindings_are_numbered_and_tables_are_read_by_functions() {
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
