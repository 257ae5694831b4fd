//! The built-in motions, made once and deflated, for the page to load.

use flate2::{Compression, GzBuilder};
use std::env;
use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::io::Write;
use std::path::Path;
use strut_demo::{database, input_clips};
use strut_formats::strutdb::packed::{self, NamedMotion};

/// Where they go, from the root of the repository.
pub(crate) const FILE: &str = "web/engine/motions/built_in.bin";

/// Makes the file, or does nothing if it is up to date. Errors are sentences for people.
pub(crate) fn build() -> Result<(), String> {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).ok_or("xtask is not in a repository")?;
    let file = repository.join(FILE);
    let stamp_file = file.with_extension("stamp");
    let stamp = stamp()?;
    if file.is_file() && fs::read_to_string(&stamp_file).is_ok_and(|old| old == stamp) {
        println!("{} is up to date", file.display());
        return Ok(());
    }
    let database = database().map_err(|e| e.to_string())?;
    let inputs: Vec<NamedMotion> =
        input_clips().into_iter().map(|c| NamedMotion { name: c.name.into(), motion: c.motion }).collect();
    let packed = packed::write(&database, &inputs, "strut");
    let bytes = deflated(&packed).map_err(|e| format!("the built-in motions cannot be deflated: {e}"))?;
    let unwritten = |e| format!("cannot write {}: {e}", file.display());
    fs::create_dir_all(file.parent().unwrap_or(repository)).map_err(unwritten)?;
    fs::write(&file, &bytes).map_err(unwritten)?;
    println!("built-in motions: {} frames, {} kB", database.frames(), bytes.len() / 1000);
    // Written last: an interrupted build has no stamp and is done again.
    fs::write(&stamp_file, stamp).map_err(unwritten)
}

fn deflated(bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut gzip = GzBuilder::new().write(Vec::new(), Compression::best());
    gzip.write_all(bytes)?;
    gzip.finish()
}

/// The motions are a function of this program, whatever part of it changes.
fn stamp() -> Result<String, String> {
    let program = env::current_exe().and_then(fs::read).map_err(|e| format!("cannot read this program: {e}"))?;
    let mut hasher = DefaultHasher::new();
    hasher.write(&program);
    Ok(format!("{:016x}\n", hasher.finish()))
}
