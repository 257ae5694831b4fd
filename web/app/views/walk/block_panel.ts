/** The panel of the selected block: its styles, its steps, their durations and lengths, and plots of the model. */

import "./block_panel.css";
import { button, Segment } from "../../../ui/controls/buttons";
import { icon } from "../../../ui/controls/icons";
import { Slider } from "../../../ui/controls/slider";
import { formatNumber, html, setText } from "../../../ui/dom";
import { Polygon } from "../../../ui/polygon/polygon";
import { isBeyondData, vertexOrder } from "../../../ui/polygon/selection";
import type { AppState } from "../../state/state";
import type { Store } from "../../state/store";
import {
  INTENSITY_RANGE,
  STEP_RANGE,
  TRANSITION_RANGE,
  WALK_RANGES,
  WALK_TEMPOS,
  type WalkBlock,
  type WalkTempo,
} from "../../state/walk";
import { strings } from "../../strings/strings";
import { capitalised, numberWord } from "../../ui/words";
import type { BlockFigures } from "./figures";
import { PLOT_SUBJECTS, Plot, type PlotSubject } from "./plots";

interface BlockPanelListeners {
  onBlock: (patch: Partial<WalkBlock>, gesture?: string) => void;
  onWhole: (whole: boolean) => void;
  /** Called when a beat was tapped. */
  onTap: () => void;
}

/** The selected block. */
interface BlockPanelModel {
  block: WalkBlock;
  title: string;
  /** Whether the plan has no other block, and so no transition. */
  alone: boolean;
  figures: BlockFigures;
}

/** The feet whose styles the polygon mixes. */
type Feet = keyof typeof strings.walk.foot;

