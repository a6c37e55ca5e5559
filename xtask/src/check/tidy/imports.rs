//! The imports of one source file: its `use` declarations and its paths, read from its tokens without a parser of Rust.

/// An inline module of a file and how deep its braces are.
type Inline<'a> = (usize, &'a str);

/// Everything that one file asks of other modules, test modules left out.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Imports {
    /// Paths as they are written, one name a segment: `crate::a::B`, `super::C`, `a::D` where `a` may be a module below.
    pub(super) paths: Vec<Path>,
    /// Names that `pub use` exports, and public items: at a crate's root its face.
    pub(super) public: Vec<String>,
    /// Public modules.
    pub(super) public_modules: Vec<String>,
    /// Modules in files of their own that only tests compile.
    pub(super) test_modules: Vec<String>,
    /// The whole file is compiled for tests only.
    pub(super) test_only: bool,
}

/// One path of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Path {
    pub(super) segments: Vec<String>,
    /// The inline modules of the file around it, outermost first.
    pub(super) within: Vec<String>,
    /// From a `pub use`: the name under which it is exported.
    pub(super) exported: Option<String>,
    pub(super) line: usize,
}

/// A word or a sign, and its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Token<'a> {
    text: &'a str,
    line: usize,
}

/// Words and signs of a source without comments, literals and lifetimes; `::` is one sign.
fn tokens(source: &str) -> Vec<Token<'_>> {
    let bytes = source.as_bytes();
    let at = |i: usize| bytes.get(i).copied().unwrap_or(0);
    let word = |b: u8| b.is_ascii_alphanumeric() || b == b'_' || b >= 0x80;
    let (mut found, mut i, mut line) = (Vec::new(), 0, 1);
    while i < bytes.len() {
        let start = i;
        match at(i) {
            b'/' if at(i + 1) == b'/' => i += source[i..].find('\n').unwrap_or(source.len() - i),
            b'/' if at(i + 1) == b'*' => {
                let mut depth = 1;
                i += 2;
                while i < bytes.len() && depth > 0 {
                    match (at(i), at(i + 1)) {
                        (b'/', b'*') => (depth, i) = (depth + 1, i + 2),
                        (b'*', b'/') => (depth, i) = (depth - 1, i + 2),
                        _ => i += 1,
                    }
                }
            }
            b'"' => i = after_string(bytes, i + 1),
            b'\'' if at(i + 1) == b'\\' => {
                i += 3;
                while i < bytes.len() && at(i) != b'\'' {
                    i += 1;
                }
                i += 1;
            }
            b'\'' => {
                let next = source[i + 1..].chars().next().map_or(1, char::len_utf8);
                // A character, or a lifetime, whose name is skipped.
                i += 1;
                if at(i + next) == b'\'' {
                    i += next + 1;
                } else {
                    while word(at(i)) {
                        i += 1;
                    }
                }
            }
            b if word(b) => {
                while word(at(i)) {
                    i += 1;
                }
                let text = &source[start..i];
                match (text, at(i)) {
                    ("b" | "c", b'"') => i = after_string(bytes, i + 1),
                    ("b", b'\'') => {}
                    ("r" | "br" | "cr", b'"' | b'#') => {
                        let hashes = bytes[i..].iter().take_while(|b| **b == b'#').count();
                        if at(i + hashes) == b'"' {
                            let end = format!("\"{}", "#".repeat(hashes));
                            let body = i + hashes + 1;
                            i = source[body..].find(&end).map_or(source.len(), |n| body + n + end.len());
                        } else {
                            i += hashes;
                        }
                    }
                    _ if text.as_bytes()[0].is_ascii_digit() => {}
                    _ => found.push(Token { text, line }),
                }
            }
            b':' if at(i + 1) == b':' => {
                i += 2;
                found.push(Token { text: "::", line });
            }
            b => {
                i += 1;
                if !b.is_ascii_whitespace() {
                    found.push(Token { text: &source[start..i], line });
                }
            }
        }
        i = i.min(bytes.len());
        line += bytes[start..i].iter().filter(|b| **b == b'\n').count();
    }
    found
}

