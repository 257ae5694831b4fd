/**
 * The weights of two styles as the axes of a plane: the neutral style is the origin, and beyond the triangle there is
 * no data.
 */
import type { Knob } from "../../ui/controls/knob";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { hatching } from "../../ui/polygon/drawing";
import { type Axes, digitsOf, ticksOf, xOf, yOf } from "../axes";
import { createKnobs } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlaneHandles } from "../plane_handles";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./pace.css?inline";
import { measurePace, type Paced, pacedOf, ratioOf } from "./pace_measure";
import { BLENDED, type Blended, neutralOf, PACE_FIELDS, type PaceState, WEIGHT } from "./pace_state";

/** Step of an arrow key, in weights; with Shift the fine one. */
const STEP = { coarse: 0.05, fine: 0.01 };
/** The displayed range: all weights, and space for the handle at their limits. */
const SHOWN = [WEIGHT.min - 0.05, WEIGHT.max + 0.05] as const;

export const POLYGON: FigureKind<PaceState> = {
  fields: PACE_FIELDS,
  sheet,
  create: (parts) => new BlendFigure(parts),
};

class BlendFigure implements FigureInstance<PaceState> {
  readonly #parts: FigureParts<PaceState>;
  readonly #frame: PlotFrame;
  readonly #knobs: Record<Blended, Knob>;
  readonly #beyond = svg("path", { fill: "url(#beyond-hatching)", "fill-rule": "evenodd" });
  readonly #triangle = svg("path", { class: "triangle", "data-term": "s" });
  readonly #corners = svg("g", { class: "corners" });
  readonly #handles: PlaneHandles;
  readonly #readout = html("p", { class: "readout" });
  readonly #pacing = new Latest<PaceState>((state) => this.#pace(state));
  #state: PaceState | undefined;
  #paced: { state: PaceState; paced: Paced } | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<PaceState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.pace.blend, () => this.#drawNow(), signal);
    const settle = () => change({}, true);
    this.#knobs = createKnobs(
      BLENDED,
      words,
      words.pace.knobs,
      { old: WEIGHT, childlike: WEIGHT },
      PACE_FIELDS,
      change,
    );
    const { picture } = this.#frame;
    this.#handles = new PlaneHandles(
      picture,
      [words.pace.handle],
      (fine) => (fine ? STEP.fine : STEP.coarse),
      {
        axes: () => this.#axes,
        onInput: (_, [old, childlike]) => change({ old: weight(old), childlike: weight(childlike) }, false),
        onSettle: settle,
      },
      signal,
    );
    picture.append(hatching("beyond-hatching"), this.#beyond, this.#triangle, this.#corners, ...this.#handles.elements);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.pace.blend)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
      html("div", { class: "knobs" }, ...BLENDED.map((name) => this.#knobs[name].element)),
    );
  }

  show(state: PaceState): Promise<void> {
    this.#state = state;
    for (const name of BLENDED) this.#knobs[name].value = state[name];
    this.#draw();
    return this.#pacing.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measurePace(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#paced) return "";
    const { state, paced } = this.#paced;
    const { words } = this.#parts;
    return words.pace.blended(...this.#shares(state), figure(ratioOf(paced), 3, words));
  }

  table(): Table {
    const { words } = this.#parts;
    const state = this.#state;
    if (!state) return { head: words.pace.shares, rows: [] };
    const [old, childlike, neutral] = this.#shares(state);
    const { styles } = words;
    return {
      head: words.pace.shares,
      rows: [
        [styles.old, old],
        [styles.childlike, childlike],
        [styles.neutral, neutral],
      ],
    };
  }

  values(): Readonly<Record<string, string>> {
    return this.#state ? { s: this.#shares(this.#state).join(", ") } : {};
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
    for (const name of BLENDED) this.#knobs[name].element.classList.toggle("lit", term === "s");
  }

  #shares(state: PaceState): [old: string, childlike: string, neutral: string] {
    const shares = [state.old, state.childlike, neutralOf(state)];
    return shares.map((value) => figure(value, 2, this.#parts.words)) as [string, string, string];
  }

  async #pace(state: PaceState): Promise<void> {
    const paced = await pacedOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted) return;
    this.#paced = { state, paced };
    this.#draw();
  }

  #draw(): void {
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const state = this.#state;
    if (!state) return;
    const { words } = this.#parts;
    const axes: Axes = { width: this.#frame.width, height: this.#frame.height, x: SHOWN, y: SHOWN };
    this.#axes = axes;
    const ticks = ticksOf(axes.x, 8);
    const columns = ticks.map((value) => [value, figure(value, digitsOf(ticks), words)] as const);
    const { styles } = words;
    this.#frame.drawGrid(axes, { x: styles.old, y: styles.childlike, columns, rows: ticksOf(axes.y, 6) }, words);
    const at = (x: number, y: number) => `${xOf(axes, x).toFixed(1)} ${yOf(axes, y).toFixed(1)}`;
    const triangle = `M${at(0, 0)}L${at(1, 0)}L${at(0, 1)}Z`;
    const [[left, right], [bottom, top]] = [axes.x, axes.y];
    setAttributes(this.#beyond, {
      d: `M${at(left, bottom)}L${at(right, bottom)}L${at(right, top)}L${at(left, top)}Z${triangle}`,
    });
    setAttributes(this.#triangle, { d: triangle });
    this.#corners.replaceChildren(
      ...(
        [
          [0, 0, styles.neutral, -8, 16, "end"],
          [1, 0, styles.old, 8, 16, "start"],
          [0, 1, styles.childlike, 8, -6, "start"],
        ] as const
      ).map(([x, y, name, dx, dy, anchor]) =>
        svg("text", { class: "label", x: xOf(axes, x) + dx, y: yOf(axes, y) + dy, "text-anchor": anchor }, name),
      ),
    );
    this.#handles.place(axes, [[state.old, state.childlike]], () => words.pace.weights(...this.#shares(state)));
    const paced = this.#paced?.paced;
    const secs = (value: number) => figure(value, 2, words);
    const read = paced
      ? words.pace.read(secs(paced.secs * ratioOf(paced)), secs(paced.secs), figure(ratioOf(paced), 3, words))
      : "";
    setText(this.#readout, read);
  }
}

/** A weight rounded and clamped to its range. */
function weight(value: number): number {
  return Number(Math.min(WEIGHT.max, Math.max(WEIGHT.min, value)).toFixed(WEIGHT.digits));
}
