/** A query with its nearest examples around it: limbs can be bent, and the body can be rotated and moved, by hand. */
import { DEGREES, JOINT, ROLES, type Role } from "../../humanoid";
import { button } from "../../ui/controls/buttons";
import type { Knob } from "../../ui/controls/knob";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import type { Viewer } from "../../viewer";
import { createKnobs } from "../controls";
import { FigureStage } from "../figure_stage";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { LimbHandles } from "../limb_handles";
import { remembered } from "../remembered";
import { turnOf, withTurn } from "../turned_joints";
import { figure } from "../words/words";
import { type Aligned, align, positionsOf, WEIGHT, WEIGHTS } from "./alignment";
import { GroundHandle } from "./ground_handle";
import sheet from "./near.css?inline";
import { distanceOf, type Found, foundOf, measureNear } from "./near_measure";
import { DRAWN, NEAR_FIELDS, NEAR_RANGES, type NearState } from "./near_state";

/** Opacity of the farthest example, as a share of the nearest one's. */
const FARTHEST = 0.25;
/** Radius of a joint with weight 1, pixels. */
const RADIUS = 6;
/** Length of the marks of θ, x₀ and z₀ on the ground, metres, and of their heads. */
const MOVE = { length: 0.6, head: 0.12 };
const MM = 1000;
const KNOBS = ["heading", "x", "z"] as const;
type KnobName = (typeof KNOBS)[number];

export const QUERY: FigureKind<NearState> = {
  fields: NEAR_FIELDS,
  sheet,
  create: (parts) => new QueryFigure(parts),
};

const posesOf = remembered((engine, rows: readonly number[]) => engine.rowPoses(rows));
const proportionsOf = remembered(async (engine, name: string) => (await engine.motion({ name })).proportions);

/** A query with its aligned nearest examples. */
interface Shown {
  state: NearState;
  found: Found;
  positions: Float32Array;
  nearest: readonly { row: number; distance: number; aligned: Aligned }[];
}

