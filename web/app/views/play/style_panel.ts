/** The Style panel: the polygon, triangle or whole, and the intensity. */

import { BODY_PARTS, type BodyPart, type DatabaseInfo } from "../../../client/protocol";
import { PLAY_RANGES, type Side } from "../../../link/play";
import { button, Segment } from "../../../ui/controls/buttons";
import { icon } from "../../../ui/controls/icons";
import { Slider } from "../../../ui/controls/slider";
import { html, setText } from "../../../ui/dom";
import { Polygon } from "../../../ui/polygon/polygon";
import { isBeyondData, type Selection, toTriangle, vertexOrder } from "../../../ui/polygon/selection";
import { type AppState, FIELDS } from "../../state/state";
import type { Store } from "../../state/store";
import {
  keyUnder,
  otherSide,
  ownParts,
  plausibleIntensity,
  randomStyles,
  shownStyles,
  stylesAt,
  withoutPart,
  withStyles,
} from "../../state/style_settings";
import { strings } from "../../strings/strings";
import { manner, numberWord } from "../../ui/words";
import { Hints } from "./hints";

export class StylePanel {
  readonly element: HTMLElement;
  readonly polygon: Polygon;
  readonly #mode: Segment<"triangle" | "whole">;
  readonly #intensity: Slider;
  readonly #side: Segment<Side>;
  readonly #part = html("select", { "aria-label": strings.play.style.part });
  readonly #follow: HTMLButtonElement;
  readonly #store: Store;
  readonly #caption = html("p", { class: "caption polygon-caption" });
  #database: DatabaseInfo | undefined;
  #vertices: readonly string[] = [];
  #selection: Selection = [];
  readonly #hints = new Hints();
  readonly #playhead: () => number | undefined;
  /** Frame at which the current gesture began during playback: the whole gesture edits one key. */
  #gestureAt: number | undefined;

