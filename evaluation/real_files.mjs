// node evaluation/real_files.mjs FOLDER [--strut PROGRAM] [--style NAME] [--json FILE]: tests BVH files of other
// programs. Each file below FOLDER is read by `strut inspect`, styled by `strut stylize --timing off` (to neutral, with
// the built-in database) and compared with the output, by this script's own reader. Prints the table of
// docs/real_files.md, whose last column lists possible faults. The files are third-party and not in the repository.
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, relative } from "node:path";
import { parseArgs } from "node:util";
import { main, root, Sentence } from "../scripts/steps.mjs";

/**
 * Limits beyond which a file is reported: share and metres of the travel, degrees of the heading, centimetres of the
 * pose.
 */
const MOST = { travelShare: 0.1, travelMetres: 0.1, headingDegrees: 15, poseCm: 15, legMetres: [0.4, 1.2] };
/** Greatest number of compared frames. */
const MOST_FRAMES = 400;
const MAX_BUFFER = 1 << 28;

/** Returns joints and rows of a BVH file. It is lenient, since `strut` has already read the file. */
function readBvh(bytes) {
  const tokens = bytes.toString("latin1").split(/\s+/);
  const at = tokens.indexOf("MOTION");
  const joints = [];
  const open = [];
  let channels = 0;
  for (let i = 0; i < at; i++) {
    const token = tokens[i].toUpperCase();
    const last = open.at(-1);
    if (token === "ROOT" || token === "JOINT") {
      joints.push({ parent: open.findLast((j) => j !== undefined), offset: [0, 0, 0], channels: [], first: channels });
      open.push(joints.length - 1);
    } else if (token.startsWith("END")) open.push(undefined);
    else if (token === "}") open.pop();
    else if (last !== undefined && token === "OFFSET") joints[last].offset = tokens.slice(i + 1, i + 4).map(Number);
    else if (last !== undefined && token === "CHANNELS") {
      joints[last].channels = tokens.slice(i + 2, i + 2 + Number(tokens[i + 1]));
      channels += joints[last].channels.length;
    }
  }
  const time = tokens.findIndex((token, i) => i > at && /^time:?$/i.test(token));
  const values = Float64Array.from(tokens.slice(time + (tokens[time + 1] === ":" ? 3 : 2)).filter(Boolean), Number);
  return { joints, channels, values, frames: Math.floor(values.length / channels) };
}

const times = (a, b) =>
  [0, 1, 2].map((i) => [0, 1, 2].map((j) => [0, 1, 2].reduce((sum, k) => sum + a[i][k] * b[k][j], 0)));
const apply = (m, v) => m.map((row) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);
const plus = (a, b) => a.map((x, i) => x + b[i]);
const minus = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const length = (v) => Math.sqrt(dot(v, v));
const scaled = (v, s) => v.map((x) => x * s);

