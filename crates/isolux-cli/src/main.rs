//! The isolux command.

use std::process::ExitCode;

fn main() -> ExitCode {
    isolux_cli::command(std::env::args_os()).into()
}
