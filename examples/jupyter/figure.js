// A figure in ink on a canvas: 21 joints, a stroke for each bone.

/**
 * Bones, from the parent's joint to this one: the parent's index and the bone's width in metres. 0–20 are the joints of a
 * pose; left is 5–8 and 13–16, right 9–12 and 17–20.
 */
const PARENTS = [-1, 0, 1, 2, 3, 2, 5, 6, 7, 2, 9, 10, 11, 0, 13, 14, 15, 0, 17, 18, 19];
const ARM = [0.1, 0.09, 0.08, 0.065];
const LEG = [0.14, 0.125, 0.095, 0.07];
const WIDTHS = [0, 0.16, 0.16, 0.09, 0.075, ...ARM, ...ARM, ...LEG, ...LEG];
/** What a pose has no joints for: the crown of the head, fingertips, tips of the toes. Each with its place in its parent. */
const ENDS = [
  { parent: 4, width: 0.16, offset: [0, 0.09, 0.02] },
  { parent: 8, width: 0.05, offset: [0.1, 0, 0.01] },
  { parent: 12, width: 0.05, offset: [-0.1, 0, 0.01] },
  { parent: 16, width: 0.055, offset: [0, -0.005, 0.05] },
  { parent: 20, width: 0.055, offset: [0, -0.005, 0.05] },
];
/** The limbs that the body hides, as the walker is seen; all other bones. */
const FAR = [5, 6, 7, 8, 13, 14, 15, 16, 22, 24];
const NEAR = [0, 1, 2, 3, 4, 9, 10, 11, 12, 17, 18, 19, 20, 21, 23, 25];
/** Both shoulders and both hips, around. */
const TRUNK = [6, 10, 17, 13];

/** The walker goes to the right, a little towards the viewer. */
const TURN = 1.05;
const METRES_HIGH = 1.95;

/**
 * @param proportions 21 × x y z: where each joint lies in its parent
 * @param pose what is drawn
 * @param ghost a pose that is drawn pale behind it
 */
export function drawFigure(canvas, proportions, pose, ghost) {
  const context = canvas.getContext("2d");
  // The colour of the notebook's text, in light themes and in dark ones.
  const ink = getComputedStyle(canvas).color;
  context.clearRect(0, 0, canvas.width, canvas.height);
  // A layer at a time: where strokes overlap they must not be darker.
  const layer = (alpha, colour, draw) => {
    const sheet = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
    const scale = canvas.height / METRES_HIGH;
    sheet.setTransform(scale, 0, 0, -scale, canvas.width / 2, canvas.height * 0.93);
    sheet.lineCap = sheet.lineJoin = "round";
    sheet.strokeStyle = sheet.fillStyle = colour;
    draw(sheet);
    context.globalAlpha = alpha;
    context.drawImage(sheet.canvas, 0, 0);
  };
  const bones = bonesOf(proportions, pose);
  layer(0.25, ink, (sheet) => drawGround(sheet, pose[2]));
  // Both hips are in the middle: the two differ in style, not in place.
  const ghosts = bonesOf(proportions, ghost);
  layer(0.4, "#7f97b8", (sheet) => {
    drawBones(sheet, ghosts);
    drawTrunk(sheet, ghosts);
  });
  layer(0.5, ink, (sheet) =>
    drawBones(
      sheet,
      FAR.map((bone) => bones[bone]),
    ),
  );
  layer(1, ink, (sheet) => {
    drawBones(
      sheet,
      NEAR.map((bone) => bones[bone]),
    );
    drawTrunk(sheet, bones);
  });
}

function drawBones(context, bones) {
  for (const { from, to, width } of bones) {
    context.lineWidth = width;
    context.beginPath();
    context.moveTo(...flat(from));
    context.lineTo(...flat(to));
    context.stroke();
  }
}

/** What is between shoulders and hips. */
function drawTrunk(context, bones) {
  context.lineWidth = 0.1;
  context.beginPath();
  for (const joint of TRUNK) context.lineTo(...flat(bones[joint].to));
  context.closePath();
  context.stroke();
  context.fill();
}

/** A metre is from mark to mark. */
function drawGround(context, z) {
  context.lineWidth = 0.008;
  context.beginPath();
  context.moveTo(-3, -0.02);
  context.lineTo(3, -0.02);
  for (let mark = Math.floor(z) - 3; mark < z + 3; mark++) {
    const x = (mark - z) * Math.sin(TURN);
    context.moveTo(x, -0.02);
    context.lineTo(x, -0.07);
  }
  context.stroke();
}

/** As seen from the side, without perspective. */
const flat = ([x, y, z]) => [x * Math.cos(TURN) + z * Math.sin(TURN), y];

/** Both ends of all bones, the hips over 0 0: a joint is its parent's, and its own offset turned as the parent is turned. */
function bonesOf(proportions, pose) {
  const [places, turns] = [[], []];
  const below = (parent, offset) => rotate(turns[parent], offset).map((value, axis) => value + places[parent][axis]);
  for (const [joint, parent] of PARENTS.entries()) {
    const own = [...pose.subarray(3 + 4 * joint, 7 + 4 * joint)];
    const offset = [0, 1, 2].map((axis) => proportions[3 * joint + axis]);
    places.push(parent < 0 ? [0, pose[1], 0] : below(parent, offset));
    turns.push(parent < 0 ? own : multiply(turns[parent], own));
  }
  const bones = PARENTS.map((parent, joint) => ({
    from: places[Math.max(parent, 0)],
    to: places[joint],
    width: WIDTHS[joint],
  }));
  const ends = ENDS.map(({ parent, width, offset }) => ({ from: places[parent], to: below(parent, offset), width }));
  return [...bones, ...ends];
}

/** A vector turned by a quaternion x y z w. */
function rotate([x, y, z, w], v) {
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const t = cross([x, y, z], v).map((value) => 2 * value);
  const u = cross([x, y, z], t);
  return v.map((value, axis) => value + w * t[axis] + u[axis]);
}

/** The turn that does b, then a. */
function multiply([ax, ay, az, aw], [bx, by, bz, bw]) {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}
