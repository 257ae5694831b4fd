/**
 * The style polygon: every style is a vertex, a few are selected, and the handle's position between those sets the
 * weight of each. Pointer, touch and keyboard; the pure parts are in `geometry.ts` and `selection.ts`.
 */

import { formatNumber, html, setAttributes, svg } from "../dom";
import { type Drag, type GestureListeners, listenToDrags } from "../drag";
import { prefersReducedMotion, textZoom } from "../media";
import { strings } from "../strings";
import { hatching, isolines, label, path, weightBar } from "./drawing";
import { circleVertices, isInside, nearestInside, type Point, pointOf, weightsAt } from "./geometry";
import { coveringLabels, placeBeyond, placeLabels } from "./labels";
import { allOf, drop, fromPolygon, type Selection, select, TRIANGLE, weightOf, withWeight } from "./selection";
import { Trail } from "./trail";
import { WeightFields } from "./weight_fields";

/** Radius, and space for labels above and below the centre, units: pixels at the normal text size. */
interface PolygonSize {
  radius: number;
  above: number;
  below: number;
  /** Radius within which a vertex or the handle is hit. */
  reach: number;
  /** Whether vertices have bars and numbers of their weights; otherwise only names, above and below them. */
  bars: boolean;
}
/** In a panel of its own. */
const FULL: PolygonSize = { radius: 92, above: 144, below: 120, reach: 16, bars: true };
/** Over a picture, with a triangle at most. */
export const COMPACT: PolygonSize = { radius: 46, above: 76, below: 56, reach: 22, bars: false };
/** Minimum distance of labels from the edge of the panel, and largest distance from the centre. */
const PADDING = 20;
const MAX_EDGE = 172;
/** Width while the panel is not displayed. */
const MIN_WIDTH = 344;
/** Duration of a jump to a vertex, milliseconds. */
const GLIDE_MS = 240;
/** Steps of the arrow keys, as shares of the radius. */
const KEY_STEP = 0.05;
const FINE_KEY_STEP = 0.01;
/** With Shift the handle may leave the polygon up to this distance, in radii. */
const MAX_BEYOND = 1.35;

const ARROWS: Readonly<Record<string, Point>> = {
  ArrowLeft: { x: -1, y: 0 },
  ArrowRight: { x: 1, y: 0 },
  ArrowUp: { x: 0, y: -1 },
  ArrowDown: { x: 0, y: 1 },
};

interface PolygonListeners extends GestureListeners {
  /** Called with a new selection; `gesture` names the drag or run of key presses that it belongs to. */
  onChange: (selection: Selection, gesture?: string) => void;
}

/** Contents of the polygon. */
interface PolygonModel {
  /** Styles clockwise from the top. */
  vertices: readonly string[];
  selection: Selection;
  /** Whether the whole polygon is mixed. */
  whole: boolean;
  /** Whether the weights extrapolate beyond the data. */
  beyond: boolean;
}

