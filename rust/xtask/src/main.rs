//! Binds a WebAssembly module to JavaScript with the version of wasm-bindgen it was compiled with: `xtask bind MODULE
//! FOLDER NAME`. `scripts/wasm.mjs` compiles the modules and runs this.
#![forbid(unsafe_code)]

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [command, module, folder, name] = &arguments[..] else { return usage() };
    if command != "bind" {
        return usage();
    }
    match bind(Path::new(module), Path::new(folder), name) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn usage() -> ExitCode {
    eprintln!("usage: xtask bind MODULE FOLDER NAME   writes NAME.js, its types and NAME_bg.wasm to FOLDER");
    ExitCode::from(2)
}

/// Writes the JavaScript, its types and the module without the binding sections to `folder`.
fn bind(module: &Path, folder: &Path, name: &str) -> Result<(), String> {
    let mut bindgen = wasm_bindgen_cli_support::Bindgen::new();
    bindgen
        .web(true)
        .and_then(|bindgen| {
            bindgen
                .input_path(module)
                .out_name(name)
                .typescript(true)
                // `web/engine` finds the module without help, in Node and in a browser.
                .omit_default_module_path(true)
                .remove_producers_section(true)
                // A trap makes the instance unusable; this lets `web/engine` start another.
                .reset_state_function(true)
                .generate(folder)
        })
        .map_err(|error| format!("{}: {error:#}", module.display()))
}
