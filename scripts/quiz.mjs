// The quiz of `npm run strips -- --quiz`: motions with meaningless names, the key, and the answer sheet.

import { generator, shuffled } from "./random.mjs";

/** Returns the key: every style of every action with a number, in shuffled order, and the seed of that order. */
export function keyOf(styles, actions, seed) {
  const motions = shuffled(
    actions.flatMap((action) => styles.map((style) => ({ style, action }))),
    generator(seed),
  );
  const digits = String(motions.length).length;
  return { seed, strips: motions.map((motion, i) => ({ name: String(i + 1).padStart(digits, "0"), ...motion })) };
}

/**
 * Returns the number of right answers, and which style was mistaken for which, most often first; one line each. Strips
 * without an answer do not count. The answer sheet contains the source of this function, which therefore calls no
 * other.
 * @param answers the chosen style by the name of a strip
 */
export function mark(answers, strips) {
  const answered = strips.filter(({ name }) => answers[name]);
  const wrong = answered.filter(({ name, style }) => answers[name] !== style);
  const taken = new Map();
  for (const { name, style, action } of wrong) {
    const mistake = `${style} taken for ${answers[name]}`;
    taken.set(mistake, [...(taken.get(mistake) ?? []), `${name} (${action})`]);
  }
  const mistakes = [...taken].sort(([, a], [, b]) => b.length - a.length);
  return [
    `${answered.length - wrong.length} of ${answered.length} are right.`,
    ...mistakes.map(([mistake, names]) => `${mistake}: ${names.join(", ")}`),
  ];
}

/**
 * Returns the answer sheet, an HTML page for the pictures `{name}.png`: styles to choose from, and a field to open the
 * key.
 */
export function answerSheet(names, styles) {
  const options = ["", ...styles].map((style) => `<option>${style}</option>`).join("");
  const questions = names.map(
    (name) => `<p><label>${name} <select name="${name}">${options}</select></label><br />
  <img src="${name}.png" alt="Strip ${name}" /></p>`,
  );
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8" />
<title>Name the style at sight</title>
<style>
body { margin: 2rem auto; max-width: 1140px; font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fff; }
img { max-width: 100%; border: 1px solid #ccc; }
output { display: block; white-space: pre-line; }
</style>
</head>
<body>
<h1>Name the style at sight</h1>
<p>Every picture shows one motion twice, from the side and from the front. The styles are ${styles.join(", ")}.
Answers are kept until this page is closed.</p>
<form>
${questions.join("\n")}
</form>
<p><label>When all is answered, open the key, quiz-key.json: <input type="file" accept=".json" /></label></p>
<output></output>
<script>
${mark}
document.querySelector("input").addEventListener("change", async ({ target }) => {
  const output = document.querySelector("output");
  try {
    const { strips } = JSON.parse(await target.files[0].text());
    output.textContent = mark(Object.fromEntries(new FormData(document.querySelector("form"))), strips).join("\\n");
  } catch {
    output.textContent = "This file is no key of a quiz.";
  }
  // Opening it once more, after other answers, is a change too.
  target.value = "";
});
</script>
</body>
</html>
`;
}