function turn(axis, degrees) {
  const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  const [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
  const m = [0, 1, 2].map(() => [0, 0, 0]);
  m[axis][axis] = 1;
  [m[i][i], m[i][j], m[j][i], m[j][j]] = [c, -s, s, c];
  return m;
}

/** Returns the positions of all joints in a frame. `added`: position channels are added to offsets. */
function positions({ joints, channels, values }, frame, added) {
  const world = [];
  for (const { parent, offset, channels: own, first } of joints) {
    const translation = [...offset];
    let rotation = [0, 1, 2].map((i) => [0, 1, 2].map((j) => Number(i === j)));
    own.forEach((channel, i) => {
      const value = values[frame * channels + first + i];
      const axis = "XYZ".indexOf(channel[0].toUpperCase());
      if (/rotation/i.test(channel)) rotation = times(rotation, turn(axis, value));
      else translation[axis] = (added && parent !== undefined ? translation[axis] : 0) + value;
    });
    const above = world[parent];
    world.push(
      above
        ? { at: plus(above.at, apply(above.rotation, translation)), rotation: times(above.rotation, rotation) }
        : { at: translation, rotation },
    );
  }
  return world.map(({ at }) => at);
}

const UP = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const upOf = (name) => scaled(UP[name.toLowerCase().at(-1)] ?? UP.y, name.startsWith("-") ? -1 : 1);
const level = (v, up) => minus(v, scaled(up, dot(v, up)));
const degrees = (a, b) =>
  (Math.acos(Math.min(1, Math.max(-1, dot(a, b) / (length(a) * length(b) || 1)))) * 180) / Math.PI;

/** Returns the differences between the input and the output. */
function compare(before, after, report) {
  const unit = report.humanoid.metres_per_unit;
  const up = upOf(report.humanoid.up ?? "y");
  const role = (name) => report.joints.findIndex((joint) => joint.role === name);
  const mapped = report.joints.flatMap((joint, i) => (joint.role ? [i] : []));
  const [hips, left, right] = ["hips", "left_upper_leg", "right_upper_leg"].map(role);
  const added = report.notes.some(({ code }) => code === "added-positions");
  const frames = Math.min(before.frames, after.frames);
  const steps = Math.min(frames, MOST_FRAMES);
  const [places, facings] = [[], []];
  let [pose, heading] = [0, 0];
  for (let i = 0; i < steps; i++) {
    const frame = Math.floor((i * (frames - 1)) / Math.max(1, steps - 1));
    const pair = [before, after].map((file) => positions(file, frame, added));
    places.push(pair.map((at) => level(at[hips], up)));
    facings.push(pair.map((at) => level(minus(at[right], at[left]), up)));
    const off = mapped.map((j) => length(minus(minus(pair[0][j], pair[0][hips]), minus(pair[1][j], pair[1][hips]))));
    pose += off.reduce((a, b) => a + b, 0) / off.length / steps;
    heading += degrees(...facings.at(-1)) / steps;
  }
  const travel = [0, 1].map((k) => unit * length(minus(places.at(-1)[k], places[0][k])));
  const path = [0, 1].map((k) => {
    let [sum, last] = [0, places[0][k]];
    // Sway does not count as travel.
    for (const place of places)
      if (unit * length(minus(place[k], last)) > 0.1)
        [sum, last] = [sum + unit * length(minus(place[k], last)), place[k]];
    return sum;
  });
  return { travel, path, heading, poseCm: 100 * unit * pose, frames: [before.frames, after.frames] };
}

const SIDES = { left: /(^|[^a-z])(right|r)([^a-z]|$)|^Right|右/, right: /(^|[^a-z])(left|l)([^a-z]|$)|^Left|左/ };

/** Returns the possible faults that a person should check. */
function doubts({ report, compared, refused }) {
  if (refused) return [refused];
  const found = [];
  const { humanoid, joints, notes } = report;
  const mirrored = notes.some(({ code }) => code === "mirrored");
  const crossed = joints.filter(({ name, role }) => role && SIDES[role.split("_")[0]]?.test(name));
  if (crossed.length && !mirrored) found.push(`sides of ${crossed.length} names`);
  if (humanoid.confidence < 0.9) found.push(`confidence ${humanoid.confidence.toFixed(2)}`);
  const leg = humanoid.leg_length_m;
  if (leg < MOST.legMetres[0] || leg > MOST.legMetres[1]) found.push(`legs of ${leg.toFixed(2)} m`);
  const [from, to] = compared.frames;
  if (from !== to) found.push(`frames ${from} → ${to}`);
  const [a, b] = compared.path;
  if (Math.abs(a - b) > MOST.travelMetres + MOST.travelShare * a) found.push("travel");
  if (compared.heading > MOST.headingDegrees) found.push("heading");
  if (compared.poseCm > MOST.poseCm) found.push("pose");
  return found;
}

function bvhFiles(folder) {
  const entries = readdirSync(folder, { withFileTypes: true }).sort((a, b) => (a.name < b.name ? -1 : 1));
  return entries.flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return bvhFiles(path);
    return /\.bvh$/i.test(entry.name) ? [path] : [];
  });
}

