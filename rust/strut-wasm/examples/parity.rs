//! Prints the native parity report: `parity [FILE.bvh…]`. See `tests/parity`.

use std::path::Path;
use std::process::ExitCode;
use strut_wasm::engine::ParityReport;

fn main() -> ExitCode {
    let mut report = ParityReport::new();
    for path in std::env::args().skip(1) {
        let name = Path::new(&path).file_name().unwrap_or_default().to_string_lossy().into_owned();
        match std::fs::read(&path) {
            Ok(bytes) => report.add_file(&name, &bytes),
            Err(e) => {
                eprintln!("error: {path}: {e}");
                return ExitCode::FAILURE;
            }
        }
    }
    match report.run(None) {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(e) => {
            eprintln!("error: {}", e.message());
            ExitCode::FAILURE
        }
    }
}
