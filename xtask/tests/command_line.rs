//! The builder as a program: what it answers to a command line, before it does anything.

use std::process::{Command, Output};

fn xtask(arguments: &[&str]) -> Output {
    let mut builder = Command::new(env!("CARGO_BIN_EXE_xtask"));
    builder.args(arguments).env_remove("FASTNOISE2_LIB_DIR").output().expect("the builder runs")
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
fn a_command_that_cannot_be_done_says_in_one_line_why() {
    for (line, said) in [
        ("ci --only nowhere", "no gate's name contains `nowhere`; gates are format, tidy, "),
        ("gallery --only nowhere", "no figure is called `nowhere`; there are "),
        ("gallery --only kautz --out Cargo.toml/x", "cannot write Cargo.toml/x: "),
        ("tables --ndf velvet", "density `velvet`: neither `ggx:AX[,AY]`, "),
        ("tables --ndf ggx:0", "density `ggx:0`: alpha_x must be "),
        ("tables --normal-map nowhere.png", "density `normal-map:nowhere.png`: the file cannot be read: "),
        ("tables --fif nowhere.json", "system `nowhere.json`: "),
        ("tables --fif Cargo.toml", "system `Cargo.toml`: "),
        ("tables --out Cargo.toml/x", "cannot write Cargo.toml/x: "),
        ("render --mesh nowhere.stl", "mesh `nowhere.stl`: the name of a mesh file ends in "),
        ("render --light nowhere.exr", "light `nowhere.exr`: the file cannot be read: "),
        ("render --light lamps --scene car", "lamps light the teapot, the sphere and the plane only; "),
        ("render --out src", "`src` is a folder; "),
        ("render --out a.jpg", "picture `a.jpg`: its name must end in .png or .exr"),
        ("render --out Cargo.toml/a.png", "cannot write "),
        ("bench --peers --ship", "FastNoise2 is not measured: "),
    ] {
        let output = xtask(&line.split(' ').collect::<Vec<_>>());
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(error.starts_with(&format!("error: {said}")), "{line}: {error}");
        assert!(output.status.code() == Some(1) && error.trim_end().lines().count() == 1, "{line}: {error}");
    }
}
