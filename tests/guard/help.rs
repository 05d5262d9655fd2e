//! The help of every subcommand, at a width of 100.

use assert_cmd::Command;

use crate::snapshot::check_each;

fn help(arguments: &[&str]) -> String {
    let mut command = Command::cargo_bin("rockfrag").unwrap();
    let output = command.env("COLUMNS", "100").args(arguments).arg("--help").output().unwrap();
    assert!(output.status.success(), "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// The names under the head "Commands:".
fn subcommands(help: &str) -> Vec<String> {
    let list = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let is_name = |line: &&str| line.starts_with("  ") && !line.starts_with("   ");
    list.lines().filter(is_name).map(|line| line.split_whitespace().next().unwrap().to_string()).collect()
}

#[test]
fn help_texts() {
    let top = help(&[]);
    let of_each = subcommands(&top);
    let of_each = of_each.iter().filter(|name| *name != "help");
    let of_each = of_each.map(|name| (name.clone(), help(&[name]))).collect::<Vec<_>>();
    assert!(of_each.len() > 10, "{top}");
    check_each("help", [("rockfrag".to_string(), top)].into_iter().chain(of_each));
}
