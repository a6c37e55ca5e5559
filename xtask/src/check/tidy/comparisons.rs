//! Floats that tests compare by hand: an assertion whose condition is the size of a difference
//! against a bound.

/// The number of assertions of one source that compare by hand, examples in docs left out.
pub(super) fn by_hand(text: &str) -> usize {
    let code: Vec<&str> = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let code = code.join("\n");
    let conditions = code.split("assert!(").skip(1).map(condition);
    conditions.filter(|text| [".abs() <", ".abs_diff_eq("].iter().any(|sign| text.contains(sign))).count()
}

/// The text up to the bracket that closes what was opened before it.
fn condition(text: &str) -> &str {
    let mut depth = 1;
    let closes = |sign| {
        depth += i32::from(sign == '(') - i32::from(sign == ')');
        depth == 0
    };
    text.find(closes).map_or(text, |end| &text[..end])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_sizes_of_differences_in_assertions_count() {
        let text = "
            /// assert!((a - b).abs() < 1e-6);
            assert!((a - b).abs() < 1e-6, \"{a}\");
            assert!(
                normal.abs_diff_eq(other, 1e-6)
            );
            assert!(a < b); let x = (a - b).abs() < 1e-6;
        ";
        assert_eq!(by_hand(text), 2);
    }
}
