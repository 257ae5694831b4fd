//! Writes the database of the benchmarks: `benchmark_database FRAMES FILE`.

use std::error::Error;
use strut_core::search::Index;
use strut_demo::benchmark;
use strut_formats::strutdb;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [frames, file] = &arguments[..] else { return Err("expected FRAMES and FILE".into()) };
    let database = benchmark::database(frames.parse()?)?;
    std::fs::write(file, strutdb::write(&database, &Index::build(&database).plan(), strut_formats::GENERATOR))?;
    Ok(())
}
