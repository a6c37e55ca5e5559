//! Shortens GLSL for the page: pieces shared by programs, not meant for readers.

use std::collections::BTreeMap;

/// Splits a text into pieces: each function, structure and constant is one.
pub(crate) fn pieces_of(text: &str) -> impl Iterator<Item = &str> {
    let ends = text.split_inclusive("\n}\n").flat_map(|piece| piece.split_inclusive("\n};\n"));
    ends.flat_map(|piece| {
        let constant = |line: &&str| line.starts_with("const ") || line.trim().is_empty();
        let length: usize = piece.split_inclusive('\n').take_while(constant).map(str::len).sum();
        let (constants, rest) = piece.split_at(length);
        constants.split_inclusive('\n').chain([rest]).filter(|piece| !piece.trim().is_empty())
    })
}

/// Renames identifiers, except fields.
pub(crate) fn renamed(text: &str, names: &BTreeMap<&str, String>) -> String {
    let words = words_of(text);
    let renamed = words.iter().enumerate().map(|(k, word)| match names.get(word) {
        Some(short) if !is_field(&words, k) => short.as_str(),
        _ => word,
    });
    renamed.collect()
}

/// Removes a piece's indentation and its variables used only once and immediately. The other
/// variables are named by type and declaration order, so that a function has the same text in every
/// program.
///
/// naga creates a variable for every load and call, and numbers names common to several functions
/// in the order of first use.
pub(crate) fn shortened(piece: &str) -> String {
    let mut lines: Vec<Vec<&str>> =
        piece.lines().map(|line| words_of(line.trim_start())).filter(|line| !line.is_empty()).collect();
    let mut names = BTreeMap::new();
    // Structures, blocks, globals and stage inputs keep their names.
    if piece.contains(") {\n") && !piece.contains("uniform ") && !piece.contains("void main() {") {
        put_in_place(&mut lines);
        let mut counts = BTreeMap::new();
        for (kind, name) in lines.iter().flat_map(|line| declared(line)) {
            names.entry(name).or_insert_with(|| {
                let letter = match kind {
                    "bool" => 'b',
                    "float" => 'f',
                    "int" => 'i',
                    "uint" => 'u',
                    "vec2" => 'd',
                    "vec3" => 't',
                    "vec4" => 'w',
                    _ => 's',
                };
                let count = counts.entry(letter).or_insert(0);
                *count += 1;
                format!("{letter}{count}")
            });
        }
    }
    lines.iter().map(|line| renamed(&line.concat(), &names) + "\n").collect()
}

/// Returns types and names of the variables that a line declares, including parameters.
fn declared<'a>(line: &[&'a str]) -> Vec<(&'a str, &'a str)> {
    let places = 0..line.len().saturating_sub(3);
    let pairs = places.filter_map(|k| match line[k..] {
        [kind, " ", name, "," | ")" | ";" | "[", ..] | [kind, " ", name, " ", "=", ..] => Some((kind, name)),
        _ => None,
    });
    pairs.filter(|(kind, name)| is_word(kind) && is_word(name) && *kind != "return").collect()
}

/// Substitutes a variable's initial value for the variable, if it is used once and nothing is
/// stored before.
///
/// Functions must be free of side effects: `shaders` rejects parts that could have them.
fn put_in_place(lines: &mut Vec<Vec<&str>>) {
    loop {
        let before = lines.len();
        for k in (0..lines.len()).rev() {
            let Some((name, value)) = begun(&lines[k]) else { continue };
            let Some(use_of_it) = only_use(&lines[k + 1..], name, value) else { continue };
            let value = if stands_alone(value) { value.to_vec() } else { [&["("], value, &[")"]].concat() };
            let (line, at) = use_of_it;
            lines[k + 1 + line].splice(at..=at, value);
            lines.remove(k);
        }
        if lines.len() == before {
            return;
        }
    }
}

