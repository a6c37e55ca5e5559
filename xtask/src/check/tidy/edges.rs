//! Who may know whom: every edge between crates that the house rules allow.

use std::collections::BTreeSet;

/// Every edge that the house rules allow out of a published crate; nothing else may be there.
const EDGES: &[(&str, &[&str], &[&str])] = &[
    ("asperity-noise", &["approx", "fearless_simd", "glam", "libm"], &["criterion", "png"]),
    ("asperity-ndf-sampling", &["approx", "fearless_simd", "glam", "libm"], &["criterion", "libm", "png"]),
    ("asperity-fif", &["approx", "fearless_simd", "glam", "libm", "serde"], &["criterion", "png"]),
    (
        "asperity-shading",
        &["approx", "asperity-ndf-sampling", "asperity-noise", "glam", "libm"],
        &["criterion", "png"],
    ),
];

/// The members that may use everything and that nothing may use.
const TOPS: &[&str] = &["xtask", "asperity-tests"];

/// The member that may use everything and that only the tops may use.
const RENDER: &str = "asperity-render";

/// One dependency as its manifest states it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Edge {
    pub(super) from: String,
    pub(super) to: String,
    /// A development dependency: tests, examples and benches only.
    pub(super) development: bool,
}

/// The edges that no rule allows.
pub(super) fn forbidden_edges(edges: &BTreeSet<Edge>) -> Vec<String> {
    let mut found = Vec::new();
    for Edge { from, to, development } in edges {
        if TOPS.contains(&to.as_str()) {
            found.push(format!("{from} -> {to}: nothing uses {to}"));
        }
        if TOPS.contains(&from.as_str()) || from == RENDER {
            continue;
        }
        if to == RENDER {
            found.push(format!("{from} -> {to}: only the builder and the tests use {to}"));
            continue;
        }
        let Some((_, normal, dev)) = EDGES.iter().find(|(name, ..)| name == from) else {
            found.push(format!("{from}: a crate that the rules do not know"));
            continue;
        };
        let allowed = normal.contains(&to.as_str()) || (*development && dev.contains(&to.as_str()));
        if !allowed {
            let kind = if *development { "a development dependency" } else { "a dependency" };
            found.push(format!("{from} -> {to}: {kind} that the rules do not allow"));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(from: &str, to: &str, development: bool) -> BTreeSet<Edge> {
        BTreeSet::from([Edge { from: from.into(), to: to.into(), development }])
    }

    #[test]
    fn the_three_base_crates_know_nothing_of_one_another() {
        let base = ["asperity-noise", "asperity-ndf-sampling", "asperity-fif"];
        for from in base {
            for to in base.into_iter().filter(|to| *to != from) {
                for development in [false, true] {
                    assert_eq!(forbidden_edges(&edge(from, to, development)).len(), 1, "{from} -> {to}");
                }
            }
        }
    }

    #[test]
    fn nothing_uses_the_tops_and_third_parties_are_listed() {
        assert!(!forbidden_edges(&edge("asperity-tests", "xtask", false)).is_empty());
        assert!(!forbidden_edges(&edge("asperity-noise", "serde", false)).is_empty());
        assert!(!forbidden_edges(&edge("asperity-noise", "criterion", false)).is_empty());
        assert!(!forbidden_edges(&edge("a-new-crate", "glam", false)).is_empty());
        assert!(forbidden_edges(&edge("asperity-noise", "criterion", true)).is_empty());
        assert!(forbidden_edges(&edge("asperity-shading", "asperity-noise", false)).is_empty());
        assert!(forbidden_edges(&edge("xtask", "serde", false)).is_empty());
    }
}
