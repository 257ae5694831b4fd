// A server component that opens what is built in: the package's files must lie beside its code (next.config.mjs).
import { readFileSync } from "node:fs";
import { loadStrut } from "strut-motion/node";

export const dynamic = "force-dynamic";

export default async function Page() {
  const strut = await loadStrut();
  const db = await strut.openDatabase("strut:walk");
  const motion = await strut.openMotion(readFileSync("public/walk.bvh", "utf8"));
  const styled = await strut.stylize(motion, db, { styles: { proud: 1 } });
  strut.dispose();
  return (
    <pre data-thread={strut.thread} data-frames={motion.frames}>
      {styled.toBVH()}
    </pre>
  );
}