function table(head, rows) {
  const line = (cells) => `| ${cells.join(" | ")} |`;
  return [line(head), line(head.map(() => "---")), ...rows.map(line)].join("\n");
}

main(async () => {
  const { positionals, values: options } = parseArgs({
    allowPositionals: true,
    options: { strut: { type: "string" }, style: { type: "string", default: "neutral" }, json: { type: "string" } },
  });
  const [folder] = positionals;
  const strut = options.strut ?? join(root, "rust", "target", "release", "strut");
  if (!folder || !existsSync(folder)) throw new Sentence("Name a folder of BVH files.");
  if (!existsSync(strut)) throw new Sentence(`There is no ${strut}; build it with 'npm run strut'.`);
  const scratch = mkdtempSync(join(tmpdir(), "strut-real-"));
  const at = (name) => join(scratch, name);
  const run = (...args) => spawnSync(strut, args, { encoding: "utf8", maxBuffer: MAX_BUFFER });
  run("demo-db", "-o", at("demo.strutdb"));
  const seen = new Set();
  const results = [];
  for (const path of bvhFiles(folder)) {
    const bytes = readFileSync(path);
    const hash = createHash("sha256").update(bytes).digest("hex");
    if (seen.has(hash)) continue;
    seen.add(hash);
    const name = relative(folder, path);
    const sentence = ({ stderr, signal }) =>
      (signal ?? stderr.split("\n").find((line) => line.startsWith("error: ")) ?? stderr)
        .replace(`error: ${path}: `, "")
        .replace("error: ", "")
        .trim();
    const inspected = run("inspect", path, "--json", at("in.json"));
    const report = inspected.status === 0 ? JSON.parse(readFileSync(at("in.json"), "utf8")) : undefined;
    const style = ["stylize", "--db", at("demo.strutdb"), "--input", path, "--style", options.style, "--timing", "off"];
    const styled = run(...style, "-o", at("out.bvh"), "--json", at("out.json"));
    const refused = styled.status === 0 ? undefined : sentence(inspected.status === 0 ? styled : inspected);
    const result = { name, report, refused };
    if (!refused) {
      result.report.notes = JSON.parse(readFileSync(at("out.json"), "utf8")).notes;
      result.compared = compare(readBvh(bytes), readBvh(readFileSync(at("out.bvh"))), report);
    }
    results.push({ ...result, doubts: doubts(result) });
    process.stderr.write(`${name}: ${results.at(-1).doubts.join(", ") || "as it was"}\n`);
  }
  rmSync(scratch, { recursive: true });
  if (options.json) {
    const lean = results.map(({ report, ...rest }) => ({
      ...rest,
      humanoid: report?.humanoid,
      notes: report?.notes,
      roles: Object.fromEntries((report?.joints ?? []).flatMap(({ name, role }) => (role ? [[role, name]] : []))),
    }));
    writeFileSync(options.json, JSON.stringify(lean, null, 1));
  }
  const rows = results.map(({ name, report, compared, doubts: found, refused }) => [
    name,
    ...(refused
      ? [report?.joints.length ?? "", report?.frames ?? "", "", "", "", "", ""]
      : [
          report.joints.length,
          compared.frames[0] === compared.frames[1] ? compared.frames[0] : compared.frames.join(" → "),
          report.humanoid.up,
          report.notes.map(({ code }) => `\`${code}\``).join(" "),
          compared.path.map((m) => m.toFixed(2)).join(" → "),
          compared.heading.toFixed(1),
          compared.poseCm.toFixed(1),
        ]),
    found.join(", "),
  ]);
  const head = ["File", "Joints", "Frames", "Up", "Notes", "Travel, m", "Heading, °", "Pose, cm", "To look at"];
  process.stdout.write(`${table(head, rows)}\n`);
});
