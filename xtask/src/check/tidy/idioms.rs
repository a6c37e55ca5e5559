//! Idioms and spellings that the documentation avoids; `docs/glossary.md` has the terms that it
//! uses.

/// Phrases in lower case, found as whole words.
const IDIOMS: [&str; 44] = [
    "is no",
    "are no",
    "was no",
    "is none",
    "are none",
    "one's own",
    "tells",
    "told",
    "beside",
    "anew",
    "afresh",
    "dear",
    "dearer",
    "whoever",
    "the like",
    "and its like",
    "in the midst",
    "at hand",
    "by so much",
    "so much of",
    "leaps",
    "fulfil",
    "fulfils",
    "stranger",
    "sister",
    "mend",
    "mended",
    "culprit",
    "asks",
    "speaks",
    "of no meaning",
    "from there on",
    "colour",
    "colours",
    "coloured",
    "centre",
    "centres",
    "fibre",
    "fibres",
    "normalise",
    "normalised",
    "normalisation",
    "licence",
    "neighbour",
];

/// The idioms of a page, each with its line. Code, links and names in backticks are not prose.
pub(super) fn offences(path: &str, text: &str) -> Vec<String> {
    let mut code = false;
    let mut found = Vec::new();
    for (index, line) in text.lines().enumerate() {
        if line.starts_with("```") {
            code = !code;
        }
        if code || line.starts_with("### ") {
            continue;
        }
        let prose = prose(line);
        for idiom in IDIOMS.iter().filter(|idiom| has(&prose, idiom)) {
            found.push(format!("{path}:{}: \"{idiom}\"", index + 1));
        }
    }
    found
}

/// A line in lower case without what stands in backticks or is the address of a link.
fn prose(line: &str) -> String {
    let words: String = line.split('`').step_by(2).collect::<Vec<_>>().join(" ");
    let parts = words.split("](").enumerate();
    let text =
        parts.map(|(k, part)| if k == 0 { part } else { part.split_once(')').map_or("", |(_, rest)| rest) });
    text.collect::<Vec<_>>().join("] ").to_lowercase()
}

/// Whether a phrase occurs between the ends of words.
fn has(prose: &str, phrase: &str) -> bool {
    let letter = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '-');
    prose.match_indices(phrase).any(|(at, _)| {
        let there = ["is no", "are no", "was no"].contains(&phrase) && prose[..at].ends_with("there ");
        !there
            && !letter(prose[..at].chars().next_back())
            && !letter(prose[at + phrase.len()..].chars().next())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn idioms_are_found_as_whole_words_outside_code() {
        let page = "This is no surface.\n`colour` in [gray](colour.md), retold. There is no rule.\n```\ntells\n```\nThe Centre tells.\n";
        assert_eq!(offences("a.md", page), ["a.md:1: \"is no\"", "a.md:6: \"tells\"", "a.md:6: \"centre\""]);
    }
}