export class Polygon {
  readonly element: HTMLElement;
  readonly #listeners: PolygonListeners;
  readonly #size: PolygonSize;
  readonly #root: SVGSVGElement;
  readonly #layers = {
    hatch: svg("path", { class: "polygon-hatch", "fill-rule": "evenodd" }),
    outline: svg("path", { class: "polygon-outline" }),
    area: svg("path", { class: "polygon-area" }),
    isolines: svg("path", { class: "polygon-isolines" }),
    leaders: svg("g", { class: "polygon-leaders" }),
    bars: svg("g"),
    vertices: svg("g"),
  };
  readonly #trail = new Trail();
  readonly #observer = new ResizeObserver(() => this.#resize());
  readonly #listening = new AbortController();
  readonly #handle: SVGGElement;
  readonly #weights: WeightFields;
  #vertexElements: SVGGElement[] = [];
  #model: PolygonModel = { vertices: [], selection: [], whole: false, beyond: false };
  #positions: Point[] = [];
  /** Displayed position of the handle: it differs from the model only during a glide. */
  #drawn: Point = { x: 0, y: 0 };
  #glide = 0;
  /** Whether the current change comes from the handle itself, which follows without easing. */
  #moving = false;
  /** Pixels per unit of the drawing: more than one if the user's text is larger. */
  #unit = 1;
  /** Width of the drawing, units. Measured only when it changes: elsewhere measuring would cause a layout. */
  #width = MIN_WIDTH;

  constructor(listeners: PolygonListeners, size: PolygonSize = FULL) {
    this.#listeners = listeners;
    this.#size = size;
    this.#handle = svg(
      "g",
      {
        class: "polygon-handle",
        part: "handle",
        role: "slider",
        tabindex: 0,
        "aria-label": strings.polygon.handle,
        "aria-valuemin": 0,
        "aria-valuemax": 1,
      },
      svg("circle", { class: "handle-target", r: size.reach }),
      svg("circle", { class: "handle-halo", r: 15 }),
      svg("circle", { class: "handle-focus", r: 13 }),
      svg("circle", { class: "handle-body", r: 8 }),
    );
    const { hatch, outline, area, isolines: lines, leaders, bars, vertices } = this.#layers;
    this.#root = svg(
      "svg",
      { class: "polygon", role: "group", "aria-label": strings.polygon.styles },
      hatching("polygon-hatching"),
      hatch,
      outline,
      area,
      lines,
      leaders,
      this.#trail.element,
      bars,
      vertices,
      this.#handle,
    );
    this.#weights = new WeightFields((name, weight) => {
      this.#listeners.onChange(withWeight(this.#model.selection, name, weight));
      this.#listeners.onSettle();
    });
    this.element = html("div", { class: "polygon-box" }, this.#root, this.#weights.element);
    listenToDrags(this.#root, (event) => this.#beginDrag(event), this.#listening.signal);
    this.#handle.addEventListener("keydown", (event) => {
      this.#root.classList.remove("by-pointer");
      this.#onHandleKey(event);
    });
    this.#handle.addEventListener("blur", () => this.#root.classList.remove("by-pointer"));
    this.#handle.addEventListener("keyup", (event) => {
      if (event.key in ARROWS) this.#listeners.onSettle();
    });
    this.#resize();
    this.#observer.observe(this.element);
  }

  /** Shows a model. `glide` animates the handle to a distant position. */
  show(model: PolygonModel, glide = false): void {
    const relaid = model.vertices.join("\n") !== this.#model.vertices.join("\n");
    this.#model = model;
    this.#weights.show(model.selection.filter(({ name }) => model.vertices.includes(name)));
    if (relaid) this.#layOut();
    cancelAnimationFrame(this.#glide);
    if (glide && !this.#moving && !prefersReducedMotion()) this.#glideFrom(this.#drawn);
    else this.#draw(this.#modelPoint());
  }

  /** Selects one style alone, like a double click on its vertex. */
  takeAllOf(name: string): void {
    if (!this.#model.vertices.includes(name)) return;
    const { whole, selection } = this.#model;
    this.#listeners.onChange(whole ? [{ name, weight: 1 }] : allOf(selection, name));
  }

  /** Ends a drag, a glide and the trail, and stops following the panel's size. */
  dispose(): void {
    this.#listening.abort();
    this.#observer.disconnect();
    cancelAnimationFrame(this.#glide);
    this.#trail.dispose();
  }

  /** Moves the keyboard focus to the handle. */
  focus(): void {
    this.#handle.focus();
  }

  /** The names and positions of the corners between which the handle moves. */
  #corners(): { names: string[]; points: Point[] } {
    const { vertices, selection, whole } = this.#model;
    const names = whole ? [...vertices] : selection.map((s) => s.name).filter((name) => vertices.includes(name));
    return { names, points: names.map((name) => this.#positions[vertices.indexOf(name)]!) };
  }

  #modelPoint(): Point {
    const { names, points } = this.#corners();
    const weights = names.map((name) => weightOf(this.#model.selection, name));
    return pointOf(weights, points);
  }

  /** Moves the handle to a point, or as near to it as allowed. */
  #moveTo(p: Point, beyond: boolean): void {
    const { names, points } = this.#corners();
    if (points.length === 0) return;
    const free = beyond && points.length === TRIANGLE && !this.#model.whole;
    const reach = Math.min(1, (MAX_BEYOND * this.#size.radius) / (Math.hypot(p.x, p.y) || 1));
    const at = free ? { x: p.x * reach, y: p.y * reach } : nearestInside(p, points);
    // The addition converts −0 to 0.
    const weights = weightsAt(at, points).map((w) => Math.round(w * 1000) / 1000 + 0);
    const selection = this.#model.whole
      ? fromPolygon(names, weights)
      : names.map((name, i) => ({ name, weight: weights[i]! }));
    this.#moving = true;
    this.#listeners.onChange(selection, "polygon");
    this.#moving = false;
  }

  #layOut(): void {
    this.#positions = circleVertices(this.#model.vertices.length, this.#size.radius);
    this.#layers.outline.setAttribute("d", path(this.#positions));
    this.#vertexElements = this.#model.vertices.map((name, i) => {
      const { x, y } = this.#positions[i]!;
      const vertex = svg(
        "g",
        { class: "vertex", part: "vertex", role: "button", tabindex: 0, "data-style": name },
        svg("circle", { class: "vertex-target", cx: x, cy: y, r: this.#size.reach }),
        svg("circle", { class: "vertex-focus", cx: x, cy: y, r: 10 }),
        svg("circle", { class: "vertex-dot", cx: x, cy: y }),
      );
      vertex.addEventListener("dblclick", () => this.takeAllOf(name));
      vertex.addEventListener("keydown", (event) => this.#onVertexKey(event, name));
      return vertex;
    });
    this.#layers.vertices.replaceChildren(...this.#vertexElements);
  }

  /** A unit does not depend on the width of the panel, so that strokes and text keep their size. */
  #resize(): void {
    this.#unit = textZoom();
    this.#width = (this.element.clientWidth || MIN_WIDTH) / this.#unit;
    const { above, below } = this.#size;
    const [width, height] = [this.#width, above + below];
    setAttributes(this.#root, {
      viewBox: `${-width / 2} ${-above} ${width} ${height}`,
      width: width * this.#unit,
      height: height * this.#unit,
    });
    this.#draw(this.#drawn);
  }

  #glideFrom(from: Point): void {
    const to = this.#modelPoint();
    const start = performance.now();
    const tick = (now: number) => {
      const t = Math.min(1, Math.max(0, (now - start) / GLIDE_MS));
      const eased = 1 - (1 - t) ** 3;
      this.#draw({ x: from.x + (to.x - from.x) * eased, y: from.y + (to.y - from.y) * eased });
      if (t < 1) this.#glide = requestAnimationFrame(tick);
    };
    this.#glide = requestAnimationFrame(tick);
  }

  #draw(handle: Point): void {
    this.#drawn = handle;
    const { vertices, selection, whole, beyond } = this.#model;
    const { names, points } = this.#corners();
    const outside = points.length > 2 && !isInside(handle, points);
    const layers = this.#layers;
    const { radius, above, below, bars } = this.#size;
    const edge = Math.min(MAX_EDGE, this.#width / 2 - PADDING);

    layers.area.setAttribute("d", path(points));
    layers.isolines.setAttribute("d", whole ? "" : isolines(points));
    layers.hatch.setAttribute("d", outside ? path(circleVertices(48, radius * MAX_BEYOND)) + path(points) : "");
    layers.leaders.replaceChildren(
      ...names.map((name, i) => {
        const opacity = 0.12 + 0.5 * Math.min(1, Math.abs(weightOf(selection, name)));
        const to = points[i]!;
        return svg("line", { x1: handle.x, y1: handle.y, x2: to.x, y2: to.y, "stroke-opacity": opacity.toFixed(3) });
      }),
    );
    layers.bars.replaceChildren();
    const labelled = vertices.map((name, i) => ({
      name,
      weight: selection.find((s) => s.name === name)?.weight,
      position: this.#positions[i]!,
    }));
    const heaviest = selection.reduce((a, s) => Math.max(a, s.weight), 0);
    const room = { left: -edge, right: edge, top: -above, bottom: below };
    const places = bars ? placeLabels(labelled, room) : labelled.map(({ position }) => placeBeyond(position));
    const covering = bars ? coveringLabels(labelled, places) : [];
    for (const [i, vertex] of this.#vertexElements.entries()) {
      const { name, weight, position } = labelled[i]!;
      vertex.classList.toggle("covering", covering[i] ?? false);
      if (bars && weight !== undefined) layers.bars.append(weightBar(position, weight));
      vertex.classList.toggle("selected", weight !== undefined);
      vertex.classList.toggle("heaviest", weight !== undefined && weight === heaviest);
      vertex.querySelector(".vertex-dot")?.setAttribute("r", weight === undefined ? "3" : "5");
      vertex.querySelector(".vertex-label")?.remove();
      vertex.append(label(bars ? labelled[i]! : { name, weight: undefined, position }, places[i]!));
      setAttributes(vertex, {
        "aria-pressed": weight === undefined ? "false" : "true",
        "aria-label": weight === undefined ? name : `${name} ${formatNumber(weight, 2)}`,
      });
    }
    this.#handle.setAttribute("transform", `translate(${handle.x.toFixed(2)} ${handle.y.toFixed(2)})`);
    this.#handle.classList.toggle("beyond", beyond || outside);
    setAttributes(this.#handle, {
      "aria-valuenow": Math.min(1, heaviest),
      "aria-valuetext": selection.map((s) => `${s.name} ${formatNumber(s.weight, 2)}`).join(", "),
    });
  }

  #toPlane(event: PointerEvent): Point {
    const box = this.#root.getBoundingClientRect();
    const unit = this.#unit;
    return {
      x: (event.clientX - box.left - box.width / 2) / unit,
      y: (event.clientY - box.top) / unit - this.#size.above,
    };
  }

  /** A press on the handle or within the triangle drags the handle; a press on an idle vertex selects it. */
  #beginDrag(event: PointerEvent): Drag | undefined {
    const p = this.#toPlane(event);
    const onHandle = this.#handle.contains(event.target as Node);
    const vertex = (event.target as Element).closest<SVGGElement>(".vertex");
    const name = vertex?.dataset.style;
    const { selection, whole } = this.#model;
    if (!onHandle && name && !whole && !this.#corners().names.includes(name)) {
      this.#listeners.onChange(select(selection, name));
      return undefined;
    }
    if (!onHandle && name) return undefined;
    const { points } = this.#corners();
    if (!onHandle && points.length > 2 && !isInside(p, points)) return undefined;
    event.preventDefault();
    const { onSettle, onCancel } = this.#listeners;
    onSettle();
    // The focus ring is hidden while the pointer drags; it is for keyboard users.
    this.#handle.focus({ preventScroll: true });
    this.#root.classList.add("dragging", "by-pointer");
    const at = this.#modelPoint();
    const offset = onHandle ? { x: at.x - p.x, y: at.y - p.y } : { x: 0, y: 0 };
    this.#trail.add(onHandle ? at : p);
    if (!onHandle) this.#moveTo(p, event.shiftKey);
    return {
      move: (moved) => {
        const { x, y } = this.#toPlane(moved);
        this.#moveTo({ x: x + offset.x, y: y + offset.y }, moved.shiftKey);
        this.#trail.add(this.#modelPoint());
      },
      cancel: onCancel,
      end: () => {
        this.#root.classList.remove("dragging");
        onSettle();
      },
    };
  }

  /** Moves the handle like an arrow key. */
  press(key: string, share = KEY_STEP): void {
    const arrow = ARROWS[key];
    if (!arrow) return;
    const step = share * this.#size.radius;
    const at = this.#modelPoint();
    this.#moveTo({ x: at.x + arrow.x * step, y: at.y + arrow.y * step }, false);
  }

  #onHandleKey(event: KeyboardEvent): void {
    if (!ARROWS[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    this.press(event.key, event.shiftKey ? FINE_KEY_STEP : KEY_STEP);
  }

  #onVertexKey(event: KeyboardEvent, name: string): void {
    const { selection, whole } = this.#model;
    if (event.key === "Enter" || event.key === " ") {
      if (whole) this.takeAllOf(name);
      else this.#listeners.onChange(select(selection, name));
    } else if (event.key === "Delete" || event.key === "Backspace") {
      this.#listeners.onChange(drop(selection, name));
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
