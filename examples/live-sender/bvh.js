/** A BVH file, and its frames as the messages of `docs/live.md`. */

const RADIANS = Math.PI / 180;
const AXES = { X: 0, Y: 1, Z: 2 };

/**
 * Reads a file.
 * @returns joints (name, parent, offset, channels), seconds a frame, the channels of every frame, and what stands before them
 */
export function readBvh(text) {
  const [, hierarchy, secs, lines] = /^([\s\S]*?)MOTION[\s\S]*?Frame Time:\s*(\S+)\s*([\s\S]*)$/i.exec(text) ?? [];
  if (lines === undefined) throw new Error("This is no BVH file.");
  const joints = [];
  /** Joints whose braces are open; −1 for an end site. */
  const open = [];
  for (const line of hierarchy.split(/\r?\n/)) {
    const [word, ...rest] = line.trim().split(/\s+/);
    if (/^(ROOT|JOINT)$/i.test(word)) {
      open.push(joints.length);
      joints.push({ name: rest.join(" "), parent: open.at(-2) ?? -1, offset: [0, 0, 0], channels: [] });
    } else if (/^End$/i.test(word)) open.push(-1);
    else if (word === "}") open.pop();
    else if (/^OFFSET$/i.test(word) && open.at(-1) >= 0) joints[open.at(-1)].offset = rest.slice(0, 3).map(Number);
    else if (/^CHANNELS$/i.test(word)) joints[open.at(-1)].channels = rest.slice(1);
  }
  const frames = lines
    .trim()
    .split(/\r?\n/)
    .map((line) => line.trim().split(/\s+/).map(Number));
  return { joints, frameSecs: Number(secs), frames, header: `${hierarchy}MOTION\nFrames: 1\nFrame Time: ${secs}` };
}

/** The message that tells the skeleton; its unit of length is told by the size of the body. */
export function jsonSkeleton({ joints }) {
  const [names, parents, offsets] = ["name", "parent", "offset"].map((key) => joints.map((joint) => joint[key]));
  return JSON.stringify({ strut: 1, names, parents, offsets });
}

/** The message of a frame: where the root is, and how every joint is turned. */
export function jsonFrame({ joints }, channels, secs) {
  let next = 0;
  const place = [...joints[0].offset];
  const rotations = joints.map((joint, j) => {
    let rotation = [0, 0, 0, 1];
    for (const channel of joint.channels) {
      const [axis, value] = [AXES[channel[0].toUpperCase()], channels[next++]];
      if (/rotation$/i.test(channel)) rotation = times(rotation, turn(axis, value * RADIANS));
      else if (j === 0) place[axis] = value;
    }
    return rotation;
  });
  return JSON.stringify({ t: secs, p: place, q: rotations });
}

/** The rotation about an axis. */
function turn(axis, angle) {
  const rotation = [0, 0, 0, Math.cos(angle / 2)];
  rotation[axis] = Math.sin(angle / 2);
  return rotation;
}

/** First `b`, then `a`. */
function times([ax, ay, az, aw], [bx, by, bz, bw]) {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}
