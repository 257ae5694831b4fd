/** The calls of the lessons' engine. */
import { loadBuiltIn } from "../../engine/built_in";
import { Engine } from "../../engine/engine";
import { StrutError } from "../../engine/errors";
import type { Lens } from "../../engine/learn/lens";
import { performedIn } from "../../engine/learn/wasm";
import { loadedOnce } from "../../engine/loaded_once";
import { createKeyStyles } from "./key_styles";
import { Opened } from "./opened";
import type { LearnEngine, WindowsOrder } from "./protocol";
import { createWalks } from "./walks";

const NO_CHANGE = { turns: [], heading: 0, x: 0, z: 0, reversed: false };

/** The requested class. @throws StrutError `bad-input` if no class has neighbours */
function classOf(lens: Lens, order: WindowsOrder): number {
  const found = order.class ?? lens.heaviestClass();
  if (found === undefined)
    throw new StrutError({ code: "bad-input", message: "There is no class near this pose.", hint: "" });
  return found;
}

/** The functions behind {@link LearnEngine}. */
export function createLearnTable(): LearnEngine {
  const opened = loadedOnce(async () => {
    const [engine, motions] = await Promise.all([Engine.load(), loadBuiltIn()]);
    return new Opened(engine, motions);
  });
  return {
    inputs: async () => {
      const { engine, motions } = await opened();
      return engine.inputsOf(motions);
    },
    styles: async () => {
      const { styles, neutral } = (await opened()).database.info;
      return [neutral, ...styles.filter((style) => style !== neutral)];
    },
    database: async () => structuredClone((await opened()).database.info),
    motion: async (input) => {
      const open = await opened();
      const { neutral, proportions } = open.database.info;
      const { poses, contacts, rateHz } = open.input(input).info;
      const lens = open.look({ input, styles: { [neutral]: 1 }, frame: 0 });
      return structuredClone({ poses, contacts, rateHz, proportions, rows: lens.rows(), means: lens.means() });
    },
    counterpart: async (input, style) => {
      await opened();
      return performedIn(input, style);
    },
    stylize: async (of, options) => {
      const open = await opened();
      const stylizer = open.engine.createStylizer(open.databaseOf(of), options);
      const job = open.engine.createClipJob(open.input(of), stylizer);
      try {
        job.run(job.frames);
        return job.result();
      } finally {
        job.dispose();
        stylizer.dispose();
      }
    },
    styled: async (look) => {
      const lens = (await opened()).look(look);
      return { pose: lens.styled(), secs: lens.stepSecs(), heaviestClass: lens.heaviestClass() };
    },
    classes: async (look) => (await opened()).look(look).classes(),
    neighbours: async (look, k, order) => {
      const lens = (await opened()).look(look);
      lens.query(order.query ?? NO_CHANGE);
      return lens.neighbours(classOf(lens, order), k, order.length);
    },
    profile: async (look, order) => {
      const lens = (await opened()).look(look);
      const query = lens.query(order.query ?? NO_CHANGE);
      const of = classOf(lens, order);
      return { class: of, firstRow: lens.firstRow(of), distances: lens.profile(of, order.length), query };
    },
    rowPoses: async (rows) => {
      const open = await opened();
      const [name] = open.engine.inputsOf(open.motions);
      const { neutral } = open.database.info;
      const lens = open.look({ input: { name: name! }, styles: { [neutral]: 1 }, frame: 0 });
      const poses = rows.map((row) => lens.rowPose(row));
      const all = new Float32Array(poses.reduce((sum, pose) => sum + pose.length, 0));
      poses.forEach((pose, i) => {
        all.set(pose, i * pose.length);
      });
      return all;
    },
    fit: async (look, settings) => (await opened()).look(look).fit(settings),
    sweep: async (look, settings, lambdas) => {
      const lens = (await opened()).look(look);
      const style = Object.entries(look.styles).reduce((a, b) => (b[1] > a[1] ? b : a))[0];
      const ideal = performedIn(look.input.name, style);
      if (!ideal)
        throw new StrutError({
          code: "bad-input",
          message: `'${look.input.name}' has no performance in the style '${style}'.`,
          hint: "",
        });
      return lens.sweep(settings, Float32Array.from(lambdas), ideal.poses);
    },
    timing: async (look, style) => {
      const open = await opened();
      return open.look(look).timing(open.database.info.styles.indexOf(style));
    },
    contacts: async (look) => (await opened()).look(look).contacts(),
    clips: async (action) => {
      const open = await opened();
      const warps = open.warps(action);
      return warps.clipNames().flatMap((name, clip) => {
        if (!name.startsWith(`${action}-`)) return [];
        return [{ clip, name, ...warps.rows(clip), cycles: warps.cycles(clip), contacts: warps.contacts(clip) }];
      });
    },
    register: async (action, a, b, by) => (await opened()).warps(action).compare(a, b, by),
    ...createWalks(),
    ...createKeyStyles(),
  };
}
