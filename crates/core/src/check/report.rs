//! Results of checks, with their values and limits.

use crate::short::Short;
use alloc::borrow::Cow;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

/// A list of checks in order, printed as one line each.
///
/// ```
/// use asperity_core::check::{Check, Limit, Report};
///
/// let mut report = Report::default();
/// report.add("energy", "albedo", 1.25, Limit::AtMost(1.0), "at 60°");
/// assert!(!report.passed());
/// assert_eq!(report.to_string(), "FAIL  energy: albedo = 1.25, must be at most 1, at 60°\n1 of 1 checks failed");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// The checks, in order.
    pub checks: Vec<Check>,
}

/// A measured quantity and its limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// Property that is checked.
    pub name: Cow<'static, str>,
    /// Quantity that was measured.
    pub quantity: &'static str,
    /// Its worst value.
    pub value: f64,
    /// Bound that the value must keep.
    pub limit: Limit,
    /// Place of the worst value; empty if there is only one place.
    pub place: String,
}

/// A limit of a measured quantity; NaN violates every limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// The largest value that passes.
    AtMost(f64),
    /// The smallest value that passes.
    AtLeast(f64),
}

impl Report {
    /// Whether all checks passed.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.checks.iter().all(Check::passed)
    }

    /// Names of the checks that failed.
    pub fn failures(&self) -> impl Iterator<Item = &str> {
        self.checks.iter().filter(|check| !check.passed()).map(|check| &*check.name)
    }

    /// Adds a check.
    pub fn add(
        &mut self,
        name: impl Into<Cow<'static, str>>,
        quantity: &'static str,
        value: f64,
        limit: Limit,
        place: impl Into<String>,
    ) {
        self.checks.push(Check { name: name.into(), quantity, value, limit, place: place.into() });
    }
}

impl Check {
    /// Whether the value is within its limit.
    #[must_use]
    pub fn passed(&self) -> bool {
        match self.limit {
            Limit::AtMost(most) => self.value <= most,
            Limit::AtLeast(least) => self.value >= least,
        }
    }
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AtMost(most) => write!(f, "at most {:.2}", Short(*most)),
            Self::AtLeast(least) => write!(f, "at least {:.2}", Short(*least)),
        }
    }
}

impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, quantity, value, limit, place } = self;
        let verdict = if self.passed() { "pass" } else { "FAIL" };
        write!(f, "{verdict}  {name}: {quantity} = {:.2}, must be {limit}", Short(*value))?;
        if place.is_empty() { Ok(()) } else { write!(f, ", {place}") }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.checks.iter().try_for_each(|check| writeln!(f, "{check}"))?;
        match (self.failures().count(), self.checks.len()) {
            (0, all) => write!(f, "all {all} checks passed"),
            (failed, all) => write!(f, "{failed} of {all} checks failed"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn nan_fails() {
        let mut report = Report::default();
        assert_eq!((report.passed(), &*report.to_string()), (true, "all 0 checks passed"));
        report.add("a", "x", f64::NAN, Limit::AtMost(1.0), "");
        report.add("b", "p", f64::NAN, Limit::AtLeast(1e-6), "");
        report.add("c", "x", 1e-4, Limit::AtMost(1e-3), "");
        assert!(report.failures().eq(["a", "b"]));
        assert!(
            report.to_string().ends_with("c: x = 1.00e-4, must be at most 0.001\n2 of 3 checks failed"),
            "{report}"
        );
    }
}
