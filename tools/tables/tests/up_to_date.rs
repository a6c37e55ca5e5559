//! The program with `--check`, which the CI check `generated tables` runs on every change.

use std::process::Command;

#[test]
#[ignore = "slow: weekly"]
fn generated_tables_are_up_to_date() {
    let check =
        Command::new(env!("CARGO_BIN_EXE_asperity-tables")).arg("--check").output().expect("a program");
    assert!(check.status.success(), "{}", String::from_utf8_lossy(&check.stderr));
}
