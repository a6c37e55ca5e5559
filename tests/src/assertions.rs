//! Assertions of `approx` that also report which case failed.

/// `approx::assert_abs_diff_eq!` with a message after the tolerance, which the original does not
/// support.
///
/// ```
/// use asperity_tests::assert_abs_diff_eq;
///
/// for n in 1..9_u8 {
///     let n = f64::from(n);
///     assert_abs_diff_eq!(n.sqrt() * n.sqrt(), n, epsilon = 1e-14, "the root of {n}");
/// }
/// ```
#[macro_export]
macro_rules! assert_abs_diff_eq {
    ($given:expr, $expected:expr, epsilon = $epsilon:expr $(,)?) => {
        $crate::approx::assert_abs_diff_eq!($given, $expected, epsilon = $epsilon)
    };
    ($given:expr, $expected:expr, epsilon = $epsilon:expr, $($message:tt)+) => {
        match (&$given, &$expected, $epsilon) {
            (given, expected, epsilon) => assert!(
                $crate::approx::AbsDiffEq::abs_diff_eq(given, expected, epsilon),
                "{}: {given:?} is not {expected:?} within {epsilon:?}",
                format_args!($($message)+),
            ),
        }
    };
}

#[cfg(test)]
mod tests {
    #[test]
    #[should_panic(expected = "case 3: 1.0 is not 1.25 within 0.125")]
    fn failure_prints_case_both_sides_and_tolerance() {
        assert_abs_diff_eq!(1.0, 1.25, epsilon = 0.125, "case {}", 3);
    }

    #[test]
    #[should_panic(expected = "left  = NaN")]
    fn not_a_number_equals_nothing() {
        assert_abs_diff_eq!(f32::NAN, f32::NAN, epsilon = f32::INFINITY);
    }
}
