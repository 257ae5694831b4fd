/**
 * The keys of the style track as diamonds over the timeline: pressed to be selected, dragged or moved with the arrow
 * keys in time, and removed with Delete or a double click.
 */

import type { TrackKey } from "../../../../link/play";
import { formatNumber, html, setAttributes } from "../../../../ui/dom";
import { type GestureListeners, listenToDrags } from "../../../../ui/drag";
import { strings } from "../../../strings/strings";

interface TrackKeyListeners extends GestureListeners {
  /** Called when a key was selected. */
  onChoose: (key: number) => void;
  /** Called when a key was moved to a frame. */
  onMove: (key: number, frame: number) => void;
  onRemove: (key: number) => void;
}

/** Maps frames to pixels of the timeline and back. */
interface FramePlaces {
  x(frame: number): number;
  frameAt(clientX: number): number;
}

/** Frames moved by an arrow key, and with Shift. */
const STEP = 1;
const FAR_STEP = 10;
/** A press that moves less than this, in pixels, selects. */
const DRAG_PX = 3;

export class TrackKeys {
  readonly element = html("div", { class: "track-keys" });
  readonly #line = html("div", { class: "track-line" });
  readonly #listeners: TrackKeyListeners;
  #places: FramePlaces | undefined;
  #elements: HTMLElement[] = [];
  #track: readonly TrackKey[] = [];
  #chosen = 0;
  #rateHz = 60;
  #frames = 1;
  #describe: (key: TrackKey) => string = () => "";

  constructor(listeners: TrackKeyListeners) {
    this.#listeners = listeners;
    this.element.append(this.#line);
  }

  set places(places: FramePlaces) {
    this.#places = places;
    this.layOut();
  }

  /** The input of the track. */
  set input({ rateHz, frames }: { rateHz: number; frames: number }) {
    this.#rateHz = rateHz;
    this.#frames = frames;
    this.layOut();
  }

  /** Shows a track; `describe` returns the styles of a key as text. */
  show(track: readonly TrackKey[], chosen: number, describe: (key: TrackKey) => string): void {
    this.#track = track;
    this.#chosen = chosen;
    this.#describe = describe;
    // Elements are reused, so that a key keeps the focus while it moves.
    while (this.#elements.length > track.length) this.#elements.pop()!.remove();
    while (this.#elements.length < track.length) this.#elements.push(this.#make(this.#elements.length));
    this.layOut();
  }

  /** Moves the keys to the positions of their frames. */
  layOut(): void {
    const places = this.#places;
    if (!places) return;
    const xs = this.#track.map((key) => places.x(Math.min(key.frame, this.#frames - 1)));
    for (const [i, element] of this.#elements.entries()) {
      const key = this.#track[i]!;
      element.style.left = `${xs[i]!.toFixed(1)}px`;
      element.classList.toggle("chosen", i === this.#chosen);
      setAttributes(element, {
        "aria-label": strings.play.timeline.key(i + 1, this.#track.length),
        "aria-valuemin": 0,
        "aria-valuemax": this.#frames - 1,
        "aria-valuenow": key.frame,
        "aria-valuetext": strings.play.timeline.keyValue(
          formatNumber(key.frame / this.#rateHz, 2),
          this.#describe(key),
        ),
        title: strings.play.timeline.keyWhy(this.#describe(key), formatNumber(key.frame / this.#rateHz, 2)),
      });
    }
    this.#line.hidden = xs.length < 2;
    this.#line.style.left = `${xs[0] ?? 0}px`;
    this.#line.style.width = `${(xs.at(-1) ?? 0) - (xs[0] ?? 0)}px`;
  }

  #make(index: number): HTMLElement {
    const key = html("div", { class: "track-key", role: "slider", tabindex: 0, "aria-orientation": "horizontal" });
    const listeners = this.#listeners;
    listenToDrags(key, (press) => {
      let moved = false;
      listeners.onSettle();
      listeners.onChoose(index);
      return {
        move: ({ clientX }) => {
          moved ||= Math.abs(clientX - press.clientX) > DRAG_PX;
          if (moved && this.#places) listeners.onMove(index, this.#places.frameAt(clientX));
        },
        cancel: listeners.onCancel,
        end: listeners.onSettle,
      };
    });
    key.addEventListener("dblclick", () => listeners.onRemove(index));
    key.addEventListener("focus", () => {
      if (index !== this.#chosen) listeners.onChoose(index);
    });
    key.addEventListener("blur", () => listeners.onSettle());
    key.addEventListener("keydown", (event) => this.#onKey(event, index));
    this.element.append(key);
    return key;
  }

  #onKey(event: KeyboardEvent, index: number): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? FAR_STEP : STEP;
    const by = { ArrowLeft: -step, ArrowDown: -step, ArrowRight: step, ArrowUp: step }[event.key];
    if (by !== undefined) this.#listeners.onMove(index, this.#track[index]!.frame + by);
    else if (event.key === "Delete" || event.key === "Backspace") this.#listeners.onRemove(index);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
