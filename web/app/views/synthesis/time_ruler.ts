/** The ruler of a timeline, seconds, with an area above it that seeks when pressed. */
import { svg } from "../../../ui/dom";
import { type RulerMark, ruler, type Scale } from "../../../ui/scale";

interface TimeRulerOptions {
  time: Scale;
  /** Vertical position of the line, units. */
  y: number;
  /** Minimum distance of two labels, units. */
  labelPx: number;
  /** Label of time 0, with the unit. */
  zero: string;
}

/** The ruler. A press on its first child, of class `timeline-seek`, seeks. */
export function timeRuler({ time, y, labelPx, zero }: TimeRulerOptions): SVGGElement {
  const { from, to } = time;
  const line = (x: number, height: number) => svg("line", { x1: x, x2: x, y1: y - height, y2: y });
  const labelOf = ({ value, pixel, label }: RulerMark) =>
    value === 0
      ? svg("text", { x: from, y: y - 11, "text-anchor": "start" }, zero)
      : svg("text", { x: pixel.toFixed(1), y: y - 11, "text-anchor": "middle" }, label ?? "");
  return svg(
    "g",
    { class: "timeline-ruler", "aria-hidden": "true" },
    svg("rect", { class: "timeline-seek", x: from, y: 0, width: to - from, height: y + 6 }),
    svg("line", { x1: from, x2: to, y1: y, y2: y }),
    ...ruler(time, labelPx).flatMap((mark) =>
      mark.label === undefined ? [line(mark.pixel, 4)] : [line(mark.pixel, 7), labelOf(mark)],
    ),
  );
}
