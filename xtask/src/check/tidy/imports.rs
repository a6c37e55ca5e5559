//! The imports of one source file: its `use` declarations and its paths, read from its tokens
//! without a parser of Rust.

use std::collections::BTreeMap;

use proc_macro2::{Delimiter, LexError, Spacing, TokenStream, TokenTree};

/// The imports of one file, without its test modules.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Imports {
    pub(super) paths: Vec<Path>,
    /// Names of public items, and those that `pub use` exports with their origin: of a crate's
    /// root: its exports.
    pub(super) public: BTreeMap<String, Option<Path>>,
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
    /// Names in the source: `crate::a::B`, `super::C`, `a::D` where `a` may be a module below.
    pub(super) segments: Vec<String>,
    /// The inline modules of the file around it, outermost first.
    pub(super) within: Vec<String>,
    pub(super) line: usize,
}

/// Reads one file. `children` are the names of the file modules below it, which a path may begin
/// with.
pub(super) fn read(source: &str, children: &[&str]) -> Result<Imports, LexError> {
    let mut tokens = Vec::new();
    flatten(source.parse()?, 0, &mut tokens);
    Ok(Tokens(tokens).imports(children))
}

/// A word, a sign or a bracket.
struct Token {
    text: String,
    line: usize,
    /// Number of brackets around it.
    depth: usize,
    /// Index behind it, or behind the group that it opens.
    end: usize,
}

/// Words, signs and brackets without comments and literals; `::` is one sign.
fn flatten(stream: TokenStream, depth: usize, found: &mut Vec<Token>) {
    let mut trees = stream.into_iter().peekable();
    while let Some(tree) = trees.next() {
        let (at, line) = (found.len(), tree.span().start().line);
        let token = |text: &str, end| Token { text: text.into(), line, depth, end };
        match tree {
            TokenTree::Group(group) => {
                let [open, close] = match group.delimiter() {
                    Delimiter::Parenthesis => ["(", ")"],
                    Delimiter::Brace => ["{", "}"],
                    Delimiter::Bracket => ["[", "]"],
                    Delimiter::None => ["", ""],
                };
                found.push(token(open, at + 1));
                flatten(group.stream(), depth + 1, found);
                let end = found.len() + 1;
                found.push(token(close, end));
                found[at].end = end;
            }
            TokenTree::Punct(sign) => {
                let colon =
                    |tree: &TokenTree| matches!(tree, TokenTree::Punct(sign) if sign.as_char() == ':');
                let path = sign.as_char() == ':' && sign.spacing() == Spacing::Joint;
                let joint = path && trees.next_if(colon).is_some();
                found.push(token(&if joint { "::".to_owned() } else { sign.to_string() }, at + 1));
            }
            TokenTree::Ident(word) => found.push(token(&word.to_string(), at + 1)),
            TokenTree::Literal(_) => {}
        }
    }
}

struct Tokens(Vec<Token>);

impl Tokens {
    /// The token's text; empty behind the last.
    fn text(&self, i: usize) -> &str {
        self.0.get(i).map_or("", |token| &token.text)
    }

    fn end(&self, i: usize) -> usize {
        self.0.get(i).map_or(i + 1, |token| token.end)
    }

    fn imports(&self, children: &[&str]) -> Imports {
        /// Words that may stand between `pub` and the name of what is public.
        const ITEMS: [&str; 11] = [
            "unsafe", "async", "extern", "const", "fn", "struct", "enum", "union", "trait", "static", "type",
        ];
        let mut imports = Imports::default();
        // Inline modules, and where they end.
        let mut inline: Vec<(usize, &str)> = Vec::new();
        let mut i = 0;
        while let Some(token) = self.0.get(i) {
            inline.retain(|(end, _)| i < *end);
            let (before, here, next) = (self.text(i.wrapping_sub(1)), token.text.as_str(), self.text(i + 1));
            let starts = ["crate", "super", "self"].contains(&here) || children.contains(&here);
            i = match here {
                "#" => {
                    let open = i + 1 + usize::from(next == "!");
                    let condition = [1, 3, 5].map(|k| self.text(open + k));
                    let item = self.end(open);
                    if !matches!(condition, ["cfg", "test", _] | ["cfg", "all", "test"]) {
                        item
                    } else if next == "!" {
                        return Imports { test_only: true, ..Imports::default() };
                    } else {
                        let end = self.after_item(item);
                        if [self.text(end - 3), self.text(end - 1)] == ["mod", ";"] {
                            imports.test_modules.push(self.text(end - 2).into());
                        }
                        end
                    }
                }
                "pub" if next == "(" => self.end(i + 1),
                "pub" if token.depth == 0 && next == "mod" => {
                    imports.public_modules.push(self.text(i + 2).into());
                    i + 1
                }
                "pub" if token.depth == 0 && next != "use" => {
                    let name = (i + 1..).map(|i| self.text(i)).find(|word| !ITEMS.contains(word));
                    imports.public.extend(name.map(|name| (name.into(), None)));
                    i + 1
                }
                "mod" if self.text(i + 2) == "{" => {
                    inline.push((self.end(i + 2), next));
                    i + 1
                }
                _ if before == "use" || starts && next == "::" && before != "::" => {
                    let within: Vec<String> = inline.iter().map(|(_, name)| (*name).into()).collect();
                    let exported =
                        token.depth == 0 && before == "use" && self.text(i.wrapping_sub(2)) == "pub";
                    let end = self.tree(i, &[], &mut |name, line, segments| {
                        let path = Path { segments, within: within.clone(), line };
                        if exported {
                            imports.public.insert(name.into(), Some(path.clone()));
                        }
                        imports.paths.push(path);
                    });
                    end.max(i + 1)
                }
                _ => i + 1,
            };
        }
        imports
    }

