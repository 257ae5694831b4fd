/**
 * The native programs with which tests compare the page: those of Rust's own tests, compiled almost like the released
 * ones.
 */
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { root } from "./recordings";

const rust = join(root, "rust");

/** The `strut` command, once {@link buildPrograms} has returned. */
export const COMMAND = join(rust, "target", "debug", "strut");
/** The report of `rust/strut-wasm/src/engine/parity.rs`, once {@link buildPrograms} has returned. */
export const REPORT = join(rust, "target", "debug", "examples", "parity");

/** A scripted drive, `rust/strut-wasm/examples/scripted_drive.rs`, once {@link buildPrograms} has returned. */
export const DRIVE = join(rust, "target", "debug", "examples", "scripted_drive");

/** Updates the programs: after `cargo tests` there is nothing to do. */
export function buildPrograms(): void {
  execFileSync(process.env.CARGO ?? "cargo", ["tests", "--no-run", "--quiet"], { cwd: rust, stdio: "pipe" });
}
