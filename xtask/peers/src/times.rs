//! Times of every contender in every round, as printed.

use serde::Serialize;

use crate::{measure::Contender, row::Row};

/// The whole measurement.
#[derive(Debug, Serialize)]
pub(crate) struct Times {
    pub(crate) step: f32,
    pub(crate) rounds: u32,
    pub(crate) rows: Vec<RowTimes>,
}

/// One row of it.
#[derive(Debug, Serialize)]
pub(crate) struct RowTimes {
    name: String,
    samples: usize,
    contenders: Vec<ContenderTimes>,
}

#[derive(Debug, Serialize)]
struct ContenderTimes {
    library: &'static str,
    version: String,
    level: String,
    /// Per sample, by round.
    nanoseconds: Vec<f64>,
}

impl RowTimes {
    pub(crate) fn new(row: Row, contenders: &[Contender], times: Vec<Vec<f64>>) -> Self {
        let contenders_times = contenders
            .iter()
            .zip(times)
            .map(|(contender, nanoseconds)| ContenderTimes {
                library: contender.library,
                version: version(contender.library),
                level: contender.level.to_string(),
                nanoseconds,
            })
            .collect();
        Self {
            name: row.to_string(),
            samples: contenders.first().map_or(0, |c| c.samples),
            contenders: contenders_times,
        }
    }
}

/// The version that the lockfile holds.
fn version(library: &str) -> String {
    let package = match library {
        "asperity" => "asperity-noise",
        "fastnoise2" => "fastnoise2-sys",
        other => other,
    };
    let head = format!("name = \"{package}\"\nversion = \"");
    let lock = include_str!("../Cargo.lock");
    let after = lock.split_once(&head).and_then(|(_, rest)| rest.split_once('"'));
    after.map_or_else(String::new, |(version, _)| version.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lockfile_knows_every_library() {
        assert_eq!(version("asperity"), env!("CARGO_PKG_VERSION"));
        assert!(version("simdnoise").starts_with("3.1."), "{}", version("simdnoise"));
        assert_eq!(version("no-such-library"), "");
    }
}
