/** Recorded tables: `scripts/evaluation_plugin.mjs` reads them from the document when the page is built. */
declare module "*/docs/evaluation.md" {
  type Row = Readonly<Record<string, number | string>>;
  export const oneActionEveryMethod: readonly Row[];
  export const motionThatTheDatabaseDoesNotHoldMethods: readonly Row[];
  export const theBuiltInMotions: readonly Row[];
}
