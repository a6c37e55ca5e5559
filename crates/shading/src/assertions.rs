//! Assertions of `approx` that also say which case failed, for tests.

/// `approx::assert_abs_diff_eq!` with a message behind the tolerance, which that one cannot have.
macro_rules! assert_abs_diff_eq {
    ($given:expr, $expected:expr, epsilon = $epsilon:expr $(,)?) => {
        assert_abs_diff_eq!($given, $expected, epsilon = $epsilon, "compared")
    };
    ($given:expr, $expected:expr, epsilon = $epsilon:expr, $($message:tt)+) => {
        match (&$given, &$expected, $epsilon) {
            (given, expected, epsilon) => assert!(
                approx::AbsDiffEq::abs_diff_eq(given, expected, epsilon),
                "{}: {given:?} is not {expected:?} within {epsilon:?}",
                format_args!($($message)+),
            ),
        }
    };
}
