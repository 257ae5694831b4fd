/** The contact likelihood of a foot, and its speed over the ground, over a range of the motion. */
import { setAttributes, setText, svg } from "../../ui/dom";
import type { Margin } from "../axes";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import { runsOf } from "../runs";
import sheet from "./feet.css?inline";
import { measureFeet, PLANT, RELEASE, type Tracks, tracksOf, type Votes, votesOf, within } from "./feet_measure";
import { FEET_FIELDS, type FeetState, STRETCH, stretchOf } from "./feet_state";
import { SIDES } from "./soles";

/** Step of an arrow key, frames; with Shift one frame. */
const STEP = 5;
/** Frames between two rows of the table. */
const TABLE_STEP = 6;
/** Upper limit of the speed, cm/s; a lifted foot is faster. */
const MOST = 80;
/** Space for a second axis at the right. */
const ROOM: Margin = { left: 44, right: 34, top: 24, bottom: 44 };

export const FEET: FigureKind<FeetState> = {
  fields: FEET_FIELDS,
  measure: measureFeet,
  sheet,
  create: (parts) => new FeetFigure(parts),
};

interface Shown {
  state: FeetState;
  tracks: Tracks;
  votes: Votes;
}

class FeetFigure extends PlotFigure<FeetState, Shown> {
  readonly #stances = svg("g", { class: "stances" });
  readonly #limits = svg("path", { class: "limits", "data-term": "P" });
  readonly #votes = svg("g", { class: "dots", "data-term": "c" });
  readonly #likelihood = svg("path", { class: "likelihood", "data-term": "P" });
  readonly #other = svg("path", { class: "speed other" });
  readonly #speed = svg("path", { class: "speed", "data-term": "p" });
  readonly #ticks = svg("g", { class: "ticks" });
  readonly #point = svg("circle", { class: "query", r: 5 });
  readonly #handle = this.playhead("at", {
    step: STEP,
    rate: () => this.shown!.tracks.rateHz,
    ends: () => {
      const first = stretchOf(this.shown?.state.at ?? 0);
      return [Math.max(2, first), Math.min(this.shown?.tracks.stands.length ?? STRETCH, first + STRETCH) - 1];
    },
  });

  constructor(parts: FigureParts<FeetState>) {
    const { feet } = parts.words;
    super(parts, feet.title);
    const { picture, element } = this.frame;
    picture.append(this.#stances, this.#limits, this.#likelihood, this.#votes, this.#other, this.#speed, this.#ticks);
    picture.append(this.#handle.element, this.#point);
    this.lay({
      title: feet.title,
      picture: element,
      head: [this.choice("foot", feet.foot, SIDES, (side) => feet.sides[side])],
      controls: [this.toggle("hold", feet.hold)],
    });
  }

  protected async load(state: FeetState): Promise<Shown> {
    const { engine } = this.parts;
    const tracks = await tracksOf(engine, state);
    const votes = await votesOf(engine, state, tracks.stands.length);
    return { state: within(state, tracks), tracks, votes };
  }

  protected describe(shown: Shown): string {
    const { state, tracks } = shown;
    const { feet } = this.words;
    const [speed] = this.#read(shown, state.at);
    const time = this.number(state.at / tracks.rateHz, 2);
    return feet.said(time, feet.sides[state.foot], tracks.stands[state.at] === 1, speed, state.hold);
  }

  protected get columns() {
    return this.words.feet.columns;
  }

  protected rows(shown: Shown): string[][] {
    const [first, last] = [shown.votes.frames[0]!, shown.votes.frames.at(-1)!];
    return Array.from({ length: Math.floor((last - first) / TABLE_STEP) + 1 }, (_, i) => {
      const at = first + i * TABLE_STEP;
      return [this.number(at / shown.tracks.rateHz, 2), ...this.#read(shown, at)];
    });
  }

  protected override quantities(shown: Shown) {
    const { state, tracks, votes } = shown;
    const [speed, likelihood] = this.#read(shown, state.at);
    return {
      P: likelihood,
      c: this.number(votes.votes[nearest(votes, state.at)] ?? Number.NaN, 2),
      p: `${speed} cm/s`,
      i: `${this.number(state.at / tracks.rateHz, 2)} s`,
    };
  }

  /** Speed and P at a frame, as text. */
  #read({ state, tracks, votes }: Shown, at: number): [speed: string, likelihood: string] {
    const { speeds } = state.hold ? tracks.held : tracks.free;
    return [this.number(speeds[at]!, 1), this.number(votes.likelihoods[nearest(votes, at)] ?? Number.NaN, 2)];
  }

  protected draw(shown: Shown): void {
    const { state, tracks, votes } = shown;
    const { rateHz, stands } = tracks;
    const [first, last] = [stretchOf(state.at), stretchOf(state.at) + STRETCH];
    const axes = this.plot(
      { min: first / rateHz, max: last / rateHz },
      { min: 0, max: MOST },
      { x: this.words.feet.time, y: "", columns: 6, digits: 1, rows: 4 },
      { margin: ROOM },
    );
    const x = (frame: number) => axes.x(frame / rateHz);
    const share = (p: number) => axes.y(p * MOST);
    this.#stances.replaceChildren(
      ...runsOf(first, Math.min(last, stands.length), (frame) => stands[frame] === 1).map(([from, to]) =>
        svg("rect", { x: x(from), y: share(1), width: x(to) - x(from), height: share(0) - share(1) }),
      ),
    );
    const level = (p: number) => `M${axes.left} ${share(p)}H${axes.right}`;
    setAttributes(this.#limits, { d: level(PLANT) + level(RELEASE) });
    const line = (frames: readonly number[], y: (i: number) => number) =>
      `M${frames.map((frame, i) => `${x(frame).toFixed(1)} ${y(i).toFixed(1)}`).join("L")}`;
    setAttributes(this.#likelihood, { d: line(votes.frames, (i) => share(votes.likelihoods[i]!)) });
    this.#votes.replaceChildren(
      ...votes.frames.map((frame, i) => svg("circle", { cx: x(frame), cy: share(votes.votes[i]!), r: 2 })),
    );
    const frames = Array.from({ length: Math.min(last, stands.length) - first }, (_, i) => first + i);
    const curve = (speeds: Float64Array) => line(frames, (i) => axes.y(Math.min(MOST, speeds[first + i]!)));
    const [chosen, other] = state.hold ? [tracks.held, tracks.free] : [tracks.free, tracks.held];
    setAttributes(this.#speed, { d: curve(chosen.speeds) });
    setAttributes(this.#other, { d: curve(other.speeds) });
    const right = axes.right + 6;
    this.#ticks.replaceChildren(
      ...[0, RELEASE, PLANT, 1].map((p) => svg("text", { x: right, y: share(p) + 4 }, this.number(p, 1))),
      svg("text", { x: right, y: share(1) - 10 }, this.words.feet.likelihood),
      // Below the flag, which is at the left where the foot lands.
      svg("text", { x: axes.left, y: share(1) - 4 }, this.words.feet.speed),
    );
    const { at } = state;
    setAttributes(this.#point, { cx: x(at), cy: axes.y(Math.min(MOST, chosen.speeds[at]!)) });
    this.#handle.place({ x: x(at), bottom: share(0), value: at, text: this.sentence() });
    setText(this.readout, this.words.feet.read(...this.#read(shown, at)));
  }
}

/** The vote nearest to a frame. */
function nearest({ frames }: Votes, at: number): number {
  return frames.reduce((found, frame, i) => (Math.abs(frame - at) < Math.abs(frames[found]! - at) ? i : found), 0);
}
