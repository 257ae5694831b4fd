// A live performer in Node: a caller's source, styled and recorded. Prints a report.
import { loadStrut } from "strut-motion";
import { landmarkPoses, webSocketPoses } from "strut-motion/streams";

const FRAMES = 60;
const strut = await loadStrut();
const db = await strut.openDatabase("strut:walk");
const motion = await strut.openMotion("strut:neutral-walk");
const poses = await motion.poses(db);

/** Sends the walk in real time until it is stopped. */
const walk = {
  start: (sink, signal) =>
    new Promise((resolve) => {
      let frame = 0;
      const sending = setInterval(() => {
        sink.frame(performance.now() / 1000, poses.subarray(87 * frame, 87 * (frame + 1)));
        frame += 1;
      }, 1000 / 60);
      signal.addEventListener("abort", () => {
        clearInterval(sending);
        resolve();
      });
    }),
};

const live = await strut.live(db, walk, { styles: { proud: 1 }, delaySecs: 0.05 });
const recorder = live.record();
await new Promise((resolve) => {
  live.onFrame = ({ frame }) => {
    if (frame === FRAMES / 2) live.setStyles({ old: 1 });
    if (frame === FRAMES) resolve();
  };
});
const { stats } = live;
const recording = recorder.stop();
live.close();
// No more frames arrive.
let afterwards = 0;
live.onFrame = () => {
  afterwards += 1;
};
await new Promise((resolve) => setTimeout(resolve, 100));

/** Returns the first error of a source. */
const troubleOf = async (source) => {
  const other = await strut.live(db, source);
  const sentence = await new Promise((resolve) => {
    other.onTrouble = resolve;
  });
  other.close();
  return sentence;
};
const refusal = (act) =>
  Promise.resolve()
    .then(act)
    .then(
      () => "none",
      ({ code }) => code,
    );
/** Codes of the calls that are cancelled while they open, and the kinds of what is open afterwards. */
const cancelled = async () => {
  const abort = new AbortController();
  const { signal } = abort;
  const opening = [
    strut.createStylizer(db, { signal }),
    strut.createPlayback(motion, db, { signal }),
    strut.live(db, walk, { signal }),
  ];
  const codes = opening.map((call) => refusal(() => call));
  abort.abort();
  const settled = await Promise.all(codes);
  return { codes: settled, open: (await strut.memory()).open.map(({ kind }) => kind) };
};
const skeleton = { kind: "joints", names: ["a"], parents: [-1], offsets: [0, 0, 0] };
console.log(
  JSON.stringify({
    frames: recording.frames,
    floats: [recording.poses.length, recording.inputPoses.length],
    finite: recording.poses.every(Number.isFinite),
    styled: recording.poses.some((value, i) => Math.abs(value - recording.inputPoses[i]) > 0.1),
    bvh: [recording.toBVH(), recording.inputToBVH()].map((text) => /Frames: (\d+)/.exec(text)[1]),
    stats,
    afterwards,
    noBody: await troubleOf({ start: async (sink) => void setTimeout(() => sink.skeleton(skeleton), 20) }),
    nobody: await troubleOf(webSocketPoses("ws://127.0.0.1:1", { format: "json" })),
    cancelled: await cancelled(),
    refusals: [
      await refusal(() => webSocketPoses("ws://192.168.0.7", { format: "json" })),
      await refusal(() => strut.live(db, walk, { delaySecs: 0.5 })),
      await refusal(() =>
        strut.live(
          db,
          landmarkPoses(() => () => {}),
          { styles: { none: 1 } },
        ),
      ),
    ],
  }),
);
strut.dispose();
