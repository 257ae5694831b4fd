"use client";

// A client page: the engine in the browser. Next renders it on the server too, where the package is the one for Node.
import { useEffect } from "react";
import { loadStrut } from "strut-motion";

export default function Page() {
  useEffect(() => {
    window.said ??= style();
  }, []);
  return <h1>Client</h1>;
}

async function style() {
  const strut = await loadStrut();
  const db = await strut.openDatabase("/demo.strutdb");
  const motion = await strut.openMotion("/walk.bvh");
  const styled = await strut.stylize(motion, db, { styles: { proud: 1 } });
  strut.dispose();
  return { thread: strut.thread, frames: motion.frames, bvh: styled.toBVH() };
}
