//! A scene as built in, with points and the right illuminance there, as JSON for the scripts of
//! `benchmarks/peers`: `cargo run --release -p isolux-compare --example peers -- cube`.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "an example for the terminal")]

use std::process::ExitCode;

fn main() -> ExitCode {
    let name = std::env::args().nth(1).unwrap_or_default();
    let Some(scene) = isolux_compare::peers::scene(&name) else {
        eprintln!(
            "there are no points for a scene `{name}`; choose cube, sphere, hall or a case of `isolux validate`"
        );
        return ExitCode::from(2);
    };
    println!("{scene}");
    ExitCode::SUCCESS
}
