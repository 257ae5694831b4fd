/** The native programs that tests compare the page with: those of Rust's own tests, compiled as the released ones nearly are. */
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { root } from "./recordings";

const rust = join(root, "rust");

/** The `strut` command, once {@link buildPrograms} has returned. */
export const COMMAND = join(rust, "target", "debug", "strut");
/** The report of `rust/strut-wasm/src/parity.rs`, likewise. */
export const REPORT = join(rust, "target", "debug", "examples", "parity");

/** A drive by a script, `rust/strut-wasm-drive/examples/scripted_drive.rs`, likewise. */
export const DRIVE = join(rust, "target", "debug", "examples", "scripted_drive");

/** Brings the programs up to date: after `cargo tests` there is nothing to do. */
export function buildPrograms(): void {
  execFileSync(process.env.CARGO ?? "cargo", ["tests", "--no-run", "--quiet"], { cwd: rust, stdio: "pipe" });
}
