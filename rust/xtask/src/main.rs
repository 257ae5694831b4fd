//! Builds the WASM packages and the file of the built-in motions: `cargo run --profile tool -p xtask -- wasm`.
#![forbid(unsafe_code)]

mod motions;
mod wasm;

use std::process::ExitCode;
use wasm::Package;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let packages = |packages: &[Package]| packages.iter().try_for_each(wasm::build);
    let built = match &arguments[..] {
        [word] if word == "wasm" => {
            packages(&[Package::ENGINE, Package::BUILD, Package::WALK, Package::KEY_STYLE, Package::COMPARE])
        }
        [word] if word == "bench" => packages(&[Package::BENCH, Package::BENCH_SCALAR]),
        [word] if word == "motions" => motions::build(),
        _ => {
            let [engine, build, walk, key_style, compare, bench] =
                [Package::ENGINE, Package::BUILD, Package::WALK, Package::KEY_STYLE, Package::COMPARE, Package::BENCH]
                    .map(|p| p.folder);
            eprintln!("usage: xtask wasm     builds {engine} and {compare} from strut-wasm,");
            eprintln!("                      {build}, {walk} and {key_style} from their crates");
            eprintln!(
                "       xtask bench    builds {bench}, the same with reports and yardsticks, and its scalar twin"
            );
            eprintln!("       xtask motions  makes {}, the built-in motions that the page loads", motions::FILE);
            return ExitCode::from(2);
        }
    };
    match built {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
