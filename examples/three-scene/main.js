// A neutral walk, restyled while it plays, on a figure that Strut has never seen.
import { loadStrut } from "strut-motion";
import { Figure } from "./figure.js";
import { Studio } from "./studio.js";

const message = document.querySelector("#message");
try {
  await main();
  message.textContent = "";
} catch (error) {
  // Strut's errors are sentences for people, with a hint what to do.
  message.textContent = `${error.message} ${error.hint ?? ""}`;
}

async function main() {
  // The engine runs in a worker. A database says what the styles are; this one is built in.
  const strut = await loadStrut();
  const database = await strut.openDatabase("strut:walk");
  const walk = await strut.openMotion("strut:neutral-walk");
  const playback = await strut.createPlayback(walk, database, { styles: { proud: 1 } });

  const figure = new Figure(database.info.proportions);
  const studio = new Studio(document.querySelector("canvas"));
  studio.scene.add(figure.root);
  showStyles(database.info.styles, playback);

  let before = performance.now();
  let first = true;
  const draw = async (now) => {
    // A page in the background draws nothing; the walk waits for it.
    const dtSecs = Math.min((now - before) / 1000, 0.1);
    before = now;
    // The engine goes on by so many seconds and answers within a millisecond or two.
    const frame = await playback.step(dtSecs);
    figure.pose(frame.pose);
    figure.plant(frame.planted);
    studio.draw(figure.root.position, dtSecs, first || frame.looped);
    first = false;
    requestAnimationFrame(draw);
  };
  requestAnimationFrame(draw);
}

/** A choice of the database's styles. A change fades in by itself. */
function showStyles(styles, playback) {
  const form = document.querySelector("form");
  for (const style of styles) {
    const label = document.createElement("label");
    const choice = Object.assign(document.createElement("input"), { type: "radio", name: "style", value: style });
    choice.checked = style === "proud";
    label.append(choice, style);
    form.querySelector("fieldset").append(label);
  }
  form.oninput = () => {
    const { style, amount } = Object.fromEntries(new FormData(form));
    form.querySelector("output").textContent = Number(amount).toFixed(1);
    // Weights are how much of each style; what is missing to 1 stays neutral, above 1 is caricature.
    void playback.configure({ styles: { [style]: Number(amount) } });
  };
  form.classList.add("ready");
}
