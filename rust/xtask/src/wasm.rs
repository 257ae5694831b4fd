//! `strut-wasm`, `strut-wasm-build`, `strut-wasm-walk` and `strut-wasm-key-style` → packages for JavaScript: cargo, wasm-bindgen and wasm-opt, one after the other.
//!
//! The environment steers it (DESIGN §3):
//! - `STRUT_BUILD_STD=1` builds the standard library from source, for a toolchain that lacks the target;
//! - `STRUT_WASM_CARGO` is the cargo to build with (default: the one that runs this program);
//! - `STRUT_WASM_CARGO_ARGS` are further arguments for it, separated by blanks.

use std::env;
use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

/// Features that every browser with WASM SIMD has (Chrome 91, Firefox 89, Safari 16.4) and that rustc emits.
/// Relaxed SIMD stays off: its results differ between machines.
const WASM_OPT_FLAGS: [&str; 10] = [
    "-O3",
    "--converge",
    "--enable-simd",
    "--enable-bulk-memory",
    "--enable-bulk-memory-opt",
    "--enable-nontrapping-float-to-int",
    "--enable-sign-ext",
    "--enable-mutable-globals",
    "--enable-reference-types",
    "--enable-multivalue",
];

/// LLVM inlines what it thinks fast until the module is larger than visitors should have to load. At this threshold, and with
/// wasm-opt's -O3 for its -Os, a frame takes an eighth less than at a quarter of it, and the module is a twentieth larger.
const INLINE_LESS: &str = "-Cllvm-args=-inline-threshold=100";

/// One of the packages.
pub(crate) struct Package {
    /// Where it goes, from the root of the repository.
    pub(crate) folder: &'static str,
    /// The crate that it is made of.
    crate_name: &'static str,
    /// Beginning of its files' names.
    name: &'static str,
    /// Features of the crate.
    features: &'static str,
    /// Further flags of the compiler.
    flags: &'static [&'static str],
    /// Whether the module uses SIMD.
    simd: bool,
    /// Further settings of cargo.
    config: &'static [&'static str],
}

/// A build takes seconds of work: whoever waits for it would rather load more.
const FAST_BUILDING: &[&str] = &["--config", "profile.web.package.strut-formats.opt-level=3"];

/// The yardsticks in `strut-wasm` are optimised as the core is.
const FAST_YARDSTICKS: &[&str] = &["--config", "profile.web.package.strut-wasm.opt-level=3"];

impl Package {
    /// What the page loads.
    pub(crate) const ENGINE: Self = Self {
        folder: "web/engine/pkg",
        crate_name: "strut-wasm",
        name: "strut_wasm",
        features: "",
        flags: &[INLINE_LESS],
        simd: true,
        config: &[],
    };
    /// What it loads for those who build a database of their own clips.
    pub(crate) const BUILD: Self = Self {
        folder: "web/engine/build/pkg",
        crate_name: "strut-wasm-build",
        name: "strut_wasm_build",
        flags: &[],
        config: FAST_BUILDING,
        ..Self::ENGINE
    };
    /// What it loads for those who open the Walk view.
    pub(crate) const WALK: Self = Self {
        folder: "web/engine/walk/pkg",
        crate_name: "strut-wasm-walk",
        name: "strut_wasm_walk",
        flags: &[],
        ..Self::ENGINE
    };
    /// What it loads for those who open the Key-style view.
    pub(crate) const KEY_STYLE: Self = Self {
        folder: "web/engine/key_style/pkg",
        crate_name: "strut-wasm-key-style",
        name: "strut_wasm_key_style",
        flags: &[],
        ..Self::ENGINE
    };
    /// The engine with what it is compared with, for those who open the Compare view.
    pub(crate) const COMPARE: Self =
        Self { folder: "web/engine/compare/pkg", name: "strut_compare", features: "compare", ..Self::ENGINE };
    /// The same with what visitors need not download: the report that `tests/parity` compares and the yardsticks of
    /// `bench/` …
    pub(crate) const BENCH: Self = Self {
        folder: "bench/pkg/simd",
        crate_name: "strut-wasm",
        name: "strut_bench",
        features: "bench parity",
        flags: &[INLINE_LESS],
        simd: true,
        config: FAST_YARDSTICKS,
    };
    /// … and without SIMD, whose bits must be the same.
    pub(crate) const BENCH_SCALAR: Self = Self { folder: "bench/pkg/scalar", simd: false, ..Self::BENCH };
}