export class BlockPanel {
  readonly element: HTMLElement;
  readonly plot = new Plot();
  readonly #heading = html("h2", { id: "walk-block-heading" });
  readonly #mode: Segment<"triangle" | "whole">;
  readonly #polygon: Polygon;
  readonly #caption = html("p", { class: "caption polygon-caption" });
  readonly #intensity: Slider;
  readonly #steps: Slider;
  readonly #transition: Slider;
  readonly #tempo: Segment<WalkTempo>;
  readonly #cadence: Slider;
  readonly #tap: HTMLButtonElement;
  readonly #feet: Segment<Feet>;
  readonly #stride: Slider;
  readonly #turn: Slider;
  readonly #subject = html("select", { "aria-label": strings.walk.plot });
  readonly #step = html("span", { class: "caption" });
  readonly #figures: Record<keyof BlockFigures, HTMLElement> = {
    cadence: html("dd"),
    stepLength: html("dd"),
    speed: html("dd"),
  };
  #vertices: readonly string[] = [];
  #block: WalkBlock | undefined;
  /** The foot selected last: if the feet differ, the polygon shows its styles. */
  #foot: "left" | "right" = "left";
  /** Whether the polygon's handle is being dragged, and so moves without easing. */
  #held = false;

  constructor(store: Store, { onBlock, onWhole, onTap }: BlockPanelListeners) {
    const { onSettle, onCancel } = store.gestureListeners;
    this.#polygon = new Polygon({
      onChange: (styles, gesture) => {
        this.#held = gesture !== undefined;
        onBlock(this.#shownFeet === "right" ? { right: styles } : { styles }, gesture);
      },
      onSettle: () => {
        this.#held = false;
        onSettle();
      },
      onCancel,
    });
    this.#mode = new Segment(
      strings.walk.mixed,
      [
        { value: "triangle", label: strings.play.style.three },
        { value: "whole", label: strings.play.style.all },
      ],
      (mode) => onWhole(mode === "whole"),
    );
    this.#feet = new Segment<Feet>(
      strings.walk.feet,
      (["both", "left", "right"] as const).map((value) => ({ value, label: strings.walk.foot[value] })),
      (feet) => {
        if (feet !== "both") this.#foot = feet;
        if (feet === "both") onBlock({ right: undefined });
        else onBlock({ right: this.#block!.right ?? this.#block!.styles });
      },
    );
    const slider = (
      name: string,
      range: typeof INTENSITY_RANGE | typeof STEP_RANGE,
      initial: number,
      key: keyof WalkBlock,
    ) => new Slider(name, range, initial, { onInput: (value) => onBlock({ [key]: value }, `walk ${key}`), onSettle });
    this.#intensity = slider(strings.walk.intensity, INTENSITY_RANGE, 1, "intensity");
    this.#intensity.plausible = { min: -1, max: 2 };
    this.#steps = slider(strings.walk.stepCount, STEP_RANGE, 4, "steps");
    this.#transition = new Slider(strings.walk.transition, TRANSITION_RANGE, 4, {
      onInput: (transition) => onBlock({ transition }, "walk transition"),
      onSettle,
    });
    this.#transition.words = strings.walk.between;
    this.#tempo = new Segment<WalkTempo>(
      strings.walk.durations,
      WALK_TEMPOS.map((value) => ({ value, label: strings.walk[value] })),
      (walkTempo) => store.edit({ walkTempo }),
    );
    this.#cadence = new Slider(strings.walk.cadence, WALK_RANGES.cadence, 110, {
      onInput: (walkCadence) => store.edit({ walkCadence }, "walk cadence"),
      onSettle,
    });
    this.#cadence.words = strings.walk.perMinute;
    this.#tap = button(strings.walk.tap, onTap, { label: true, class: "outlined walk-tap" });
    this.#tap.title = strings.walk.tapWhy;
    this.#stride = new Slider(strings.walk.stride, WALK_RANGES.stride, 100, {
      onInput: (walkStride) => store.edit({ walkStride }, "walk stride"),
      onSettle,
    });
    this.#stride.words = strings.walk.percent;
    this.#turn = new Slider(strings.walk.turn, WALK_RANGES.turn, 0, {
      onInput: (walkTurn) => store.edit({ walkTurn }, "walk turn"),
      onSettle,
    });
    this.#turn.words = strings.walk.turning;
    this.#subject.append(
      ...PLOT_SUBJECTS.map((value) =>
        html("option", { value }, value === "states" ? strings.walk.stateEnds : strings.walk.joints[value]),
      ),
    );
    this.#subject.addEventListener("change", () => store.edit({ walkPlot: this.#subject.value }));
    const figure = (name: string, value: HTMLElement) => html("div", { class: "row" }, html("dt", {}, name), value);
    this.element = html(
      "aside",
      { class: "walk-panel", "aria-label": strings.walk.heading },
      html(
        "section",
        { class: "walk-section", "aria-labelledby": "walk-block-heading" },
        html("div", { class: "section-heading" }, this.#heading, this.#mode.element),
        this.#polygon.element,
        this.#caption,
        html(
          "div",
          { class: "row" },
          html("span", { class: "label", "aria-hidden": "true" }, strings.walk.feet),
          this.#feet.element,
        ),
        this.#intensity.element,
      ),
      html(
        "section",
        { class: "walk-section" },
        this.#steps.element,
        this.#transition.element,
        html(
          "div",
          { class: "row" },
          html("span", { class: "label", "aria-hidden": "true" }, strings.walk.durations),
          this.#tempo.element,
        ),
        this.#cadence.element,
        this.#tap,
        this.#stride.element,
        this.#turn.element,
      ),
      html(
        "section",
        { class: "walk-section" },
        html(
          "div",
          { class: "section-heading" },
          html("div", { class: "select plain-select walk-subject" }, this.#subject, icon("chevron")),
          this.#step,
        ),
        this.plot.element,
      ),
      html(
        "section",
        { class: "walk-section" },
        html(
          "dl",
          { class: "walk-figures", "aria-label": strings.walk.figures },
          figure(strings.walk.cadence, this.#figures.cadence),
          figure(strings.walk.stepLength, this.#figures.stepLength),
          figure(strings.walk.speed, this.#figures.speed),
        ),
      ),
    );
  }

  /** Sets the styles of another model. */
  setStyles(styles: readonly string[], neutral: string): void {
    this.#vertices = vertexOrder(styles, neutral);
    this.#mode.relabel("triangle", capitalised(numberWord(Math.min(3, styles.length))));
    this.#mode.relabel("whole", strings.play.style.allOf(numberWord(styles.length)));
    this.#mode.element.hidden = styles.length <= 3;
  }

  show(state: Readonly<AppState>, { block, title, alone, figures }: BlockPanelModel): void {
    const { walkWhole: whole, walkTempo: tempo } = state;
    this.#block = block;
    setText(this.#heading, title);
    this.#mode.value = whole ? "whole" : "triangle";
    this.#feet.value = this.#shownFeet;
    const selection = this.#shownFeet === "right" ? block.right! : block.styles;
    const beyond = isBeyondData(selection, block.intensity);
    this.#polygon.show({ vertices: this.#vertices, selection, whole, beyond }, !this.#held);
    setText(this.#caption, beyond ? strings.walk.beyond : strings.walk.hint);
    this.#intensity.value = block.intensity;
    this.#steps.value = block.steps;
    this.#transition.value = block.transition;
    this.#transition.element.hidden = alone;
    this.#tempo.value = tempo;
    this.#cadence.element.hidden = tempo !== "fixed";
    this.#tap.hidden = tempo !== "fixed";
    this.#cadence.value = state.walkCadence;
    this.#stride.value = state.walkStride;
    this.#turn.value = state.walkTurn;
    setText(this.#figures.cadence, strings.walk.cadenceFigure(formatNumber(figures.cadence, 0)));
    setText(this.#figures.stepLength, strings.walk.metres(formatNumber(figures.stepLength, 2)));
    setText(this.#figures.speed, strings.walk.metresPerSecond(formatNumber(figures.speed, 2)));
  }

  dispose(): void {
    this.#polygon.dispose();
  }

  /** The feet whose styles the polygon shows. */
  get #shownFeet(): Feet {
    return this.#block?.right ? this.#foot : "both";
  }

  /** Shows the plotted quantity, and its step. */
  showSubject(subject: PlotSubject, step: string): void {
    this.#subject.value = subject;
    setText(this.#step, step);
  }
}
