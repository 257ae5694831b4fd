// The widget's page side. anywidget loads it from a blob, which has no folder to fetch files from: hence `./inline`, which
// has the engine within, and the built-in walks as bytes (esbuild --loader:.bin=binary).
import walks from "strut-motion/assets/walk.bin";
import { loadStrut } from "strut-motion/inline";
import { drawFigure } from "./figure.js";

const WIDTH = 640;
const HEIGHT = 300;

async function render({ model, el }) {
  const canvas = element("canvas", { width: WIDTH * 2, height: HEIGHT * 2 });
  canvas.style.cssText = `display: block; width: ${WIDTH}px; max-width: 100%`;
  const seek = element("input", { type: "range", min: 0, max: 0, ariaLabel: "Frame" });
  seek.style.cssText = `width: ${WIDTH}px; max-width: 100%`;
  const message = element("div", { role: "status", textContent: "Loading the engine…" });
  el.append(canvas, seek, message);

  const address = URL.createObjectURL(new Blob([walks]));
  const strut = await loadStrut({ assets: (file) => (file === "walk.bin" ? address : file) });
  const database = await strut.openDatabase("strut:walk");
  // Poses of the input, the styled motion, and what ends the styling that is under way.
  let [input, output, running] = [undefined, undefined, undefined];

  const draw = () => {
    if (!output) return;
    const frame = Math.max(0, Math.min(model.get("frame"), Number(seek.max)));
    seek.value = frame;
    const at = (poses) => poses.subarray(87 * frame, 87 * (frame + 1));
    drawFigure(canvas, database.info.proportions, at(output.poses), at(input));
  };
  const restyle = async () => {
    // Whoever moves a slider in Python asks faster than a whole walk is styled: only the last one counts.
    running?.abort();
    running = new AbortController();
    const { signal } = running;
    let motion;
    try {
      motion = await strut.openMotion(model.get("source"), { signal });
      const poses = await motion.poses(database, { signal });
      const styled = await strut.stylize(motion, database, { styles: model.get("styles"), signal });
      if (signal.aborted) return;
      [input, output] = [poses, styled];
      seek.max = poses.length / 87 - 1;
      message.textContent = "";
      model.set("bvh", new TextEncoder().encode(styled.toBVH()));
      model.save_changes();
      draw();
    } catch (error) {
      if (!signal.aborted) message.textContent = `${error.message} ${error.hint ?? ""}`;
    } finally {
      // What is open in the engine takes memory until it is disposed of.
      motion?.dispose();
    }
  };
  seek.oninput = () => {
    model.set("frame", Number(seek.value));
    model.save_changes();
  };
  model.on("change:frame", draw);
  model.on("change:styles change:source", restyle);
  await restyle();

  // The cell was cleared.
  return () => {
    model.off("change:frame", draw);
    model.off("change:styles change:source", restyle);
    running?.abort();
    strut.dispose();
    URL.revokeObjectURL(address);
  };
}

const element = (tag, properties) => Object.assign(document.createElement(tag), properties);

export default { render };
