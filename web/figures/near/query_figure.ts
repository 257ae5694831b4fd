/** A query with its nearest examples around it: limbs can be bent, and the body can be rotated and moved, by hand. */
import { DEGREES, JOINT, ROLES, type Role } from "../../humanoid";
import { button } from "../../ui/controls/buttons";
import { rounded } from "../../ui/controls/range";
import { setAttributes, svg } from "../../ui/dom";
import type { Viewer } from "../../viewer";
import type { FigureKind, FigureParts } from "../kind";
import { LimbHandles } from "../limb_handles";
import { memoized } from "../memoized";
import { SceneFigure } from "../scene_figure";
import { turnOf, withTurn } from "../turned_joints";
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

export const QUERY: FigureKind<NearState> = {
  fields: NEAR_FIELDS,
  measure: measureNear,
  sheet,
  create: (parts) => new QueryFigure(parts),
};

const posesOf = memoized((engine, rows: readonly number[]) => engine.rowPoses(rows));
const proportionsOf = memoized(async (engine, name: string) => (await engine.motion({ name })).proportions);

/** A query with its aligned nearest examples. */
interface Shown {
  state: NearState;
  found: Found;
  proportions: Float32Array;
  positions: Float32Array;
  nearest: readonly { row: number; distance: number; aligned: Aligned }[];
}

class QueryFigure extends SceneFigure<NearState, Shown> {
  readonly #limbs: LimbHandles;
  readonly #ground: GroundHandle;
  readonly #heights = svg("path", { class: "apart heights", "data-term": "y" });
  readonly #grounds = svg("path", { class: "apart ground", "data-term": "z" });
  /** The rotation and translation of the nearest example on the ground. */
  readonly #moves = {
    theta: svg("path", { class: "move", "data-term": "theta" }),
    x0: svg("path", { class: "move", "data-term": "x0" }),
    z0: svg("path", { class: "move", "data-term": "z0" }),
  };
  readonly #weights = new Map<Role, SVGCircleElement>();

  constructor(parts: FigureParts<NearState>) {
    const { near, joints } = parts.words;
    super(parts, { labels: { styled: near.query, input: "" }, description: near.stage, follow: false });
    const onSettle = () => this.settle();
    this.#limbs = new LimbHandles(
      this.stage,
      joints,
      {
        turnOf: (joint) => turnOf(this.state?.turned ?? [], joint),
        onInput: (joint, turn) => this.change({ turned: withTurn(this.state?.turned ?? [], joint, turn) }, false),
        onSettle,
      },
      parts.signal,
    );
    this.#ground = new GroundHandle(
      this.stage,
      near.move,
      {
        place: () => this.#place(),
        onInput: (x, z) => this.change({ x: rounded(x, NEAR_RANGES.x), z: rounded(z, NEAR_RANGES.z) }, false),
        onSettle,
      },
      parts.signal,
    );
    for (const role of ROLES) if (WEIGHTS[role]) this.#weights.set(role, svg("circle", { class: "joint" }));
    const marks = [this.#heights, this.#grounds, ...Object.values(this.#moves)];
    this.stage.overlay.append(...marks, ...this.#weights.values());
    const restore = button(near.restore, () => this.change({ turned: [], heading: 0, x: 0, z: 0 }), {
      label: true,
      class: "restore",
    });
    this.lay({
      title: near.stage,
      picture: this.stage.element,
      head: [this.readout, restore],
      foot: [],
      controls: this.knobs(["heading", "x", "z"], near.knobs, NEAR_RANGES),
    });
  }

  override light(term: string | undefined): void {
    super.light(term);
    this.stage.overlay.classList.toggle("weighed", term === "w");
    this.#heights.classList.toggle("lit", term === "y" || term === "D");
    this.#grounds.classList.toggle("lit", term === "z" || term === "D");
  }

  protected async load(state: NearState): Promise<Shown> {
    const { engine } = this.parts;
    const [found, proportions] = await Promise.all([foundOf(engine, state), proportionsOf(engine, state.motion)]);
    const rows = Array.from(found.order.subarray(0, DRAWN), (at) => found.firstRow + at);
    const poses = await posesOf(engine, rows);
    const positions = positionsOf(found.query, proportions);
    const size = found.query.length;
    const nearest = rows.map((row, i) => ({
      row,
      distance: distanceOf(found, i),
      aligned: align(positions, poses.subarray(i * size, (i + 1) * size), proportions),
    }));
    return { state, found, proportions, positions, nearest };
  }

  protected pose(viewer: Viewer, { state, found, proportions, nearest }: Shown, _: NearState, before?: Shown): void {
    if (!before) viewer.setProportions(proportions);
    viewer.setStyled(found.query);
    viewer.setOthers(
      nearest.map(({ aligned, distance }) => ({
        pose: aligned.pose,
        share: Math.max(FARTHEST, nearest[0]!.distance / distance),
      })),
    );
    if (before?.state.motion === state.motion && before.state.at === state.at) return;
    // The camera moves to another frame once, and does not follow while the query is moved.
    viewer.follow = true;
    viewer.resetTrail();
    viewer.follow = false;
  }

  protected override read({ found }: Shown): string {
    return this.words.near.read(this.#mm(found, 0), String(DRAWN), this.#mm(found, DRAWN - 1));
  }

  protected describe({ state, found }: Shown): string {
    return this.words.near.posed(
      this.number(state.heading, 0),
      this.number(state.x, 2),
      this.number(state.z, 2),
      String(state.turned.length),
      this.#mm(found, 0),
    );
  }

  protected get columns() {
    return this.words.near.columns;
  }

  protected rows({ nearest }: Shown): string[][] {
    return nearest.map(({ row, distance, aligned }) => [
      String(row),
      this.number(MM * distance, 1),
      `${this.number(aligned.turn * DEGREES, 0)}°`,
    ]);
  }

  protected override quantities({ nearest: [first] }: Shown): Readonly<Record<string, string>> {
    if (!first) return {};
    const { turn, x, z, heights, ground } = first.aligned;
    const mm = (square: number) => `${this.number(MM * Math.sqrt(square), 1)} mm`;
    return {
      w: `${this.number((100 * Math.max(...Object.values(WEIGHTS))) / WEIGHT, 1)} %`,
      theta: `${this.number(turn * DEGREES, 0)}°`,
      x0: `${this.number(x, 2)} m`,
      z0: `${this.number(z, 2)} m`,
      y: mm(heights),
      z: mm(ground),
    };
  }

  /** √D of the nearest window at a given rank, as text. */
  #mm(found: Found, place: number): string {
    return this.number(MM * distanceOf(found, place), 1);
  }

  /** Position of the query, and its displacement. */
  #place() {
    const [state, shown] = [this.state, this.shown];
    if (!state || !shown) return undefined;
    // The picture may still show an earlier displacement.
    const [x, , z] = shown.found.query as unknown as [number, number, number];
    return { at: [x + state.x - shown.state.x, z + state.z - shown.state.z], by: [state.x, state.z] } as const;
  }

  protected override placeMarks(): void {
    const [{ viewer }, shown] = [this.stage, this.shown];
    if (!viewer || !shown) return;
    this.#limbs.place();
    this.#ground.place((x, z) => this.words.near.moved(this.number(x, 2), this.number(z, 2)));
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
