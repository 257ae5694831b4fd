/** The pad with what belongs to it: the motions and variables that are learned, the sliders of what it has no direction for. */
import type { PuppetFrame } from "../../worker/key_style/key_style";
import { Slider } from "../controls/slider";
import { formatNumber, html, setText } from "../dom";
import { strings } from "../strings/strings";
import { type Axis, usualAxes } from "./axes";
import { AxisChooser } from "./axis_chooser";
import type { TimedValue } from "./keys";
import { Pad, type PadListeners } from "./pad";
import type { Performance } from "./performance";
import { SetChooser, type SetModel } from "./set_chooser";

const words = strings.keyStyle;

export interface PadPanelListeners extends Omit<PadListeners, "onMove"> {
  onSet: (set: string) => void;
  onClips: (clips: string[]) => void;
  onAxes: (axes: Axis[]) => void;
  /** Where the handle is now. */
  handle: () => readonly number[];
  onMove: (values: readonly number[]) => void;
}

export class PadPanel {
  readonly element: HTMLElement;
  readonly #listeners: PadPanelListeners;
  readonly #sets: SetChooser;
  readonly #axes: AxisChooser;
  readonly #pad: Pad;
  readonly #sliders = html("div", { class: "key-style-sliders" });
  readonly #hint = html("p", { class: "caption", role: "status" });
  #slider: { axis: number; control: Slider } | undefined;
  /** Whether the slider is in a hand. */
  #sliding = false;

  constructor(listeners: PadPanelListeners) {
    this.#listeners = listeners;
    this.#sets = new SetChooser(listeners.onSet, listeners.onClips);
    this.#axes = new AxisChooser(listeners.onAxes);
    this.#pad = new Pad({
      ...listeners,
      onMove: (x, y) => listeners.onMove(listeners.handle().map((value, axis) => [x, y][axis] ?? value)),
    });
    const legend = html(
      "p",
      { class: "pad-legend caption" },
      html("span", { class: "known" }, words.recordedPoses),
      html("span", { class: "unknown" }, words.noData),
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

  /** Takes another model. */
  present(acting: Performance): void {
    this.#showSlider(acting);
    this.#showPad(acting);
  }

  /** Shows what is asked for. */
  show(set: SetModel, axes: readonly Axis[], trail: readonly TimedValue[]): void {
    this.#sets.show(set);
    this.#axes.show(axes);
    this.#pad.trail = trail;
  }

  /** Takes other keys, with the way between them: all variables of a moment behind each other. */
  showKeys(keys: readonly TimedValue[], chosen: number, { way, rows }: Performance): void {
    this.#pad.setKeys({ keys, chosen, way: onPad(way, rows.length) });
  }

  /** How much of the way lies behind the playhead, 0–1. */
  set played(share: number) {
    this.#pad.played = share;
  }

  /** Shows the variables, where the model had to stay if it may not be there, and what the components do. */
  showFrame(
    { weights }: PuppetFrame,
    values: readonly number[],
    reached: Float32Array | undefined,
    acting: Performance,
  ): void {
    const { rows, model } = acting;
    const beyond = reached !== undefined && acting.isBeyond(values, reached);
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

  #showPad(acting: Performance): void {
    const { rows, ranges, points, centres } = acting;
    const [x, y] = rows;
    const titled = ({ title, unit }: { title: string; unit: string }) => words.axisTitle(title, unit);
    this.#pad.show({
      titles: [titled(x!), y ? titled(y) : words.recordingTime],
      digits: [x!.digits, y?.digits ?? 0],
      ranges: [ranges[0]!, ranges[1] ?? { least: 0, most: 1 }],
      points,
      support: acting.support(this.#listeners.handle()),
      centres,
      overTime: y === undefined,
    });
  }

  /** A variable that the pad has no direction for, or the only one, has a slider. */
  #showSlider(acting: Performance): void {
    const axis = acting.rows.length === 3 ? 2 : acting.rows.length === 1 ? 0 : -1;
    this.#slider = undefined;
    this.#sliders.replaceChildren();
    if (axis < 0) return;
    const { title, unit, digits } = acting.rows[axis]!;
    const { least, most } = acting.ranges[axis]!;
    const round = (value: number) => Number(value.toFixed(digits));
    const range = { min: round(least), max: round(most), digits };
    const { onGrab, onMove, onDrop, handle } = this.#listeners;
    const control = new Slider(title, range, acting.middle[axis]!, {
      onInput: (value) => {
        if (!this.#sliding) onGrab();
        this.#sliding = true;
        onMove(handle().map((former, i) => (i === axis ? value : former)));
      },
      onSettle: () => {
        this.#sliding = false;
        onDrop();
        // What is known depends on the variable that has no direction. While others are learned it stays.
        if (this.#slider?.control === control && handle().length === acting.rows.length) this.#showPad(acting);
      },
    });
    control.words = (value) => `${formatNumber(value, digits)} ${unit}`.trim();
    this.#slider = { axis, control };
    this.#sliders.append(control.element);
  }
}

/** The two variables of the pad, of all there are. */
function onPad(way: Float32Array, axes: number): Float32Array {
  if (axes < 2) return new Float32Array();
  return Float32Array.from({ length: (2 * way.length) / axes }, (_, i) => way[Math.floor(i / 2) * axes + (i % 2)]!);
}
