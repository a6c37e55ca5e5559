//! Whether a formula of the thesis is taken as it was printed.

/// Which of two forms of a formula: the one that its source prints, or the one that does what its source says.
///
/// The printed form is there to be compared with; what differs is documented at each function that takes a form.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Form {
    /// Printed form, errors included.
    Printed,
    /// Form that does what the source's text says.
    #[default]
    Corrected,
}
