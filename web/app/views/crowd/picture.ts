/** The picture of the crowd: the drawing, and its overlays: the handles, the route, and a line to the card. */

import type { CrowdTick } from "../../../client/crowd/crowd_client";
import type { FieldVertex, Place } from "../../../client/crowd/limits";
import { html, svg } from "../../../ui/dom";
import { listenToDrags } from "../../../ui/drag";
import type { ThemeName } from "../../../viewer";
import { CrowdViewer } from "../../../viewer/crowd/crowd_viewer";
import type { CrowdCamera } from "../../state/crowd";
import { spoken } from "../../ui/words";
import { rgbOf, type StyleColours } from "./colours";
import type { Handles } from "./handles";
import { Pace } from "./pace";
import { dense, routeOf } from "./route";
import { tintsOf } from "./tints";

const VIEWS = { orbit: "orbit", above: "top", along: "front" } as const satisfies Record<CrowdCamera, string>;
/** A press that moves farther than this, pixels, turns the camera and selects nothing. */
const CLICK_PX = 5;
/** Height at which the line to the card begins, metres. */
const WAIST = 1;
/** A picture for which the GPU was not ready is tried again after this time, milliseconds. */
const RETRY_MS = 4;

interface PictureListeners {
  /** Called when a walker, or empty ground, was clicked. */
  onWalker: (walker: number | undefined) => void;
  /** Called when the user turned the camera. */
  onTurn: () => void;
  onFps: (fps: number) => void;
  /** Called when a route was drawn; empty if it was too short. */
  onRoute: (route: readonly Place[]) => void;
}

export class CrowdPicture {
  readonly #stage: HTMLElement;
  readonly #viewer: CrowdViewer;
  readonly #colours: StyleColours;
  readonly #handles: Handles;
  readonly #card: HTMLElement;
  readonly #leader = svg("path", { class: "crowd-leader" });
  readonly #route = svg("path", { class: "crowd-route" });
  readonly #overlay = svg("svg", { class: "crowd-overlay", "aria-hidden": "true" }, this.#route, this.#leader);
  /** Covers everything while a route is drawn. */
  readonly #sheet = html("div", { class: "crowd-sheet", hidden: true });
  #points: readonly Place[] = [];
  #tints = new Uint8Array(0);
  #chosen: number | undefined;
  #camera: CrowdCamera = "orbit";
  readonly #pace = new Pace();

