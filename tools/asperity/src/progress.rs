//! Progress bars, shown only on a terminal, and permanent output lines.

use std::io::{self, IsTerminal, Write};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Returns a bar without a fixed length. The bar is hidden unless standard error is a terminal.
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

/// Prints a note to standard error, about a choice the program made for an input file.
pub fn note(line: &str) {
    let _ = writeln!(io::stderr().lock(), "note: {}", one_line(line));
}

/// Escapes control characters, so that file names cannot break a line or control the terminal.
pub fn one_line(text: &str) -> String {
    let shown = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
    text.chars().map(shown).collect()
}

/// Prints text whose loss is an error, unless the reader stopped reading.
pub fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error),
        _ => Ok(()),
    }
}

/// Prints one line to standard output and ignores a closed pipe.
pub fn say(line: &str) {
    let _ = writeln!(io::stdout().lock(), "{line}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_line_escapes_control_characters() {
        assert_eq!(one_line("mesh `a\nb\u{1b}[31m.obj`: é"), "mesh `a\\nb\\u{1b}[31m.obj`: é");
    }
}
