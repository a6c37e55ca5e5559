//! The builder as a program: what it answers to a command line, before it does anything.

use std::process::{Command, Output};

fn xtask(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_xtask")).args(arguments).output().expect("the builder runs")
}

#[test]
fn every_command_explains_itself() {
    let said = String::from_utf8(xtask(&["--help"]).stdout).unwrap();
    for command in ["gallery", "tables", "render", "bench", "tidy", "ci", "no-std", "bare-metal"] {
        assert!(said.contains(&format!("\n  {command} ")), "{command} is missing in:\n{said}");
        assert!(xtask(&[command, "--help"]).status.success(), "{command} --help");
    }
}

#[test]
fn a_gate_that_is_not_there_is_refused_by_name() {
    let output = xtask(&["ci", "--only", "no such gate"]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success() && said.contains("clippy"), "{said}");
}
