//! Progress bars, on a terminal only, and the lines that stay.

use std::io::{self, IsTerminal, Write};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar with an open length; hidden unless standard error is a terminal.
pub fn bar(label: &str) -> ProgressBar {
    let terminal = io::stderr().is_terminal();
    let target = if terminal { ProgressDrawTarget::stderr_with_hz(8) } else { ProgressDrawTarget::hidden() };
    let bar = ProgressBar::with_draw_target(None, target);
    if let Ok(style) = ProgressStyle::with_template("{prefix} {wide_bar:.cyan/dim} {percent:>3} %  {elapsed}")
    {
        bar.set_style(style.progress_chars("━╸─"));
    }
    bar.set_prefix(label.to_owned());
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// Prints one line to standard error: what was done with a file that others would do otherwise.
pub fn note(line: &str) {
    let _ = writeln!(io::stderr().lock(), "note: {}", one_line(line));
}

/// A text in one line: names of files may have any characters, those that end lines and steer terminals among them.
pub fn one_line(text: &str) -> String {
    let shown = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
    text.chars().map(shown).collect()
}

/// Prints one line to standard output; a reader that has gone away is no error.
pub fn say(line: &str) {
    let _ = writeln!(io::stdout().lock(), "{line}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_with_a_line_in_it_is_one_line() {
        assert_eq!(one_line("mesh `a\nb\u{1b}[31m.obj`: é"), "mesh `a\\nb\\u{1b}[31m.obj`: é");
    }
}
