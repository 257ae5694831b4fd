//! Builds the WASM packages: `cargo run --profile tool -p xtask -- wasm`.
#![forbid(unsafe_code)]

mod wasm;

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let package = match &arguments[..] {
        [word] if word == "wasm" => wasm::Package::ENGINE,
        [word] if word == "parity" => wasm::Package::PARITY,
        _ => {
            eprintln!("usage: xtask wasm      builds {} from strut-wasm", wasm::Package::ENGINE.folder);
            eprintln!("       xtask parity    builds {}, the same with a report", wasm::Package::PARITY.folder);
            return ExitCode::from(2);
        }
    };
    match wasm::build(&package) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
