/** The pad with the choosers of its motions and variables, and a slider for the variable without an axis. */
import "./pad.css";
import type { KeyStyleFrame } from "../../../client/models/key_style";
import { Slider } from "../../../ui/controls/slider";
import { formatNumber, html, setText } from "../../../ui/dom";
import type { GestureListeners } from "../../../ui/drag";
import type { Axis, TimedValue } from "../../state/key_style";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";
import { usualAxes } from "./axes";
import { AxisChooser } from "./axis_chooser";
import type { KeyMotion } from "./key_motion";
import { anotherSet, otherAxes } from "./model_trainer";
import { Pad, type PadListeners } from "./pad";
import { SetChooser, type SetModel } from "./set_chooser";

const words = strings.keyStyle;

interface PadPanelListeners extends Omit<PadListeners, "onMove" | keyof GestureListeners> {
  onMove: (values: readonly number[]) => void;
}

export class PadPanel {
  readonly element: HTMLElement;
  readonly #store: Store;
  readonly #listeners: PadPanelListeners;
  readonly #sets: SetChooser;
  readonly #axes: AxisChooser;
  readonly #pad: Pad;
  readonly #sliders = html("div", { class: "key-style-sliders" });
  readonly #hint = html("p", { class: "caption", role: "status" });
  #slider: { axis: number; control: Slider } | undefined;
  /** Whether the slider is being dragged. */
  #sliding = false;

  constructor(store: Store, listeners: PadPanelListeners) {
    this.#store = store;
    this.#listeners = listeners;
    this.#sets = new SetChooser(
      (set) => store.edit({ ...anotherSet(set), playing: true }),
      (keyClips) => store.edit({ ...otherAxes(store.state.keyAxes), keyClips }),
    );
    this.#axes = new AxisChooser((axes) => store.edit(otherAxes(axes)));
    this.#pad = new Pad({
      ...listeners,
      ...store.gestureListeners,
      onMove: (x, y) => listeners.onMove(store.state.keyHandle.map((value, axis) => [x, y][axis] ?? value)),
    });
    const legend = html(
      "p",
      { class: "pad-legend caption" },
      html("span", { class: "known", "aria-hidden": "true" }, words.recordedPoses),
      html("span", { class: "unknown", "aria-hidden": "true" }, words.noData),
      this.#hint,
    );
    this.element = html(
      "section",
      { class: "key-style-pad", "aria-labelledby": "pad-heading" },
      html(
        "div",
        { class: "key-style-head" },
        html("h2", { id: "pad-heading" }, words.heading),
        this.#sets.element,
        this.#axes.element,
      ),
      this.#axes.line,
      this.#pad.element,
      this.#sliders,
      legend,
    );
  }

  /** Follows the size of the page until `signal` aborts. */
  attach(signal: AbortSignal): void {
    this.#pad.attach(signal);
  }

  /** Shows another model. */
  present(motion: KeyMotion): void {
    this.#showSlider(motion);
    this.#showPad(motion);
  }

  /** Shows the settings of the state. */
  show(set: SetModel, axes: readonly Axis[], trail: readonly TimedValue[]): void {
    this.#sets.show(set);
    this.#axes.show(axes);
    this.#pad.trail = trail;
  }

  /** Shows other keys, and the curve of the motion through them. */
  showKeys(keys: readonly TimedValue[], chosen: number, { curve, rows }: KeyMotion): void {
    this.#pad.setKeys({ keys, chosen, curve: onPad(curve, rows.length) });
  }

  /** Share of the curve before the playhead, 0–1. */
  set played(share: number) {
    this.#pad.played = share;
  }

  /** Shows the variables, the values to which the model clamped them outside its data, and the weights of its components. */
  showFrame(
    { weights }: KeyStyleFrame,
    values: readonly number[],
    reached: Float32Array | undefined,
    motion: KeyMotion,
  ): void {
    const { rows, model } = motion;
    const beyond = reached !== undefined && motion.isBeyond(values, reached);
    const said = rows.map(({ title, unit, digits }, axis) =>
      words.valueOf(title, formatNumber(values[axis]!, digits), unit),
    );
    const spoken = beyond ? `${said.join(", ")}. ${words.beyond}` : said.join(", ");
    this.#pad.setHandle(values[0]!, values[1] ?? 0.5, spoken, beyond ? [reached[0]!, reached[1] ?? 0.5] : undefined);
    this.#pad.weights = weights;
    if (this.#slider) this.#slider.control.value = values[this.#slider.axis]!;
    const walks = model.axes.join() === usualAxes("walk").join();
    setText(this.#hint, beyond ? words.beyond : walks ? words.hintWalk : words.hint);
  }

  #showPad(motion: KeyMotion): void {
    const { rows, ranges, points, centres } = motion;
    const [x, y] = rows;
    const titled = ({ title, unit }: { title: string; unit: string }) => words.axisTitle(title, unit);
    this.#pad.show({
      titles: [titled(x!), y ? titled(y) : words.recordingTime],
      digits: [x!.digits, y?.digits ?? 0],
      ranges: [ranges[0]!, ranges[1] ?? { min: 0, max: 1 }],
      points,
      support: motion.support(this.#store.state.keyHandle),
      centres,
      overTime: y === undefined,
    });
  }

  /** The third variable, or the only one, has a slider. */
  #showSlider(motion: KeyMotion): void {
    const axis = motion.rows.length === 3 ? 2 : motion.rows.length === 1 ? 0 : -1;
    this.#slider = undefined;
    this.#sliders.replaceChildren();
    if (axis < 0) return;
    const { title, unit, digits } = motion.rows[axis]!;
    const { min, max } = motion.ranges[axis]!;
    const round = (value: number) => Number(value.toFixed(digits));
    const range = { min: round(min), max: round(max), digits };
    const { onGrab, onMove, onDrop } = this.#listeners;
    const handle = () => this.#store.state.keyHandle;
    const control = new Slider(title, range, motion.middle[axis]!, {
      onInput: (value) => {
        if (!this.#sliding) onGrab();
        this.#sliding = true;
        onMove(handle().map((former, i) => (i === axis ? value : former)));
      },
      onSettle: () => {
        this.#sliding = false;
        onDrop();
        // The support of the data depends on the third variable. While another model is trained, the pad is unchanged.
        if (this.#slider?.control === control && handle().length === motion.rows.length) this.#showPad(motion);
      },
    });
    control.words = (value) => `${formatNumber(value, digits)} ${unit}`.trim();
    this.#slider = { axis, control };
    this.#sliders.append(control.element);
  }
}

/** The points of a curve on the pad: the first two of all variables. */
function onPad(curve: Float32Array, axes: number): Float32Array {
  if (axes < 2) return new Float32Array();
  return Float32Array.from({ length: (2 * curve.length) / axes }, (_, i) => curve[Math.floor(i / 2) * axes + (i % 2)]!);
}
