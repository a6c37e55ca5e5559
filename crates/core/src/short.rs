//! Numbers in messages.

use core::fmt;

/// Formats a float in scientific notation when it is very small or large.
///
/// The precision of the format applies to scientific notation only.
///
/// ```
/// use asperity_core::Short;
///
/// let numbers = [0.0, 0.25, 1e6, 1.234e-7].map(|x: f32| Short(x).to_string());
/// assert_eq!(numbers, ["0", "0.25", "1e6", "1.234e-7"]);
/// assert_eq!(format!("{:.1} {:.1}", Short(1.25), Short(1.25e7)), "1.25 1.2e7");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Short<T>(pub T);

impl<T: Copy + Into<f64> + fmt::Display + fmt::LowerExp> fmt::Display for Short<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (number, x) = (self.0, self.0.into());
        if x.is_finite() && x != 0.0 && !(1e-3..1e5).contains(&x.abs()) {
            fmt::LowerExp::fmt(&number, f)
        } else {
            write!(f, "{number}")
        }
    }
}