class QueryFigure implements FigureInstance<NearState> {
  readonly #parts: FigureParts<NearState>;
  readonly stage: FigureStage;
  readonly #limbs: LimbHandles;
  readonly #ground: GroundHandle;
  readonly #knobs: Record<KnobName, Knob>;
  readonly #readout = html("p", { class: "readout" });
  readonly #heights = svg("path", { class: "apart heights", "data-term": "y" });
  readonly #grounds = svg("path", { class: "apart ground", "data-term": "z" });
  /** The rotation and translation of the nearest example on the ground. */
  readonly #moves = {
    theta: svg("path", { class: "move", "data-term": "theta" }),
    x0: svg("path", { class: "move", "data-term": "x0" }),
    z0: svg("path", { class: "move", "data-term": "z0" }),
  };
  readonly #weights = new Map<Role, SVGCircleElement>();
  readonly #finding = new Latest<NearState>((state) => this.#find(state));
  #state: NearState | undefined;
  #shown: Shown | undefined;

  constructor(parts: FigureParts<NearState>) {
    this.#parts = parts;
    const { words, container, change, signal } = parts;
    const settle = () => change({}, true);
    this.stage = new FigureStage(
      words,
      { labels: { styled: words.near.query, input: "" }, description: words.near.stage, follow: false },
      { drawn: () => this.#placeMarks() },
    );
    this.#limbs = new LimbHandles(
      this.stage,
      words.joints,
      {
        turnOf: (joint) => turnOf(this.#state?.turned ?? [], joint),
        onInput: (joint, turn) => change({ turned: withTurn(this.#state?.turned ?? [], joint, turn) }, false),
        onSettle: settle,
      },
      signal,
    );
    const clamp = (value: number, name: "x" | "z") => {
      const { min, max, digits } = NEAR_RANGES[name];
      return Number(Math.min(max, Math.max(min, value)).toFixed(digits));
    };
    this.#ground = new GroundHandle(
      this.stage,
      words.near.move,
      {
        place: () => this.#place(),
        onInput: (x, z) => change({ x: clamp(x, "x"), z: clamp(z, "z") }, false),
        onSettle: settle,
      },
      signal,
    );
    this.#knobs = createKnobs(KNOBS, words, words.near.knobs, NEAR_RANGES, NEAR_FIELDS, change);
    for (const role of ROLES) if (WEIGHTS[role]) this.#weights.set(role, svg("circle", { class: "joint" }));
    const marks = [this.#heights, this.#grounds, ...Object.values(this.#moves)];
    this.stage.overlay.append(...marks, ...this.#weights.values());
    for (const mark of marks) {
      mark.addEventListener("pointerenter", () => parts.point(mark.getAttribute("data-term")!));
      mark.addEventListener("pointerleave", () => parts.point(undefined));
    }
    const restore = button(words.near.restore, () => change({ turned: [], heading: 0, x: 0, z: 0 }, true), {
      label: true,
      class: "restore",
    });
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.near.stage), this.#readout, restore),
      this.stage.element,
      html("div", { class: "knobs" }, ...KNOBS.map((name) => this.#knobs[name].element)),
    );
  }

  show(state: NearState): Promise<void> {
    this.#state = state;
    for (const name of KNOBS) this.#knobs[name].value = state[name];
    return this.#finding.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureNear(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#shown) return "";
    const { state, found } = this.#shown;
    const { words } = this.#parts;
    return words.near.posed(
      figure(state.heading, 0, words),
      figure(state.x, 2, words),
      figure(state.z, 2, words),
      String(state.turned.length),
      figure(MM * distanceOf(found, 0), 1, words),
    );
  }

  table(): Table {
    const { words } = this.#parts;
    const rows = (this.#shown?.nearest ?? []).map(({ row, distance, aligned }) => [
      String(row),
      figure(MM * distance, 1, words),
      `${figure(aligned.turn * DEGREES, 0, words)}°`,
    ]);
    return { head: words.near.columns, rows };
  }

  values(): Readonly<Record<string, string>> {
    const nearest = this.#shown?.nearest[0];
    if (!nearest) return {};
    const { words } = this.#parts;
    const { turn, x, z, heights, ground } = nearest.aligned;
    const mm = (square: number) => `${figure(MM * Math.sqrt(square), 1, words)} mm`;
    return {
      w: `${figure((100 * Math.max(...Object.values(WEIGHTS))) / WEIGHT, 1, words)} %`,
      theta: `${figure(turn * DEGREES, 0, words)}°`,
      x0: `${figure(x, 2, words)} m`,
      z0: `${figure(z, 2, words)} m`,
      y: mm(heights),
      z: mm(ground),
    };
  }

  light(term: string | undefined): void {
    for (const [name, mark] of Object.entries(this.#moves)) mark.classList.toggle("lit", name === term);
    this.stage.overlay.classList.toggle("weighed", term === "w");
    this.#heights.classList.toggle("lit", term === "y" || term === "D");
    this.#grounds.classList.toggle("lit", term === "z" || term === "D");
  }

  /** Position of the query, and its displacement. */
  #place() {
    const [state, shown] = [this.#state, this.#shown];
    if (!state || !shown) return undefined;
    // The picture may still show an earlier displacement.
    const [x, , z] = shown.found.query as unknown as [number, number, number];
    return { at: [x + state.x - shown.state.x, z + state.z - shown.state.z], by: [state.x, state.z] } as const;
  }

  async #find(state: NearState): Promise<void> {
    const { engine, signal } = this.#parts;
    const [found, proportions] = await Promise.all([foundOf(engine, state), proportionsOf(engine, state.motion)]);
    const rows = Array.from(found.order.subarray(0, DRAWN), (at) => found.firstRow + at);
    const poses = await posesOf(engine, rows);
    if (signal.aborted) return;
    const before = this.#shown?.state;
    const positions = positionsOf(found.query, proportions);
    const size = found.query.length;
    const nearest = rows.map((row, i) => ({
      row,
      distance: distanceOf(found, i),
      aligned: align(positions, poses.subarray(i * size, (i + 1) * size), proportions),
    }));
    this.#shown = { state, found, positions, nearest };
    const { viewer } = this.stage;
    if (viewer) {
      if (!before) viewer.setProportions(proportions);
      viewer.setStyled(found.query);
      viewer.setOthers(
        nearest.map(({ aligned, distance }) => ({
          pose: aligned.pose,
          share: Math.max(FARTHEST, nearest[0]!.distance / distance),
        })),
      );
      viewer.description = this.sentence();
      if (before?.motion !== state.motion || before.at !== state.at) {
        // The camera moves to another frame once, and does not follow while the query is moved.
        viewer.follow = true;
        viewer.resetTrail();
        viewer.follow = false;
      }
    }
    const { words } = this.#parts;
    const mm = (place: number) => figure(MM * distanceOf(found, place), 1, words);
    setText(this.#readout, words.near.read(mm(0), String(DRAWN), mm(DRAWN - 1)));
    this.stage.invalidate();
    this.#parts.changed();
  }

  /** Moves the marks to the joints of the drawn picture. */
  #placeMarks(): void {
    const [{ viewer }, shown, { words }] = [this.stage, this.#shown, this.#parts];
    if (!viewer || !shown) return;
    this.#limbs.place();
    this.#ground.place((x, z) => words.near.moved(figure(x, 2, words), figure(z, 2, words)));
    const nearest = shown.nearest[0]?.aligned.positions;
    let [heights, ground] = ["", ""];
    for (const [role, mark] of this.#weights) {
      const at = 3 * JOINT[role];
      const [px, py, pz] = shown.positions.subarray(at, at + 3) as unknown as [number, number, number];
      const from = viewer.screenPosition(px, py, pz);
      setAttributes(mark, {
        cx: from.x.toFixed(1),
        cy: from.y.toFixed(1),
        r: (RADIUS * Math.sqrt(WEIGHTS[role]!)).toFixed(1),
      });
      if (!nearest) continue;
      const [qx, qy, qz] = nearest.subarray(at, at + 3) as unknown as [number, number, number];
      const corner = viewer.screenPosition(px, qy, pz);
      const to = viewer.screenPosition(qx, qy, qz);
      heights += line(from, corner);
      ground += line(corner, to);
    }
    this.#placeMoves(viewer, shown);
    setAttributes(this.#heights, { d: heights });
    setAttributes(this.#grounds, { d: ground });
  }

  /** θ points to the heading of the nearest example, x₀ and z₀ along the axes, from the query's position. */
  #placeMoves(viewer: Viewer, { found, nearest }: Shown): void {
    const [x, , z] = found.query as unknown as [number, number, number];
    const turn = nearest[0]?.aligned.turn ?? 0;
    const arrow = (dx: number, dz: number) => ({ d: groundArrow(viewer, [x, z], [dx, dz]) });
    // Examples face +Z before they are rotated.
    setAttributes(this.#moves.theta, arrow(Math.sin(turn), Math.cos(turn)));
    setAttributes(this.#moves.x0, arrow(Math.sign(nearest[0]?.aligned.x ?? 1) || 1, 0));
    setAttributes(this.#moves.z0, arrow(0, Math.sign(nearest[0]?.aligned.z ?? 1) || 1));
  }
}

/** An arrow on the ground from a position in a direction. */
function groundArrow(viewer: Viewer, [x, z]: readonly [number, number], [dx, dz]: readonly [number, number]): string {
  const { length, head } = MOVE;
  const at = (along: number, across: number) =>
    viewer.screenPosition(x + along * dx + across * dz, 0, z + along * dz - across * dx);
  const tip = at(length, 0);
  return line(at(0, 0), tip) + line(tip, at(length - head, head / 2)) + line(tip, at(length - head, -head / 2));
}

interface Pixel {
  x: number;
  y: number;
}

function line(from: Pixel, to: Pixel): string {
  return `M${from.x.toFixed(1)} ${from.y.toFixed(1)}L${to.x.toFixed(1)} ${to.y.toFixed(1)}`;
}
