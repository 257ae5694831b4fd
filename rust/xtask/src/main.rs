//! Builds the WASM packages: `cargo run --profile tool -p xtask -- wasm`.
#![forbid(unsafe_code)]

mod wasm;

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let packages: &[wasm::Package] = match &arguments[..] {
        [word] if word == "wasm" => &[wasm::Package::ENGINE, wasm::Package::BUILD],
        [word] if word == "bench" => &[wasm::Package::BENCH, wasm::Package::BENCH_SCALAR],
        _ => {
            let folders = [wasm::Package::ENGINE, wasm::Package::BUILD, wasm::Package::BENCH].map(|p| p.folder);
            let [engine, build, bench] = folders;
            eprintln!("usage: xtask wasm     builds {engine} from strut-wasm and {build} from strut-wasm-build");
            eprintln!(
                "       xtask bench    builds {bench}, the same with reports and yardsticks, and its scalar twin"
            );
            return ExitCode::from(2);
        }
    };
    match packages.iter().try_for_each(wasm::build) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