    /// Behind the item that begins at `i`, or at the end of what is around it: of an expression or
    /// a field.
    fn after_item(&self, mut i: usize) -> usize {
        loop {
            match self.text(i) {
                "{" => {
                    let end = self.end(i);
                    return end + usize::from(self.text(end) == ";");
                }
                ";" => return i + 1,
                "}" | "" => return i,
                _ => i = self.end(i),
            }
        }
    }

    /// Hands over every path of the tree at `i`, with its name here and its line, and returns the
    /// index behind them.
    fn tree(
        &self,
        mut i: usize,
        prefix: &[String],
        found: &mut impl FnMut(&str, usize, Vec<String>),
    ) -> usize {
        let mut path = prefix.to_vec();
        loop {
            let text = self.text(i);
            if text == "{" {
                let end = self.end(i);
                while i + 1 < end {
                    i = self.tree(i + 1, &path, found);
                }
                return end;
            }
            if !text.starts_with(|c: char| c.is_alphabetic() || "_*".contains(c)) {
                break;
            }
            path.push(text.into());
            i += 1;
            if self.text(i) != "::" {
                break;
            }
            i += 1;
        }
        if path.len() > prefix.len() {
            let line = self.0[i - 1].line;
            if path.len() > 1 {
                path.pop_if(|name| name == "self");
            }
            let renamed = self.text(i) == "as";
            let name = if renamed { self.text(i + 1) } else { &path[path.len() - 1] }.to_owned();
            i += usize::from(renamed);
            found(&name, line, path);
        }
        i
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(source: &str) -> String {
        let imports = read(source, &["child"]).unwrap();
        imports.paths.iter().map(|path| path.segments.join("::")).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn trees_and_inline_paths_are_read_and_nothing_else() {
        for (source, expected) in [
            (
                "use crate::{a::{B, c::{self, D as E},}, math};",
                "crate::a::B crate::a::c crate::a::c::D crate::math",
            ),
            ("use super::F; use {x::Y, z};", "super::F x::Y z"),
            ("fn f() -> crate::g::H { child::k::<T>() + a::child::l() }", "crate::g::H child::k"),
            ("for x in crate::a::ALL { g(..super::B) }", "crate::a::ALL super::B"),
            ("macro_rules! m { () => { use $crate::n::O; } }", "crate::n::O"),
            ("//! use crate::a::A;\n/* use /* nested */ crate::b::B; */", ""),
            (r##"const S: &str = "crate::c::C \" crate::c::C"; const R: &str = r#"crate::d::D"#;"##, ""),
            ("const C: char = '\"'; fn f<'a>(x: &'a str) -> impl A + use<'a> { x }", ""),
            ("pub(in crate::e) fn g() {}", ""),
            ("#[cfg(test)]\nuse crate::{x::X, y};\n#[cfg(test)]\nmod tests { use crate::z::Z; }", ""),
            ("#[cfg(test)]\nmod files;\nuse crate::kept::K;", "crate::kept::K"),
            ("#![cfg(test)]\nuse crate::a::A;", ""),
        ] {
            assert_eq!(written(source), expected, "{source}");
        }
    }

    #[test]
    fn test_files_inline_modules_and_the_exports_of_a_root_are_known() {
        let read = |source| read(source, &[]).unwrap();
        assert_eq!(read("#[cfg(all(test, unix))]\nmod files;").test_modules, ["files"]);
        assert!(read("#![cfg(test)]\nuse crate::a::A;").test_only);
        let inline = read("mod inner { use super::A; }\nuse super::B;");
        assert_eq!((inline.paths[0].within.as_slice(), inline.paths[0].line), (&["inner".into()][..], 1));
        assert_eq!((inline.paths[1].within.len(), inline.paths[1].line), (0, 2));
        let root = read(
            "pub use a::{A, b::B as C};\npub mod m { pub struct X; }\npub(super) fn no() {}\npub const fn f() {}\npub struct S;",
        );
        assert_eq!(root.public.keys().collect::<Vec<_>>(), ["A", "C", "S", "f"]);
        assert_eq!(root.public["C"].as_ref().unwrap().segments, ["a", "b", "B"]);
        assert_eq!(root.public_modules, ["m"]);
    }
}
