/** The circles among the modules of a crate, one sentence each; `rootFile` is its `lib.rs` or `main.rs`. */
export function moduleCircles(rootFile: string): string[];
