//! Heads and words of one source file: its first line, its name, what does not stay, and doc lines that say nothing alone.

/// Folders whose doc lines must be readable alone.
pub(super) const DOC_LINES_HELD: &[&str] = &["crates/fif", "crates/ndf-sampling"];

/// Words that begin a doc line which cannot be read alone, or which hides its noun.
const VAGUE: [&str; 6] = ["The same", "What", "Where", "How", "As", "Those of"];

/// Rules that one source file breaks.
pub(super) fn offences(path: &str, text: &str) -> Vec<String> {
    let mut found = Vec::new();
    if !text.starts_with("//! ") {
        found.push(format!("{path}: the first line says in `//!` what concept the file holds"));
    }
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    if ["utils.rs", "common.rs", "helpers.rs", "types.rs", "misc.rs"].contains(&name) {
        found.push(format!("{path}: a file is named after its concept"));
    }
    for (index, line) in text.lines().enumerate() {
        // Split so that the rule does not find itself.
        for word in [concat!("TO", "DO"), concat!("FIX", "ME"), concat!("#[ig", "nore")] {
            if line.contains(word) {
                found.push(format!("{path}:{}: `{word}` does not stay in the tree", index + 1));
            }
        }
    }
    found
}

/// Doc lines that begin with a word that leans on what stands before.
pub(super) fn vague_doc_lines(path: &str, text: &str) -> Vec<String> {
    let vague = |line: &str| {
        let line = line.trim_start();
        let said = line.strip_prefix("/// ").or_else(|| line.strip_prefix("//! "))?;
        VAGUE.into_iter().find(|word| {
            said.strip_prefix(word).is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric()))
        })
    };
    let said = text.lines().enumerate().filter_map(|(index, line)| Some((index + 1, vague(line)?)));
    said.map(|(line, word)| format!("{path}:{line}: a doc line begins with \"{word}\"")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_says_what_it_holds() {
        assert_eq!(offences("crates/x/src/ggx.rs", "//! The GGX density.\n"), Vec::<String>::new());
        assert_eq!(offences("crates/x/src/utils.rs", "fn f() {}\n").len(), 2);
    }

    #[test]
    fn a_doc_line_stands_alone() {
        let text = "//! How it goes.\n/// The same in 3-D.\n/// Aspect ratio.\n// What a comment may say.\nfn f() {}\n";
        let said = vague_doc_lines("x.rs", text);
        assert_eq!(
            said,
            ["x.rs:1: a doc line begins with \"How\"", "x.rs:2: a doc line begins with \"The same\""]
        );
    }
}
