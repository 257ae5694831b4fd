/**
 * The two ends of the trim as handles, over the timeline and over the scrubber of a narrow screen: dragged, or moved with
 * the arrow keys.
 */
import "./trim_handles.css";
import type { FrameRange } from "../../../../client/protocol";
import { formatNumber, html, setAttributes } from "../../../../ui/dom";
import { type GestureListeners, listenToDrags } from "../../../../ui/drag";
import { strings } from "../../../strings/strings";
import { type Edge, trimOf, withEdge } from "./trim";

const words = strings.play.trim;

/** Called for the ends of the trim. */
export interface TrimListeners extends GestureListeners {
  /** Called when the trim changes; `undefined` is the whole motion. */
  onRange: (range: FrameRange | undefined) => void;
  /** Called with the frame at a handle that moves, which the picture shows. */
  onScrub: (frame: number) => void;
  onScrubEnd: () => void;
}

/** Maps frames to positions and back. */
interface FramePlaces {
  /** Position of a frame from the left of the handles' container, a length of CSS. */
  left(frame: number): string;
  /** Frame at an X position in the page. */
  frameAt(clientX: number): number;
}

const EDGES = ["first", "last"] as const satisfies readonly Edge[];
/** Frames that an arrow key moves a handle, and with Shift. */
const STEP = 1;
const FAR_STEP = 10;

export class TrimHandles {
  readonly element = html("div", { class: "trim-handles" });
  readonly #listeners: TrimListeners;
  readonly #places: FramePlaces;
  readonly #handles: Record<Edge, HTMLElement>;
  #range: FrameRange | undefined;
  #frames = 2;
  #rateHz = 60;

  constructor(listeners: TrimListeners, places: FramePlaces) {
    this.#listeners = listeners;
    this.#places = places;
    this.#handles = { first: this.#make("first"), last: this.#make("last") };
    this.element.append(...EDGES.map((edge) => this.#handles[edge]));
  }

  /** The motion that is trimmed. */
  set input({ frames, rateHz }: { frames: number; rateHz: number }) {
    this.#frames = frames;
    this.#rateHz = rateHz;
    this.layOut();
  }

  /** The trim; `undefined` is the whole motion. */
  set range(range: FrameRange | undefined) {
    this.#range = range;
    this.layOut();
  }

  /** Moves the handles to the positions of their frames. */
  layOut(): void {
    const trim = trimOf(this.#range, this.#frames);
    for (const edge of EDGES) {
      const handle = this.#handles[edge];
      const secs = formatNumber(trim[edge] / this.#rateHz, 2);
      handle.style.left = this.#places.left(trim[edge]);
      setAttributes(handle, {
        "aria-valuemin": edge === "first" ? 0 : trim.first + 1,
        "aria-valuemax": edge === "first" ? trim.last - 1 : this.#frames - 1,
        "aria-valuenow": trim[edge],
        "aria-valuetext": words.at(secs),
        title: words.why[edge](secs),
      });
    }
  }

  #make(edge: Edge): HTMLElement {
    const handle = html("div", {
      class: `trim-handle ${edge}`,
      role: "slider",
      tabindex: 0,
      "aria-orientation": "horizontal",
      "aria-label": words.edge[edge],
    });
    const listeners = this.#listeners;
    listenToDrags(handle, (press) => {
      const box = handle.getBoundingClientRect();
      const grabbed = press.clientX - (edge === "first" ? box.right : box.left);
      const before = this.#range;
      let moved = false;
      listeners.onSettle();
      return {
        move: ({ clientX }) => {
          moved = true;
          this.#move(edge, this.#places.frameAt(clientX - grabbed));
        },
        cancel: () => {
          listeners.onCancel();
          if (moved) listeners.onScrub(trimOf(before, this.#frames)[edge]);
        },
        end: () => {
          listeners.onSettle();
          if (moved) listeners.onScrubEnd();
        },
      };
    });
    handle.addEventListener("dblclick", () => this.#release(edge));
    handle.addEventListener("blur", () => listeners.onSettle());
    handle.addEventListener("keydown", (event) => this.#onKey(event, edge));
    return handle;
  }

  /** Moves an end of the trim, and shows the frame there. */
  #move(edge: Edge, frame: number): void {
    const range = withEdge(this.#range, edge, frame, this.#frames);
    this.#listeners.onRange(range);
    this.#listeners.onScrub(trimOf(range, this.#frames)[edge]);
  }

  /** Moves an end of the trim to that of the motion. */
  #release(edge: Edge): void {
    this.#listeners.onRange(withEdge(this.#range, edge, edge === "first" ? 0 : this.#frames - 1, this.#frames));
    this.#listeners.onSettle();
  }

  #onKey(event: KeyboardEvent, edge: Edge): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const at = trimOf(this.#range, this.#frames)[edge];
    const step = event.shiftKey ? FAR_STEP : STEP;
    const to = {
      ArrowLeft: at - step,
      ArrowDown: at - step,
      ArrowRight: at + step,
      ArrowUp: at + step,
      Home: 0,
      End: this.#frames - 1,
    }[event.key];
    if (to !== undefined) {
      this.#move(edge, to);
      this.#listeners.onScrubEnd();
    } else if (event.key === "Delete" || event.key === "Backspace") this.#release(edge);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