fn after_string(bytes: &[u8], mut i: usize) -> usize {
    while i < bytes.len() && bytes[i] != b'"' {
        i += if bytes[i] == b'\\' { 2 } else { 1 };
    }
    i + 1
}

/// Reads one file. `children` are the names of the file modules below it, which a path may begin with.
pub(super) fn read(source: &str, children: &[&str]) -> Imports {
    let tokens = tokens(source);
    let text = |i: usize| tokens.get(i).map_or("", |token| token.text);
    let mut imports = Imports::default();
    let mut inline: Vec<Inline<'_>> = Vec::new();
    let (mut i, mut depth) = (0, 0);
    let mut public = false;
    while i < tokens.len() {
        let here = text(i);
        match here {
            "#" => {
                let inner = text(i + 1) == "!";
                let open = i + 1 + usize::from(inner);
                let end = after_group(&tokens, open);
                let only_tests = text(open + 1) == "cfg"
                    && (text(open + 3) == "test" || text(open + 3) == "all" && text(open + 5) == "test");
                i = end;
                if only_tests && inner {
                    return Imports { test_only: true, ..Imports::default() };
                }
                if only_tests {
                    i = after_item(&tokens, i, &mut imports.test_modules);
                }
                continue;
            }
            "{" => depth += 1,
            "}" => {
                depth -= 1;
                inline.retain(|(at, _)| *at <= depth);
            }
            "pub" => {
                public = text(i + 1) != "(";
                i = if public { i + 1 } else { after_group(&tokens, i + 1) };
                continue;
            }
            "mod" if text(i + 2) == "{" => {
                inline.push((depth + 1, text(i + 1)));
                if public && depth == 0 {
                    imports.public_modules.push(text(i + 1).into());
                }
            }
            "mod" if public && depth == 0 && text(i + 2) == ";" => {
                imports.public_modules.push(text(i + 1).into());
            }
            "struct" | "enum" | "union" | "trait" | "fn" | "const" | "static" | "type"
                if public && depth == 0 && !["fn", "unsafe", "async", "extern"].contains(&text(i + 1)) =>
            {
                imports.public.push(text(i + 1).into());
            }
            "use" if text(i + 1) != "<" => {
                let first = imports.paths.len();
                let within: Vec<String> = inline.iter().map(|(_, name)| (*name).into()).collect();
                i = read_tree(&tokens, i + 1, &mut Vec::new(), &mut imports.paths);
                for path in &mut imports.paths[first..] {
                    path.within.clone_from(&within);
                    let exported = path.exported.take().filter(|_| public);
                    if let (Some(name), 0) = (&exported, depth) {
                        imports.public.push(name.clone());
                    }
                    path.exported = exported;
                }
            }
            _ if text(i + 1) == "::"
                && !["::", ".", "in"].contains(&text(i.wrapping_sub(1)))
                && (["crate", "super", "self"].contains(&here) || children.contains(&here)) =>
            {
                let (line, mut segments) = (tokens[i].line, vec![here.to_owned()]);
                while text(i + 1) == "::" && text(i + 2).starts_with(|c: char| c.is_alphabetic() || c == '_')
                {
                    segments.push(text(i + 2).into());
                    i += 2;
                }
                let within = inline.iter().map(|(_, name)| (*name).into()).collect();
                imports.paths.push(Path { segments, within, exported: None, line });
            }
            _ => {}
        }
        // The words that may stand between `pub` and what is public.
        public &= ["unsafe", "async", "extern", "const"].contains(&here);
        i += 1;
    }
    imports
}

/// Behind the group of brackets that opens at `open`.
fn after_group(tokens: &[Token<'_>], open: usize) -> usize {
    let mut depth = 0;
    for (i, token) in tokens.iter().enumerate().skip(open) {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => {
                depth -= 1;
                if depth == 0 {
                    return i + 1;
                }
            }
            _ => {}
        }
    }
    tokens.len()
}

