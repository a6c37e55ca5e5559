//! Rules for one source file: its first line, its name, leftovers, and ignored tests.

/// Words that do not stay in the tree; split so that the rule does not find itself.
const FLEETING: [&str; 2] = [concat!("TO", "DO"), concat!("FIX", "ME")];

/// Tests left out of `cargo test`, and the one reason for it: `cargo xtask ci --weekly` runs them.
const LEFT_OUT: [&str; 2] = [concat!("#[ig", "nore"), concat!("#[ig", "nore = \"slow: weekly\"]")];

/// Rules that one source file breaks.
pub(super) fn offences(path: &str, text: &str) -> Vec<String> {
    let mut found = Vec::new();
    if !text.starts_with("//! ") {
        found.push(format!("{path}: the first line says in `//!` what concept the file holds"));
    }
    let name = path.rsplit('/').next().unwrap_or(path);
    if ["utils.rs", "common.rs", "helpers.rs", "types.rs", "misc.rs"].contains(&name) {
        found.push(format!("{path}: a file is named after its concept"));
    }
    for (index, line) in text.lines().enumerate() {
        let place = format_args!("{path}:{}", index + 1);
        for word in FLEETING.iter().filter(|word| line.contains(**word)) {
            found.push(format!("{place}: `{word}` does not stay in the tree"));
        }
        if line.contains(LEFT_OUT[0]) && !line.contains(LEFT_OUT[1]) {
            found.push(format!("{place}: only slow tests are left out, by `{}`", LEFT_OUT[1]));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_says_what_it_holds() {
        assert_eq!(offences("crates/x/src/ggx.rs", "//! The GGX density.\n"), Vec::<String>::new());
        assert_eq!(offences("crates/x/src/utils.rs", "fn f() {}\n").len(), 2);
    }
}
