/** The contact likelihood of a foot, and its speed over the ground, over a range of the motion. */
import { Toggle } from "../../ui/controls/buttons";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, type Margin, ticksOf, valueOfX, xOf, yOf } from "../axes";
import { Choice } from "../controls";
import { Handle } from "../handle";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./feet.css?inline";
import { measureFeet, PLANT, RELEASE, type Tracks, tracksOf, type Votes, votesOf, within } from "./feet_measure";
import { FEET_FIELDS, type FeetState, STRETCH, stretchOf } from "./feet_state";
import { SIDES, type Side } from "./soles";

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
  sheet,
  create: (parts) => new FeetFigure(parts),
};

interface Shown {
  state: FeetState;
  tracks: Tracks;
  votes: Votes;
}

class FeetFigure implements FigureInstance<FeetState> {
  readonly #parts: FigureParts<FeetState>;
  readonly #frame: PlotFrame;
  readonly #foot: Choice<Side>;
  readonly #hold: Toggle;
  readonly #stances = svg("g", { class: "stances" });
  readonly #limits = svg("path", { class: "limits", "data-term": "P" });
  readonly #votes = svg("g", { class: "dots", "data-term": "c" });
  readonly #likelihood = svg("path", { class: "likelihood", "data-term": "P" });
  readonly #other = svg("path", { class: "speed other" });
  readonly #speed = svg("path", { class: "speed", "data-term": "p" });
  readonly #ticks = svg("g", { class: "ticks" });
  readonly #point = svg("circle", { class: "query", r: 5 });
  readonly #handle: Handle;
  readonly #readout = html("p", { class: "readout" });
  readonly #tracking = new Latest<FeetState>((state) => this.#track(state));
  #state: FeetState | undefined;
  #shown: Shown | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<FeetState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.feet.title, () => this.#drawNow(), signal);
    this.#foot = new Choice(
      words.feet.foot,
      SIDES.map((side) => [side, words.feet.sides[side]] as const),
      (foot) => change({ foot }, true),
    );
    this.#hold = new Toggle(words.feet.hold, (hold) => change({ hold }, true));
    const { picture } = this.#frame;
    this.#handle = new Handle(
      words.playhead,
      "i",
      picture,
      {
        value: () => this.#axes && this.#shown?.state.at,
        valueOf: (x) => valueOfX(this.#axes!, x) * this.#shown!.tracks.rateHz,
        stepped: (at, direction, fine) => at + direction * (fine ? 1 : STEP),
        ends: () => {
          const first = stretchOf(this.#shown?.state.at ?? 0);
          return [Math.max(2, first), Math.min(this.#shown?.tracks.stands.length ?? STRETCH, first + STRETCH) - 1];
        },
        onInput: (at) => change({ at: Math.round(at) }, false),
        onSettle: () => change({}, true),
      },
      signal,
    );
    picture.append(this.#stances, this.#limits, this.#likelihood, this.#votes, this.#other, this.#speed, this.#ticks);
    picture.append(this.#handle.element, this.#point);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.feet.title), this.#foot.element),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
      html("div", { class: "knobs" }, this.#hold.element),
    );
  }

  show(state: FeetState): Promise<void> {
    this.#state = state;
    this.#foot.value = state.foot;
    this.#hold.on = state.hold;
    return this.#tracking.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureFeet(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const shown = this.#shown;
    if (!shown) return "";
    const { words } = this.#parts;
    const { state, tracks } = shown;
    const [speed] = this.#read(shown, state.at);
    const time = figure(state.at / tracks.rateHz, 2, words);
    return words.feet.said(time, words.feet.sides[state.foot], tracks.stands[state.at] === 1, speed, state.hold);
  }

  table(): Table {
    const { words } = this.#parts;
    const shown = this.#shown;
    if (!shown) return { head: words.feet.columns, rows: [] };
    const first = shown.votes.frames[0]!;
    const last = shown.votes.frames.at(-1)!;
    const rows = Array.from({ length: Math.floor((last - first) / TABLE_STEP) + 1 }, (_, i) => {
      const at = first + i * TABLE_STEP;
      return [figure(at / shown.tracks.rateHz, 2, words), ...this.#read(shown, at)];
    });
    return { head: words.feet.columns, rows };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#shown) return {};
    const { words } = this.#parts;
    const { state, tracks, votes } = this.#shown;
    const [speed, likelihood] = this.#read(this.#shown, state.at);
    return {
      P: likelihood,
      c: figure(votes.votes[nearest(votes, state.at)] ?? Number.NaN, 2, words),
      p: `${speed} cm/s`,
      i: `${figure(state.at / tracks.rateHz, 2, words)} s`,
    };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  async #track(state: FeetState): Promise<void> {
    const { engine, signal } = this.#parts;
    const tracks = await tracksOf(engine, state);
    const votes = await votesOf(engine, state, tracks.stands.length);
    if (signal.aborted) return;
    this.#shown = { state: within(state, tracks), tracks, votes };
    this.#parts.changed();
    this.#frame.request();
  }

  /** Speed and P at a frame, as text. */
  #read({ state, tracks, votes }: Shown, at: number): [speed: string, likelihood: string] {
    const { words } = this.#parts;
    const { speeds } = state.hold ? tracks.held : tracks.free;
    return [figure(speeds[at]!, 1, words), figure(votes.likelihoods[nearest(votes, at)] ?? Number.NaN, 2, words)];
  }

  #drawNow(): void {
    const shown = this.#shown;
    if (!shown) return;
    const { words } = this.#parts;
    const { state, tracks, votes } = shown;
    const { rateHz, stands } = tracks;
    const [first, last] = [stretchOf(state.at), stretchOf(state.at) + STRETCH];
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [first / rateHz, last / rateHz],
      y: [0, MOST],
      margin: ROOM,
    };
    this.#axes = axes;
    const columns = ticksOf(axes.x, 6).map((value) => [value, figure(value, 1, words)] as const);
    this.#frame.drawGrid(axes, { x: words.feet.time, y: "", columns, rows: ticksOf(axes.y, 4) }, words);
    const x = (frame: number) => xOf(axes, frame / rateHz);
    const share = (p: number) => yOf(axes, p * MOST);
    this.#stances.replaceChildren(
      ...spans(stands, first, last).map(([from, to]) =>
        svg("rect", { x: x(from), y: share(1), width: x(to) - x(from), height: share(0) - share(1) }),
      ),
    );
    const level = (p: number) => `M${xOf(axes, axes.x[0])} ${share(p)}H${xOf(axes, axes.x[1])}`;
    setAttributes(this.#limits, { d: level(PLANT) + level(RELEASE) });
    const line = (frames: readonly number[], y: (i: number) => number) =>
      `M${frames.map((frame, i) => `${x(frame).toFixed(1)} ${y(i).toFixed(1)}`).join("L")}`;
    setAttributes(this.#likelihood, { d: line(votes.frames, (i) => share(votes.likelihoods[i]!)) });
    this.#votes.replaceChildren(
      ...votes.frames.map((frame, i) => svg("circle", { cx: x(frame), cy: share(votes.votes[i]!), r: 2 })),
    );
    const frames = Array.from({ length: Math.min(last, stands.length) - first }, (_, i) => first + i);
    const curve = (speeds: Float64Array) => line(frames, (i) => yOf(axes, Math.min(MOST, speeds[first + i]!)));
    const [chosen, other] = state.hold ? [tracks.held, tracks.free] : [tracks.free, tracks.held];
    setAttributes(this.#speed, { d: curve(chosen.speeds) });
    setAttributes(this.#other, { d: curve(other.speeds) });
    const right = xOf(axes, axes.x[1]) + 6;
    this.#ticks.replaceChildren(
      ...[0, RELEASE, PLANT, 1].map((p) => svg("text", { x: right, y: share(p) + 4 }, figure(p, 1, words))),
      svg("text", { x: right, y: share(1) - 10 }, words.feet.likelihood),
      // Below the flag, which is at the left where the foot lands.
      svg("text", { x: xOf(axes, axes.x[0]), y: share(1) - 4 }, words.feet.speed),
    );
    const { at } = state;
    setAttributes(this.#point, { cx: x(at), cy: yOf(axes, Math.min(MOST, chosen.speeds[at]!)) });
    this.#handle.place({ x: x(at), bottom: share(0), value: at, text: this.sentence() });
    setText(this.#readout, words.feet.read(...this.#read(shown, at)));
  }
}

/** The vote nearest to a frame. */
function nearest({ frames }: Votes, at: number): number {
  return frames.reduce((found, frame, i) => (Math.abs(frame - at) < Math.abs(frames[found]! - at) ? i : found), 0);
}

/** First and last frames of the stances in a range. */
function spans(stands: Uint8Array, first: number, last: number): [from: number, to: number][] {
  const found: [number, number][] = [];
  for (let frame = first; frame < Math.min(last, stands.length); frame++) {
    if (stands[frame] !== 1) continue;
    const before = found.at(-1);
    if (before?.[1] === frame - 1) before[1] = frame;
    else found.push([frame, frame]);
  }
  return found;
}