/// Behind the item that begins at `i`; notes the file if it is a module in one.
fn after_item(tokens: &[Token<'_>], mut i: usize, test_modules: &mut Vec<String>) -> usize {
    let text = |i: usize| tokens.get(i).map_or("", |token| token.text);
    let mut use_tree = false;
    while i < tokens.len() {
        match text(i) {
            "#" | "(" | "[" => {
                i = after_group(tokens, if text(i) == "#" { i + 1 } else { i });
                continue;
            }
            "mod" if text(i + 2) == ";" => test_modules.push(text(i + 1).into()),
            "use" => use_tree = true,
            ";" => return i + 1,
            "{" if use_tree => {
                i = after_group(tokens, i);
                continue;
            }
            "{" => return after_group(tokens, i),
            // The end of what is around it: an attribute of an expression or a field.
            "}" => return i,
            _ => {}
        }
        i += 1;
    }
    i
}

/// Reads one tree of a `use` declaration and returns where it ends: at `;`, or at the `,` or `}` around it.
fn read_tree(tokens: &[Token<'_>], mut i: usize, prefix: &mut Vec<String>, paths: &mut Vec<Path>) -> usize {
    let text = |i: usize| tokens.get(i).map_or("", |token| token.text);
    let before = prefix.len();
    let line = tokens.get(i).map_or(0, |token| token.line);
    loop {
        match text(i) {
            "::" | "$" => i += 1,
            "{" => {
                i += 1;
                while !["}", ""].contains(&text(i)) {
                    i = read_tree(tokens, i, prefix, paths);
                    i += usize::from(text(i) == ",");
                }
                i += 1;
                break;
            }
            "," | ";" | "}" | "" => {
                let named_self = prefix.len() > 1 && prefix.last().is_some_and(|name| name == "self");
                let segments = prefix[..prefix.len() - usize::from(named_self)].to_vec();
                let exported = segments.last().cloned();
                paths.push(Path { segments, within: Vec::new(), exported, line });
                break;
            }
            "as" => {
                let segments = prefix.clone();
                paths.push(Path { segments, within: Vec::new(), exported: Some(text(i + 1).into()), line });
                i += 2;
                break;
            }
            name => {
                prefix.push(name.into());
                i += 1;
            }
        }
    }
    prefix.truncate(before);
    i
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(source: &str) -> Vec<String> {
        read(source, &["child"]).paths.iter().map(|path| path.segments.join("::")).collect()
    }

    #[test]
    fn trees_and_inline_paths_are_read() {
        let source = "use crate::{a::{B, c::{self, D as E}}, math};\nuse super::F;\nfn f() -> crate::g::H { child::k() }";
        assert_eq!(
            written(source),
            [
                "crate::a::B",
                "crate::a::c",
                "crate::a::c::D",
                "crate::math",
                "super::F",
                "crate::g::H",
                "child::k"
            ]
        );
    }

    #[test]
    fn comments_literals_lifetimes_and_tests_are_not() {
        let source = r##"
            //! use crate::a::A;
            /* use /* nested */ crate::b::B; */
            const S: &str = "crate::c::C \" crate::c::C"; const R: &str = r#"crate::d::D"#; const C: char = '"';
            fn f<'a>(x: &'a str) -> &'a str { x } pub(in crate::e) fn g() {}
            #[cfg(test)]
            use crate::{x::X, y};
            #[cfg(test)]
            mod files;
            #[cfg(test)]
            mod tests { use crate::z::Z; }
            use crate::kept::K;
        "##;
        assert_eq!(written(source), ["crate::kept::K"]);
        assert_eq!(read(source, &[]).test_modules, ["files"]);
        assert!(read("#![cfg(test)]\nuse crate::a::A;", &[]).test_only);
    }

    #[test]
    fn an_inline_module_is_known_to_its_paths() {
        let imports = read("mod inner { use super::A; } use super::B;", &[]);
        assert_eq!(imports.paths[0].within, ["inner"]);
        assert_eq!(imports.paths[1].within, Vec::<String>::new());
    }

    #[test]
    fn the_face_of_a_root_is_counted() {
        let imports = read(
            "pub use a::{A, b::B as C};\npub mod m { pub struct X; }\npub(super) fn no() {}\npub const fn f() {}\npub struct S;",
            &[],
        );
        assert_eq!(imports.public, ["A", "C", "f", "S"]);
        assert_eq!(imports.public_modules, ["m"]);
    }
}
