/** An equation, as markup: `scripts/katex_plugin.mjs` renders it when the page is built. */
declare module "*.tex" {
  const markup: string;
  export default markup;
}