  constructor(
    stage: HTMLElement,
    parts: { colours: StyleColours; handles: Handles; card: HTMLElement },
    listeners: PictureListeners,
    signal: AbortSignal,
  ) {
    this.#stage = stage;
    this.#colours = parts.colours;
    this.#handles = parts.handles;
    this.#card = parts.card;
    const drawing = html("div", { class: "stage-view" });
    stage.replaceChildren(drawing, this.#overlay, parts.handles.element, this.#sheet);
    this.#viewer = new CrowdViewer(drawing, parts.colours.theme, "");
    this.#viewer.onFps = listeners.onFps;
    this.#viewer.onViewChange = () => {
      this.#camera = "orbit";
      listeners.onTurn();
    };
    parts.handles.ground = this.#viewer;
    listenToClicks(drawing, (x, y) => listeners.onWalker(this.#viewer.walkerAt(x, y)), signal);
    this.#listenToSheet(listeners.onRoute, signal);
    signal.addEventListener("abort", () => this.#dispose(), { once: true });
  }

  /** Name of the renderer as reported by the browser. */
  get drawnBy(): string {
    return this.#viewer.drawnBy;
  }

  /** Time of the page per picture, milliseconds. */
  get frameMs(): number | undefined {
    return this.#pace.ms;
  }

  set description(text: string) {
    this.#viewer.description = text;
  }

  set theme(theme: ThemeName) {
    this.#viewer.theme = theme;
  }

  /** Sets the bones on which all agents are drawn. */
  setProportions(proportions: Float32Array): void {
    this.#viewer.setProportions(proportions);
  }

  /** Sets the field; `visible` tells whether the ground shows it. */
  setField(field: readonly FieldVertex[], chosen: number, visible: boolean, radius: number): void {
    const shown = visible ? field : [];
    const marks = shown.map(({ style, x, z, reach }, i) => ({
      name: spoken(style),
      x,
      z,
      reach,
      colour: this.#colours.of(style),
      chosen: i === chosen,
    }));
    this.#viewer.setField(marks, radius);
    this.#handles.show(shown, chosen);
  }

  setRoute(route: readonly Place[]): void {
    this.#points = dense(route);
    this.#placeRoute();
  }

  /** Whether dragging draws a route instead of turning the camera. */
  set drawing(drawing: boolean) {
    this.#sheet.hidden = !drawing;
  }

  /** Moves to a camera, with a glide. */
  set camera(camera: CrowdCamera) {
    if (camera === this.#camera) return;
    this.#camera = camera;
    this.#viewer.camera(VIEWS[camera]);
  }

  /** Marks a walker, or none, by a ring; the camera may follow it. */
  choose(walker: number | undefined, follow: boolean): void {
    this.#chosen = walker;
    this.#viewer.chosen = walker;
    this.#viewer.follow = follow;
  }

  /** Sets all agents after a tick; `isOther` means that they are not those of the last tick. */
  setTick({ joints, weights, count }: CrowdTick, styles: readonly string[], isOther: boolean): void {
    if (this.#tints.length !== 4 * count) this.#tints = new Uint8Array(4 * count);
    const colours = styles.map((style) => rgbOf(this.#colours.of(style)));
    tintsOf(weights, colours, this.#tints);
    this.#viewer.setTick(joints, this.#tints, isOther);
  }

  /** Draws at a time, milliseconds, interpolated at `share` between the last tick and the current one. */
  draw(now: number, share: number): void {
    const begin = performance.now();
    const drawn = this.#viewer.render(now / 1000, share);
    this.#handles.place();
    this.#placeRoute();
    this.#placeLeader();
    if (drawn) this.#pace.add(performance.now() - begin);
  }

  /**
   * A copy of the picture at a time, milliseconds, as soon as the GPU is ready; `fine` gives the quality of a still
   * picture.
   */
  async copyAt(now: number, share: number, fine: boolean, signal?: AbortSignal): Promise<HTMLCanvasElement> {
    for (;;) {
      signal?.throwIfAborted();
      this.#viewer.invalidate();
      if (this.#viewer.render(now / 1000, share, fine)) return this.#viewer.copy();
      await new Promise((resolve) => setTimeout(resolve, RETRY_MS));
    }
  }

  #placeRoute(): void {
    let path = "";
    let isBroken = true;
    for (const [x, z] of this.#points) {
      const at = this.#viewer.screenPosition(x, 0, z);
      if (at) path += `${isBroken ? "M" : "L"}${at.x.toFixed(1)} ${at.y.toFixed(1)}`;
      isBroken = at === undefined;
    }
    this.#route.setAttribute("d", path);
  }

  /** Draws a line from the selected walker to its card. */
  #placeLeader(): void {
    const from = this.#chosen === undefined ? undefined : this.#viewer.screenPlace(this.#chosen, WAIST);
    const card = this.#card.getBoundingClientRect();
    const stage = this.#stage.getBoundingClientRect();
    const isApart = card.width > 0 && from && from.x < card.left - stage.left - 12;
    const path = isApart
      ? `M${from.x.toFixed(1)} ${from.y.toFixed(1)}L${(card.left - stage.left).toFixed(1)} ${(card.top - stage.top + 20).toFixed(1)}`
      : "";
    this.#leader.setAttribute("d", path);
  }

  #listenToSheet(onRoute: (route: readonly Place[]) => void, signal: AbortSignal): void {
    const placeOf = ({ clientX, clientY }: PointerEvent): Place | undefined => {
      const { left, top } = this.#stage.getBoundingClientRect();
      const at = this.#viewer.groundAt(clientX - left, clientY - top);
      return at && Math.abs(at.x) <= FARTHEST && Math.abs(at.z) <= FARTHEST ? [at.x, at.z] : undefined;
    };
    listenToDrags(
      this.#sheet,
      (press) => {
        const before = this.#points;
        const drawn: Place[] = [];
        let cancelled = false;
        const add = (event: PointerEvent) => {
          const place = placeOf(event);
          if (place) drawn.push(place);
          this.#points = drawn;
        };
        press.preventDefault();
        add(press);
        return {
          move: add,
          cancel: () => {
            cancelled = true;
          },
          end: () => {
            if (cancelled) this.#points = before;
            else onRoute(routeOf(drawn));
          },
        };
      },
      signal,
    );
  }

  #dispose(): void {
    this.#handles.ground = undefined;
    this.#viewer.dispose();
    this.#stage.replaceChildren();
  }
}

/** Largest coordinate of a route along x or z, metres. */
const FARTHEST = 100;

/** Calls back with the position of a press that does not move. */
function listenToClicks(element: HTMLElement, onClick: (x: number, y: number) => void, signal: AbortSignal): void {
  let pressed: { id: number; x: number; y: number } | undefined;
  const options = { signal };
  element.addEventListener(
    "pointerdown",
    ({ pointerId: id, clientX: x, clientY: y, button }) => {
      pressed = button === 0 ? { id, x, y } : undefined;
    },
    options,
  );
  element.addEventListener(
    "pointerup",
    ({ pointerId, clientX, clientY }) => {
      const from = pressed;
      pressed = undefined;
      if (from?.id !== pointerId || Math.hypot(clientX - from.x, clientY - from.y) > CLICK_PX) return;
      const { left, top } = element.getBoundingClientRect();
      onClick(clientX - left, clientY - top);
    },
    options,
  );
}
