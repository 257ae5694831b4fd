/** Files that `scripts/package.mjs` writes into an entry. */
declare module "strut-inline:*.wasm" {
  /** Deflated bytes. */
  const bytes: Uint8Array<ArrayBuffer>;
  export default bytes;
}

declare module "strut-inline:*.js" {
  const text: string;
  export default text;
}
