//! Parts as separate modules, for shader preprocessors with imports.

use alloc::{format, string::String, vec, vec::Vec};

use crate::{
    compose::{Bindings, add, declared},
    part::Part,
};

/// A preprocessor that joins WGSL by imports, which are lines at the head of a module of plain
/// WGSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Imports {
    /// `naga_oil`, the preprocessor of Bevy: `#define_import_path asperity::…` and
    /// `#import asperity::…::{…}`.
    NagaOil,
    /// WESL: `import package::asperity::…::{…};`, for files under a folder `asperity`.
    Wesl,
}

/// Returns one part as a module with its imports, and with its own bindings from 0 on.
///
/// ```
/// use asperity_wgsl::{Bindings, Imports, module, noise};
///
/// let perlin = module(&noise::PERLIN, Imports::NagaOil, Bindings::Textures { group: 2 });
/// assert!(perlin.starts_with("#define_import_path asperity::noise::kinds::perlin\n"));
/// ```
#[must_use]
pub fn module(part: &Part, imports: Imports, bindings: Bindings) -> String {
    let path = |part: &Part| part.name().replace('/', "::");
    let mut wgsl = match imports {
        Imports::NagaOil => format!("#define_import_path asperity::{}\n", path(part)),
        Imports::Wesl => String::new(),
    };
    // A part is excluded from its own dependencies, which may form a cycle.
    let (mut begun, mut needs) = (vec![part.name()], Vec::new());
    part.needs().iter().for_each(|needed| add(needed, &mut begun, &mut needs));
    for needed in needs {
        let used: Vec<&str> = needed.names().filter(|name| mentions(part.source(), name)).collect();
        let used = used.join(", ");
        if !used.is_empty() {
            wgsl += &match imports {
                Imports::NagaOil => format!("#import asperity::{}::{{{used}}}\n", path(needed)),
                Imports::Wesl => format!("import package::asperity::{}::{{{used}}};\n", path(needed)),
            };
        }
    }
    for (index, resource) in part.bindings().iter().enumerate() {
        wgsl += &declared(resource, bindings, index);
    }
    format!("{wgsl}\n{}", part.source())
}

/// Whether a source contains a word.
fn mentions(source: &str, word: &str) -> bool {
    let part_of_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    source.match_indices(word).any(|(at, _)| {
        !source[..at].ends_with(part_of_word) && !source[at + word.len()..].starts_with(part_of_word)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::part::{Binding, Element};

    static LOW: Part = Part::new(
        "a/low",
        "const LOW_STEP: f32 = 0.5;\nfn low(x: f32) -> f32 {\n    return x;\n}\nfn lower() {}\n",
        &[],
    );
    static OTHER: Part = Part::new("a/other", "fn other() {}\n", &[]);
    static HIGH: Part = Part::new(
        "b/high",
        "fn high(x: f32) -> f32 {\n    return low(x) + lowest(LOW_STEP) + words(1u);\n}\n",
        &[&LOW, &OTHER],
    )
    .with_bindings(&[Binding::Table { name: "words", element: Element::Float, width: 64 }]);

    /// Transitive dependencies are imported, too.
    static TOP: Part = Part::new("c/top", "fn top() -> f32 {\n    return high(lower());\n}\n", &[&HIGH]);

    #[test]
    fn module_imports_transitive_dependencies() {
        let oil = module(&TOP, Imports::NagaOil, Bindings::Textures { group: 0 });
        let imports = "#import asperity::a::low::{lower}\n#import asperity::b::high::{high}\n";
        assert!(oil.starts_with(&format!("#define_import_path asperity::c::top\n{imports}")), "{oil}");
    }

    static HEN: Part = Part::new("hen", "fn hen() { egg(); }\n", &[&EGG]);
    static EGG: Part = Part::new("egg", "fn egg() { hen(); }\n", &[&HEN]);

    #[test]
    fn module_in_a_cycle_does_not_import_itself() {
        let wesl = module(&HEN, Imports::Wesl, Bindings::Buffers { group: 0 });
        assert_eq!(wesl, format!("import package::asperity::egg::{{egg}};\n\n{}", HEN.source()));
    }

    #[test]
    fn module_imports_used_names() {
        let bindings = Bindings::Buffers { group: 3 };
        let expected = "#define_import_path asperity::b::high\n\
                        #import asperity::a::low::{LOW_STEP, low}\n\
                        @group(3) @binding(0) var<storage, read> words_table: array<f32>;\n";
        let oil = module(&HIGH, Imports::NagaOil, bindings);
        assert!(oil.starts_with(expected), "{oil}");
        assert!(oil.ends_with(HIGH.source()));
        let wesl = module(&HIGH, Imports::Wesl, bindings);
        assert!(wesl.starts_with("import package::asperity::a::low::{LOW_STEP, low};\n@group(3)"), "{wesl}");
    }
}
