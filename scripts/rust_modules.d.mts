/** Returns a message for each cycle among the modules of a crate; `rootFile` is its `lib.rs` or `main.rs`. */
export function moduleCircles(rootFile: string): string[];
