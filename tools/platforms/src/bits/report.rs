//! The probe's output: a digest per function, and the SIMD level.

use crate::failure::Result;

/// A function's digest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Row {
    pub(super) group: String,
    pub(super) name: String,
    pub(super) digest: String,
}

/// A machine's digests.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Report {
    /// The SIMD level of the machine.
    pub(super) level: String,
    pub(super) rows: Vec<Row>,
}

impl Report {
    /// Parses the probe's lines. Only the line of the SIMD level may differ from the golden file.
    pub(super) fn read(text: &str) -> Result<Self> {
        let (mut level, mut rows) = (String::new(), Vec::new());
        for line in text.lines() {
            let words: Vec<_> = line.split('\t').collect();
            match words[..] {
                ["level", name] => level = name.into(),
                [group, name, digest] => {
                    rows.push(Row { group: group.into(), name: name.into(), digest: digest.into() });
                }
                _ => {
                    return Err(
                        format!("digests: invalid line `{line}` (expected group, name, digest)").into()
                    );
                }
            }
        }
        if rows.is_empty() {
            return Err("digests: empty".into());
        }
        Ok(Self { level, rows })
    }

    /// Returns the lines without the SIMD level.
    pub(super) fn text(&self) -> String {
        self.rows.iter().map(|Row { group, name, digest }| format!("{group}\t{name}\t{digest}\n")).collect()
    }

    /// Returns the groups, in order.
    pub(super) fn groups(&self) -> Vec<&str> {
        let mut groups: Vec<_> = self.rows.iter().map(|row| row.group.as_str()).collect();
        groups.dedup();
        groups
    }

    /// Returns the rows that differ from `golden`, for display.
    pub(super) fn differences<'a>(&'a self, golden: &'a Self) -> impl Iterator<Item = (&'a str, String)> {
        let longest = self.rows.len().max(golden.rows.len());
        (0..longest).filter_map(|k| match (self.rows.get(k), golden.rows.get(k)) {
            (a, b) if a == b => None,
            (Some(a), Some(b)) if (&a.group, &a.name) == (&b.group, &b.name) => {
                Some((a.group.as_str(), a.name.clone()))
            }
            (Some(a), _) => Some((a.group.as_str(), format!("{} (not among the golden ones there)", a.name))),
            (None, b) => b.map(|b| (b.group.as_str(), format!("{} (missing)", b.name))),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str =
        "level\tneon\nnoise: kinds\tPerlin, 2-D\t01\nnoise: kinds\tvalue\t02\nfif: rays\ttorus\t03\n";

    #[test]
    fn report_round_trip_without_simd_level() {
        let report = Report::read(TEXT).unwrap();
        assert_eq!((report.level.as_str(), report.groups()), ("neon", vec!["noise: kinds", "fif: rays"]));
        assert_eq!(Report::read(&report.text()).unwrap().rows, report.rows);
        assert!(Report::read("level\tneon\n").is_err() && Report::read("a b c\n").is_err());
    }

    #[test]
    fn differences_lists_changed_missing_and_new_rows() {
        let golden = Report::read(TEXT).unwrap();
        let named = |text: &str| {
            let report = Report::read(text).unwrap();
            report.differences(&golden).map(|(_, name)| name).collect::<Vec<_>>()
        };
        assert!(named(TEXT).is_empty());
        assert_eq!(named(&TEXT.replace("02", "07")), ["value"]);
        assert_eq!(named(&TEXT[..TEXT.len() - "fif: rays\ttorus\t03\n".len()]), ["torus (missing)"]);
        assert_eq!(named(&format!("{TEXT}x\ty\t0\n")), ["y (not among the golden ones there)"]);
    }
}
