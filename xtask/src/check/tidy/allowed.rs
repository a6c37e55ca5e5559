//! The dependencies that each package may have.

/// Package, its allowed dependencies, and its allowed development dependencies.
const ALLOWED: [(&str, &[&str], &[&str]); 8] = [
    ("asperity-core", &["approx", "fearless_simd", "glam", "libm"], &["approx", "libm"]),
    (
        "asperity-noise",
        &["approx", "asperity-core", "bytemuck", "fearless_simd", "glam", "libm", "serde"],
        &["criterion", "png"],
    ),
    (
        "asperity-ndf-sampling",
        &["approx", "asperity-core", "bytemuck", "glam", "rand", "serde"],
        &["criterion", "libm", "png"],
    ),
    (
        "asperity-fif",
        &["approx", "asperity-core", "bytemuck", "fearless_simd", "glam", "serde"],
        &["criterion", "png"],
    ),
    (
        "asperity-shading",
        &["approx", "asperity-core", "asperity-ndf-sampling", "asperity-noise", "bytemuck", "glam", "serde"],
        &["criterion", "png"],
    ),
    (
        "asperity-wgsl",
        &[
            "asperity-core",
            "asperity-fif",
            "asperity-ndf-sampling",
            "asperity-noise",
            "asperity-shading",
            "glam",
        ],
        &["bytemuck"],
    ),
    ("asperity-interpreter", &["naga", "rayon"], &["asperity-noise"]),
    ("asperity-output", &["tempfile"], &[]),
];

/// Packages that may use every package and that no package uses.
const TOPS: [&str; 5] =
    ["asperity-gallery", "asperity-platforms", "asperity-tables", "asperity-tests", "asperity-shader-tests"];

/// Packages that may use every package, and that only `TOPS` and each other use.
const TOOLS: [&str; 2] = ["asperity-render", "asperity"];

/// The task runner, which uses no crate of this workspace.
const XTASK: &str = "xtask";

/// Returns the rule that a dependency breaks, `None` if it is allowed.
pub(super) fn forbidden(from: &str, to: &str, development: bool) -> Option<String> {
    if TOPS.contains(&to) || to == XTASK {
        return Some(format!("{from} -> {to}: no package may use {to}"));
    }
    if from == XTASK {
        return to
            .starts_with("asperity")
            .then(|| format!("{from} -> {to}: it builds without this workspace's crates"));
    }
    if from == "asperity-tests" && TOOLS.contains(&to) {
        return Some(format!("{from} -> {to}: property tests use the five crates"));
    }
    if TOPS.contains(&from) || TOOLS.contains(&from) {
        return None;
    }
    if TOOLS.contains(&to) {
        return Some(format!("{from} -> {to}: only tools and tests use {to}"));
    }
    let Some((_, normal, dev)) = ALLOWED.iter().find(|(name, ..)| *name == from) else {
        return Some(format!("{from}: a package without rules"));
    };
    let kind = if development { "a development dependency" } else { "a dependency" };
    let allowed = normal.contains(&to) || development && dev.contains(&to);
    (!allowed).then(|| format!("{from} -> {to}: {kind} that the rules do not list"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dependency_rules() {
        let base = ["asperity-noise", "asperity-ndf-sampling", "asperity-fif"];
        for (from, to) in base.iter().flat_map(|from| base.iter().map(move |to| (from, to))) {
            assert!(
                forbidden(from, to, false).is_some() && forbidden(from, to, true).is_some(),
                "{from} -> {to}"
            );
        }
        for (from, to, development, allowed) in [
            ("asperity-tests", "xtask", false, false),
            ("asperity-noise", "asperity-shader-tests", true, false),
            ("asperity-shader-tests", "asperity-noise", true, true),
            ("asperity-noise", "asperity-render", true, false),
            ("asperity-noise", "rand", false, false),
            ("asperity-noise", "criterion", false, false),
            ("a-new-crate", "glam", false, false),
            ("asperity-noise", "criterion", true, true),
            ("asperity-shading", "asperity-noise", false, true),
            ("xtask", "serde_json", false, true),
            ("xtask", "asperity-output", false, false),
            ("asperity-gallery", "asperity", false, true),
            ("asperity-fif", "asperity", true, false),
            ("asperity-tests", "asperity-render", false, false),
        ] {
            assert_eq!(forbidden(from, to, development).is_none(), allowed, "{from} -> {to}");
        }
    }
}