/// Returns the variable that a line declares with a value, and the value.
fn begun<'a, 'b>(line: &'b [&'a str]) -> Option<(&'a str, &'b [&'a str])> {
    match line {
        [kind, " ", name, " ", "=", " ", value @ .., ";"] if is_word(kind) && is_word(name) => {
            Some((name, value))
        }
        _ => None,
    }
}

/// Returns line and position of the only use of a variable, if the lines before only initialize
/// other variables.
fn only_use(later: &[Vec<&str>], name: &str, value: &[&str]) -> Option<(usize, usize)> {
    let mut uses = later.iter().enumerate().flat_map(|(line, words)| {
        let places = (0..words.len()).filter(|&k| words[k] == name && !is_field(words, k));
        places.map(move |at| (line, at))
    });
    let (line, at) = uses.next().filter(|_| uses.next().is_none())?;
    let straight = later[..line].iter().all(|line| begun(line).is_some());
    let words = &later[line];
    let once = !matches!(words.first(), Some(&("while" | "for" | "do" | "}")));
    // Calls remain calls, in the same order relative to derivatives.
    let always = !calls(value) || !words.iter().any(|word| matches!(*word, "?" | "&" | "|"));
    (straight && once && always).then_some((line, at))
}

fn calls(value: &[&str]) -> bool {
    value.windows(2).any(|pair| is_word(pair[0]) && pair[1] == "(")
}

/// Whether a value needs no parentheses: a path, a call, or a parenthesized expression.
fn stands_alone(value: &[&str]) -> bool {
    let is_path = value.iter().all(|word| is_word(word) || matches!(*word, "." | "[" | "]"));
    let inner = value.strip_prefix(&["("]).or_else(|| match value {
        [word, "(", inner @ ..] if is_word(word) => Some(inner),
        _ => None,
    });
    let closed_at_end = |inner: &[&str]| {
        let mut depth = 1;
        let closes = inner.iter().position(|word| {
            depth += i32::from(*word == "(") - i32::from(*word == ")");
            depth == 0
        });
        closes == inner.len().checked_sub(1)
    };
    is_path || inner.is_some_and(closed_at_end)
}

/// Splits a text into words and the single characters between them.
pub(crate) fn words_of(text: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = match rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')) {
            Some(0) => first.len_utf8(),
            Some(length) => length,
            None => rest.len(),
        };
        let (word, further) = rest.split_at(length);
        words.push(word);
        rest = further;
    }
    words
}

fn is_word(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

fn is_field(words: &[&str], k: usize) -> bool {
    k > 0 && words[k - 1] == "."
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shortened_is_independent_of_variable_names() {
        let a = "float lobe(vec2 x_3, float t) {\n    float _e4 = (x_3.x * t);\n    return (_e4 + (_e4 * lobe_at.x));\n}\n";
        let b = "float lobe(vec2 x_17, float t_2) {\n    float _e9 = (x_17.x * t_2);\n    return (_e9 + (_e9 * lobe_at.x));\n}\n";
        assert_eq!(shortened(a), shortened(b));
        assert_eq!(
            shortened(a),
            "float lobe(vec2 d1, float f1) {\nfloat f2 = (d1.x * f1);\nreturn (f2 + (f2 * lobe_at.x));\n}\n"
        );
    }

    #[test]
    fn shortened_inlines_a_value_used_once() {
        let piece = "float lobe(vec2 x) {\n    float a = x.x;\n    float b = x.y;\n    float c = -1.0;\n    return ((a + b) * c);\n}\n";
        assert_eq!(shortened(piece), "float lobe(vec2 d1) {\nreturn ((d1.x + d1.y) * (-1.0));\n}\n");
    }

    #[test]
    fn shortened_keeps_values_around_stores_and_branches() {
        for body in [
            "float f2 = f1;\nf1 = 3.0;\nreturn f2;",
            "float f2 = f1;\nwhile((f2 < 3.0)) {\nf1 = 4.0;\n}\nreturn f1;",
            "float f2 = called(f1);\nreturn ((f1 < 0.0) ? f2 : 1.0);",
            "float f2 = f1;\nif ((f1 < 0.0)) {\nreturn f2;\n}\nreturn 0.0;",
        ] {
            let piece = format!("float lobe(float f1) {{\n{body}\n}}\n");
            assert_eq!(shortened(&piece), piece);
        }
    }

    #[test]
    fn constants_are_separate_pieces() {
        let text = "const float A = 1.0;\nconst float B = 2.0;\n\nfloat f() {\n    return A;\n}\n";
        let pieces: Vec<_> = pieces_of(text).collect();
        assert_eq!(
            pieces,
            ["const float A = 1.0;\n", "const float B = 2.0;\n", "float f() {\n    return A;\n}\n"]
        );
    }

    #[test]
    fn shortened_keeps_shared_names() {
        let block = "layout(std140) uniform view_block { View view_; };\nconst float LEAST = 1e-3;\n";
        assert_eq!(shortened(block), block);
    }
}
