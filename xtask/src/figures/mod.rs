//! Every figure of the gallery, in the order of the page.

use crate::figure::Figure;

/// The figures, in the order of the page.
pub(crate) const FIGURES: &[Figure] = &[];
