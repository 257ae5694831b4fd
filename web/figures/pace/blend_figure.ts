/**
 * The weights of two styles as the axes of a plane: the neutral style is the origin, and beyond the triangle there is
 * no data.
 */
import { rounded } from "../../ui/controls/range";
import { setAttributes, setText, svg } from "../../ui/dom";
import { hatching } from "../../ui/polygon/drawing";
import type { FigureKind, FigureParts } from "../kind";
import { PlaneHandles } from "../plane_handles";
import { PlotFigure } from "../plot_figure";
import sheet from "./pace.css?inline";
import { measurePace, type Paced, pacedOf, ratioOf } from "./pace_measure";
import { BLENDED, neutralOf, PACE_FIELDS, type PaceState, WEIGHT } from "./pace_state";

/** Step of an arrow key, in weights; with Shift the fine one. */
const STEP = { coarse: 0.05, fine: 0.01 };
/** The displayed range: all weights, and space for the handle at their limits. */
const SHOWN = { min: WEIGHT.min - 0.05, max: WEIGHT.max + 0.05 } as const;

export const POLYGON: FigureKind<PaceState> = {
  fields: PACE_FIELDS,
  measure: measurePace,
  sheet,
  create: (parts) => new BlendFigure(parts),
};

/** The plane is drawn before the first blend is computed. */
interface Shown {
  state?: PaceState;
  paced?: Paced;
}

class BlendFigure extends PlotFigure<PaceState, Shown> {
  readonly #beyond = svg("path", { fill: "url(#beyond-hatching)", "fill-rule": "evenodd" });
  readonly #triangle = svg("path", { class: "triangle", "data-term": "s" });
  readonly #corners = svg("g", { class: "corners" });
  readonly #handles: PlaneHandles;
  protected override readonly drawsAhead = true;
  protected override shown: Shown | undefined = {};

  constructor(parts: FigureParts<PaceState>) {
    const { pace } = parts.words;
    super(parts, pace.blend);
    const { picture, element } = this.frame;
    this.#handles = new PlaneHandles(
      picture,
      [pace.handle],
      (fine) => (fine ? STEP.fine : STEP.coarse),
      {
        axes: () => this.axes,
        onInput: (_, [old, childlike]) =>
          this.change({ old: rounded(old, WEIGHT), childlike: rounded(childlike, WEIGHT) }, false),
        onSettle: () => this.settle(),
      },
      parts.signal,
    );
    picture.append(hatching("beyond-hatching"), this.#beyond, this.#triangle, this.#corners, ...this.#handles.elements);
    const ranges = { old: WEIGHT, childlike: WEIGHT };
    this.lay({
      title: pace.blend,
      picture: element,
      controls: this.knobs(BLENDED, pace.knobs, ranges, { old: "s", childlike: "s" }),
    });
  }

  protected async load(state: PaceState): Promise<Shown> {
    return { state, paced: await pacedOf(this.parts.engine, state) };
  }

  protected describe({ state, paced }: Shown): string {
    return state && paced ? this.words.pace.blended(...this.#shares(state), this.number(ratioOf(paced), 3)) : "";
  }

  protected get columns() {
    return this.words.pace.shares;
  }

  protected rows(_: Shown, state: PaceState): string[][] {
    const [old, childlike, neutral] = this.#shares(state);
    const { styles } = this.words;
    return [
      [styles.old, old],
      [styles.childlike, childlike],
      [styles.neutral, neutral],
    ];
  }

  protected override quantities(_: Shown, state: PaceState) {
    return { s: this.#shares(state).join(", ") };
  }

  #shares(state: PaceState): [old: string, childlike: string, neutral: string] {
    const shares = [state.old, state.childlike, neutralOf(state)];
    return shares.map((value) => this.number(value, 2)) as [string, string, string];
  }

  protected draw({ paced }: Shown, state: PaceState): void {
    const { styles } = this.words;
    const axes = this.plot(SHOWN, SHOWN, { x: styles.old, y: styles.childlike, columns: 8, rows: 6 });
    const triangle = `M${axes.at(0, 0)}L${axes.at(1, 0)}L${axes.at(0, 1)}Z`;
    const { min, max } = SHOWN;
    setAttributes(this.#beyond, {
      d: `M${axes.at(min, min)}L${axes.at(max, min)}L${axes.at(max, max)}L${axes.at(min, max)}Z${triangle}`,
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
        svg("text", { class: "label", x: axes.x(x) + dx, y: axes.y(y) + dy, "text-anchor": anchor }, name),
      ),
    );
    this.#handles.place(axes, [[state.old, state.childlike]], () => this.words.pace.weights(...this.#shares(state)));
    const secs = (value: number) => this.number(value, 2);
    const read = paced
      ? this.words.pace.read(secs(paced.secs * ratioOf(paced)), secs(paced.secs), this.number(ratioOf(paced), 3))
      : "";
    setText(this.readout, read);
  }
}
