//! The program with `--check`, as the gate `generated tables` runs it.

use std::process::Command;

#[test]
#[ignore = "slow: the gate `generated tables`"]
fn generated_tables_are_up_to_date() {
    let check =
        Command::new(env!("CARGO_BIN_EXE_asperity-tables")).arg("--check").output().expect("a program");
    assert!(check.status.success(), "{}", String::from_utf8_lossy(&check.stderr));
}