/// Builds a package, or does nothing if it is up to date. Errors are sentences for people.
pub(crate) fn build(package: &Package) -> Result<(), String> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("xtask is not in a workspace")?;
    let repository = workspace.parent().ok_or("the workspace is not in a repository")?;
    let folder = repository.join(package.folder);

    let wasm = run_cargo(workspace, package)?;
    let wasm_opt = Some(repository.join("node_modules/binaryen/bin/wasm-opt")).filter(|path| path.is_file());
    let input = fs::read(&wasm).map_err(|e| format!("cannot read {}: {e}", wasm.display()))?;
    let stamp = stamp_of(package, &input, wasm_opt.as_deref());
    let stamp_file = folder.join("stamp");
    if fs::read_to_string(&stamp_file).is_ok_and(|old| old == stamp) {
        println!("{} is up to date", folder.display());
        return Ok(());
    }

    run_bindgen(&wasm, &folder, package.name)?;
    let output = folder.join(format!("{}_bg.wasm", package.name));
    let bound = size_of(&output)?;
    match &wasm_opt {
        Some(tool) => optimise(tool, &output, package.simd)?,
        None => println!("wasm-opt not found (npm install brings it): the package stays larger and slower"),
    }
    println!("wasm: {} kB from rustc, {} kB bound, {} kB final", input.len() / 1000, bound, size_of(&output)?);
    // Written last: an interrupted build has no stamp and is done again.
    fs::write(&stamp_file, stamp).map_err(|e| format!("cannot write {}: {e}", stamp_file.display()))
}

/// Compiles the crate and gives the path of the module.
fn run_cargo(workspace: &Path, package: &Package) -> Result<PathBuf, String> {
    let cargo = env::var_os("STRUT_WASM_CARGO").or_else(|| env::var_os("CARGO")).unwrap_or_else(|| "cargo".into());
    let target_dir = env::var_os("CARGO_TARGET_DIR").map_or_else(|| workspace.join("target"), PathBuf::from);
    let simd = if package.simd { "-Ctarget-feature=+simd128" } else { "-Ctarget-feature=-simd128" };
    let mut command = Command::new(cargo);
    command
        .current_dir(workspace)
        .args(["build", "--profile", "web", "--lib", "--package", package.crate_name, "--target", TARGET])
        .args(["--features", package.features])
        .args(package.config)
        // The encoded form has precedence over RUSTFLAGS, so that no flag of the user's can change results.
        .env("CARGO_ENCODED_RUSTFLAGS", [package.flags, &[simd]].concat().join("\x1f"));
    if env::var_os("STRUT_BUILD_STD").is_some_and(|v| v == "1") {
        command.arg("-Zbuild-std=std,panic_abort").env("RUSTC_BOOTSTRAP", "1");
    }
    if let Ok(more) = env::var("STRUT_WASM_CARGO_ARGS") {
        command.args(more.split_whitespace());
    }
    run(command, &format!("cargo build of {}", package.crate_name))?;
    Ok(target_dir.join(TARGET).join("web").join(format!("{}.wasm", package.crate_name.replace('-', "_"))))
}

/// Writes the JavaScript glue, its types and the module without the binding sections to `folder`.
fn run_bindgen(wasm: &Path, folder: &Path, name: &str) -> Result<(), String> {
    let _ = fs::remove_dir_all(folder);
    let mut bindgen = wasm_bindgen_cli_support::Bindgen::new();
    bindgen
        .web(true)
        .and_then(|b| {
            b.input_path(wasm)
                .out_name(name)
                .typescript(true)
                // `web/engine` finds the module itself, in Node as in a browser.
                .omit_default_module_path(true)
                .remove_producers_section(true)
                // A trap leaves the instance unusable; this lets `web/engine` start another.
                .reset_state_function(true)
                .generate(folder)
        })
        .map_err(|e| format!("wasm-bindgen: {e:#}"))
}

/// Runs wasm-opt on `module` in place.
fn optimise(tool: &Path, module: &Path, simd: bool) -> Result<(), String> {
    let mut command = Command::new("node");
    let flags = WASM_OPT_FLAGS.into_iter().filter(|flag| simd || *flag != "--enable-simd");
    command.arg(tool).args(flags).arg(module).arg("-o").arg(module);
    run(command, "wasm-opt")
}

fn run(mut command: Command, what: &str) -> Result<(), String> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{what} failed ({status})")),
        Err(e) => Err(format!("{what} cannot be started: {e}")),
    }
}

/// What the package depends on: the module, the tools and their settings. Not a promise of equality between
/// versions of the standard library, which only makes for one build too many.
fn stamp_of(package: &Package, input: &[u8], wasm_opt: Option<&Path>) -> String {
    let mut hasher = DefaultHasher::new();
    hasher.write(package.name.as_bytes());
    hasher.write(input);
    for flag in WASM_OPT_FLAGS {
        hasher.write(flag.as_bytes());
    }
    let version = wasm_opt
        .and_then(Path::parent)
        .and_then(Path::parent)
        .and_then(|binaryen| fs::read(binaryen.join("package.json")).ok());
    hasher.write(version.as_deref().unwrap_or_default());
    format!("{:016x}\n", hasher.finish())
}

/// Size of a file in kB.
fn size_of(path: &Path) -> Result<u64, String> {
    fs::metadata(path).map(|m| m.len() / 1000).map_err(|e| format!("cannot read {}: {e}", path.display()))
}
