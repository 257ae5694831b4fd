// Converts equations to HTML and MathML at build time: the page contains no script of KaTeX.
import katex from "katex";

/** Families of KaTeX's fonts that equations of the lessons use; `web/lessons/lessons.test.ts` refuses others. */
const FONTS = ["KaTeX_Main", "KaTeX_Math", "KaTeX_Size1", "KaTeX_Size2", "KaTeX_Size3"];

/** A symbol that highlights its marks: `\term{name}{symbol}`. */
const MACROS = { "\\term": "\\htmlData{term=#1}{#2}" };

/**
 * Returns an equation as markup. The page's policy forbids style attributes: they become `data-css`, which a script
 * applies.
 */
export function renderEquation(tex) {
  const markup = katex.renderToString(tex.trim(), {
    displayMode: true,
    output: "htmlAndMathml",
    throwOnError: true,
    trust: ({ command }) => command === "\\htmlData",
    strict: (code) => (code === "htmlExtension" ? "ignore" : "error"),
    macros: { ...MACROS },
  });
  return markup.replaceAll(' style="', ' data-css="');
}

/**
 * Returns KaTeX's style sheet with only the fonts that are used, in the one format that every supported browser reads.
 */
export function trimmedSheet(css) {
  return css.replace(/@font-face\{[^}]*\}/g, (face) => {
    const family = /font-family:"?([\w]+)"?/.exec(face)?.[1];
    const plain = /font-weight:400/.test(face) || !/font-weight/.test(face);
    if (!FONTS.includes(family) || !plain) return "";
    return face.replace(/,url\([^)]*\.(woff|ttf)\) format\("[a-z]+"\)/g, "");
  });
}

/** Vite's plugin: `.tex` files are modules of markup, and KaTeX's style sheet has only what is used. */
export function katexPlugin() {
  return {
    name: "strut-katex",
    enforce: "pre",
    transform(code, id) {
      const [file] = id.split("?");
      if (file.endsWith(".tex")) return { code: `export default ${JSON.stringify(renderEquation(code))};`, map: null };
      if (file.endsWith("katex.min.css")) return { code: trimmedSheet(code), map: null };
      return null;
    },
  };
}
