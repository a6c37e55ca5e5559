//! Minifies the page's scripts.

use oxc_allocator::Allocator;
use oxc_codegen::{Codegen, CodegenOptions};
use oxc_mangler::Mangler;
use oxc_parser::Parser;
use oxc_span::SourceType;

/// Removes spaces and comments from a module and shortens its names, including top-level names.
/// Properties and globals keep their names.
///
/// # Errors
///
/// Returns the first syntax error.
pub(crate) fn minified(module: &str) -> Result<String, String> {
    let allocator = Allocator::default();
    let parsed = Parser::new(&allocator, module, SourceType::mjs()).parse();
    if let Some(error) = parsed.diagnostics.first() {
        return Err(format!("the page's scripts: {error}"));
    }
    let names = Mangler::new().build(&parsed.program);
    let printed = Codegen::new()
        .with_options(CodegenOptions::minify())
        .with_scoping(Some(names.scoping))
        .with_private_member_mappings(Some(names.class_private_mappings))
        .build(&parsed.program);
    Ok(printed.code)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minified_keeps_properties_and_globals() {
        let module = "const picture = { width: 3 };\n// A comment.\nfunction drawn(size) {\n  return size * picture.width;\n}\nglobalThis.asperity = drawn;\n";
        let short = minified(module).expect("a script");
        assert!(short.contains("globalThis.asperity="), "{short}");
        assert!(short.contains(".width"), "{short}");
        for gone in ["picture", "drawn", "size", "comment", "\n "] {
            assert!(!short.contains(gone), "{gone}: {short}");
        }
        assert!(3 * short.len() < 2 * module.len(), "{short}");
    }

    #[test]
    fn minified_reports_syntax_errors() {
        assert!(minified("const = 3;").is_err_and(|error| error.starts_with("the page's scripts: ")));
    }
}