  /**
   * @param playhead returns the displayed frame of the input; `undefined` without a timeline
   * @param onAdd called when a clip is to be chosen that becomes a style
   */
  constructor(store: Store, playhead: () => number | undefined, onAdd: () => void, top: HTMLElement) {
    this.#store = store;
    this.#playhead = playhead;
    const over = (act: () => void) => () => {
      this.#gestureAt = undefined;
      act();
    };
    const { onSettle, onCancel } = store.gestureListeners;
    this.polygon = new Polygon({
      onChange: (styles, gesture) => {
        this.#hints.follow("drag");
        store.edit(withStyles(store.state, styles, this.#frameOf(gesture)), gesture);
      },
      onSettle: over(onSettle),
      onCancel: over(onCancel),
    });
    this.#mode = new Segment(
      strings.play.style.mixed,
      [
        { value: "triangle", label: strings.play.style.three },
        { value: "whole", label: strings.play.style.all },
      ],
      (mode) => {
        store.edit({ wholePolygon: mode === "whole", ...this.#withMode(mode) });
      },
    );
    this.#side = new Segment<Side>(
      strings.play.style.setting,
      [
        { value: "a", label: "A" },
        { value: "b", label: "B" },
      ],
      () => store.edit(otherSide(store.state)),
    );
    this.#side.element.title = strings.play.style.settings;
    const random = button(strings.play.style.random, () => this.mixByChance(), {
      icon: "random",
      label: true,
      class: "random-styles",
      keys: "R",
    });
    random.setAttribute("aria-label", strings.play.style.random);
    const { add, addName, addWhy } = strings.play.style;
    const more = button(add, onAdd, { icon: "add", label: true, class: "outlined add-style" });
    more.title = addWhy;
    more.setAttribute("aria-label", addName);
    this.#part.addEventListener("change", () => store.edit({ part: this.#part.value as BodyPart | "" }));
    this.#follow = button(strings.play.style.reset, () => this.#letPartFollow(), { label: true, class: "plain" });
    this.#follow.setAttribute("aria-label", strings.play.style.resetPart);
    this.#follow.title = strings.play.style.resetPartWhy;
    this.#intensity = new Slider(strings.play.style.intensity, PLAY_RANGES.intensity, FIELDS.intensity.initial, {
      onInput: (intensity) => store.edit({ intensity }, "intensity"),
      onSettle: () => store.endGesture(),
    });
    this.element = html(
      "section",
      { class: "section style", "aria-labelledby": "style-heading" },
      html(
        "div",
        { class: "section-heading" },
        html("h2", { id: "style-heading" }, strings.play.style.heading),
        this.#side.element,
        random,
        this.#mode.element,
      ),
      more,
      this.polygon.element,
      html("div", { class: "polygon-foot" }, this.#caption, top),
      this.#intensity.element,
      html(
        "div",
        { class: "row body-parts" },
        html("span", { class: "label", "aria-hidden": "true" }, strings.play.style.part),
        html("div", { class: "select plain-select" }, this.#part, icon("chevron")),
        this.#follow,
      ),
    );
  }

  /** Mixes three random styles. */
  mixByChance(): void {
    if (!this.#database) return;
    const styles = randomStyles(this.#vertices);
    this.#store.edit({ ...withStyles(this.#store.state, styles, this.#playhead()), wholePolygon: false });
  }

  /** Styles clockwise from the top, in the order of the number keys. */
  get vertices(): readonly string[] {
    return this.#vertices;
  }

  /** Selects only the style after the heaviest one, clockwise, or the one before it. */
  corner(by: -1 | 1): void {
    const { length } = this.#vertices;
    const heaviest = this.#selection.reduce((a, b) => (b.weight > a.weight ? b : a), { name: "", weight: -1 });
    const at = this.#vertices.indexOf(heaviest.name);
    if (length > 0) this.polygon.takeAllOf(this.#vertices[(at + by + length) % length]!);
  }

  /** Moves the polygon's point like an arrow key. */
  movePoint(key: string): void {
    this.polygon.press(key);
  }

  /** Sets the styles of another database. */
  set database(database: DatabaseInfo) {
    this.#database = database;
    this.#vertices = vertexOrder(database.styles, database.neutral);
    this.#mode.relabel(
      "triangle",
      `${numberWord(Math.min(3, database.styles.length))}`.replace(/^./, (c) => c.toUpperCase()),
    );
    this.#mode.relabel("whole", strings.play.style.allOf(numberWord(database.styles.length)));
    this.#mode.element.hidden = database.styles.length <= 3;
  }

  /** Shows the state; with `glide` the handle moves with an animation. */
  show(state: Readonly<AppState>, glide: boolean): void {
    const { wholePolygon: whole, intensity, side } = state;
    const selection = this.#selectionOf(state);
    this.#selection = selection;
    const beyond = isBeyondData(selection, intensity);
    this.polygon.show({ vertices: this.#vertices, selection, whole, beyond }, glide);
    this.#mode.value = whole ? "whole" : "triangle";
    this.#intensity.value = intensity;
    this.#intensity.plausible = plausibleIntensity(selection);
    this.#side.value = side;
    this.#showParts(state);
    if (state.part) this.#hints.follow("part");
    if (state.track.length > 0) this.#hints.follow("key");
    setText(this.#caption, beyond ? strings.play.style.beyond : this.#database ? this.#hints.text : "");
  }

  #showParts(state: Readonly<AppState>): void {
    const own = ownParts(state);
    const neutral = this.#database?.neutral ?? "";
    const described = (part: BodyPart | "") => {
      const styles = part && state.parts[part];
      return styles
        ? `${strings.play.style.parts[part]}: ${manner(styles, state.intensity, neutral)}`
        : strings.play.style.parts[part];
    };
    const names = ["", ...BODY_PARTS] as const;
    this.#part.replaceChildren(...names.map((part) => html("option", { value: part }, described(part))));
    this.#part.value = state.part;
    this.#follow.hidden = !own.some((part) => part === state.part);
  }

  #letPartFollow(): void {
    const { state } = this.#store;
    if (state.part) this.#store.edit(withoutPart(state, state.part));
  }

  /** The changes for another mode. Between keys only the polygon changes. */
  #withMode(mode: "triangle" | "whole"): Partial<AppState> {
    const { state } = this.#store;
    const frame = this.#playhead();
    if (mode === "whole" || (frame !== undefined && this.#isBetweenKeys(state, frame))) return {};
    return withStyles(state, toTriangle(shownStyles(state), this.#vertices), frame);
  }

  /** The frame that an edit applies to. */
  #frameOf(gesture: string | undefined): number | undefined {
    const at = this.#playhead();
    if (gesture === undefined || !this.#store.state.playing || at === undefined) return at;
    this.#gestureAt ??= at;
    return this.#gestureAt;
  }

  #isBetweenKeys(state: Readonly<AppState>, frame: number): boolean {
    return state.part === "" && state.track.length > 0 && keyUnder(state, frame) < 0;
  }

  /** The styles that the polygon shows; while paused, those of the track at the playhead. */
  #selectionOf(state: Readonly<AppState>): Selection {
    const frame = this.#playhead();
    if (state.playing || frame === undefined || state.part !== "" || state.track.length === 0)
      return shownStyles(state);
    const under = state.track[keyUnder(state, frame)];
    if (under) return under.styles;
    const reached = stylesAt(state, frame);
    return state.wholePolygon ? reached : toTriangle(reached, this.#vertices);
  }
}
