//! Builds the WASM package: `cargo run --profile tool -p xtask -- wasm`.
#![forbid(unsafe_code)]

mod wasm;

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments != ["wasm"] {
        eprintln!("usage: xtask wasm    builds web/engine/pkg from strut-wasm");
        return ExitCode::from(2);
    }
    match wasm::build() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
