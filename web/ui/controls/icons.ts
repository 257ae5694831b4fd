/** The icons: 16 px grid, 1.4 px strokes, round caps and joins, no fills except play, pause and the mark's point. */
import { svg } from "../dom";

/** Stroked paths of each icon; those in {@link FILLED} are filled. */
const PATHS = {
  play: ["M5 3.2v9.6a.6.6 0 0 0 .92.5l7.3-4.8a.6.6 0 0 0 0-1L5.92 2.7A.6.6 0 0 0 5 3.2z"],
  pause: ["M4.6 3h1.9v10H4.6zM9.5 3h1.9v10H9.5z"],
  previous: ["M4 3.5v9", "M12 3.8v8.4L6.6 8z"],
  next: ["M12 3.5v9", "M4 3.8v8.4L9.4 8z"],
  loop: [
    "M3 7.2V6.4A2.4 2.4 0 0 1 5.4 4h7",
    "M10.4 2l2 2-2 2",
    "M13 8.8v.8A2.4 2.4 0 0 1 10.6 12h-7",
    "M5.6 14l-2-2 2-2",
  ],
  share: ["M8 9.8V2.4", "M5.2 5L8 2.2 10.8 5", "M2.8 8.6v3.6a1.2 1.2 0 0 0 1.2 1.2h8a1.2 1.2 0 0 0 1.2-1.2V8.6"],
  export: ["M8 2.4v7.4", "M5.2 7.2L8 10l2.8-2.8", "M2.8 9.6v2.6a1.2 1.2 0 0 0 1.2 1.2h8a1.2 1.2 0 0 0 1.2-1.2V9.6"],
  drop: ["M8 9.8V2.4", "M5.2 5L8 2.2 10.8 5", "M2.8 9.6v2.6a1.2 1.2 0 0 0 1.2 1.2h8a1.2 1.2 0 0 0 1.2-1.2V9.6"],
  sun: [
    "M8 5.4a2.6 2.6 0 1 0 0 5.2 2.6 2.6 0 0 0 0-5.2z",
    "M8 1.6v1.2M8 13.2v1.2M1.6 8h1.2M13.2 8h1.2M3.5 3.5l.8.8M11.7 11.7l.8.8M3.5 12.5l.8-.8M11.7 4.3l.8-.8",
  ],
  moon: ["M13 9.6A5.4 5.4 0 0 1 6.4 3 5.4 5.4 0 1 0 13 9.6z"],
  help: [
    "M8 1.9a6.1 6.1 0 1 0 0 12.2A6.1 6.1 0 0 0 8 1.9z",
    "M6.3 6.4a1.75 1.75 0 1 1 2.6 1.5c-.6.34-.9.7-.9 1.3",
    "M8 11.3v.05",
  ],
  orbit: [
    "M8 3v10",
    "M5.9 5.4C3.4 5.8 1.8 6.8 1.8 8s1.6 2.2 4.1 2.6",
    "M10.1 5.4c2.5.4 4.1 1.4 4.1 2.6s-1.6 2.2-4.1 2.6",
  ],
  follow: [
    "M2.4 5V3.4a1 1 0 0 1 1-1H5M11 2.4h1.6a1 1 0 0 1 1 1V5M13.6 11v1.6a1 1 0 0 1-1 1H11M5 13.6H3.4a1 1 0 0 1-1-1V11",
    "M8 5.9a2.1 2.1 0 1 0 0 4.2 2.1 2.1 0 0 0 0-4.2z",
  ],
  ghost: ["M8 1.8a1.5 1.5 0 1 0 0 3 1.5 1.5 0 0 0 0-3z", "M8 5v4.4M4.8 6.6L8 6l3.2.6", "M8 9.4l-2 4.8M8 9.4l2 4.8"],
  trail: ["M2 11.6c2.2-7 4.2-7 6 0s3.8 7 6 0", "M11.4 4.4a1.6 1.6 0 1 0 0 .1z"],
  undo: ["M5.4 3L2.6 5.8l2.8 2.8", "M2.8 5.8h6.4a3.6 3.6 0 0 1 0 7.2H5.4"],
  redo: ["M10.6 3l2.8 2.8-2.8 2.8", "M13.2 5.8H6.8a3.6 3.6 0 0 0 0 7.2h3.8"],
  reset: ["M3.6 5.2A5 5 0 1 1 3 8.6", "M3.2 2.4v3.2h3.2"],
  menu: ["M2.6 5.4h10.8M2.6 10.6h10.8"],
  close: ["M4 4l8 8M12 4l-8 8"],
  remove: ["M3 4.4h10", "M6.2 4.2V2.8h3.6v1.4", "M4.4 4.6l.6 8.6h6l.6-8.6", "M6.8 7v3.8M9.2 7v3.8"],
  save: ["M3 3h8l2 2v8H3z", "M5.4 3.2v3h4.4v-3", "M5.4 12.8V9.2h5.2v3.6"],
  folder: ["M2 12.4V4a.8.8 0 0 1 .8-.8h3.4l1.4 1.6h5.6a.8.8 0 0 1 .8.8v6.8a.8.8 0 0 1-.8.8H2.8a.8.8 0 0 1-.8-.8z"],
  random: [
    "M2 4.6h2.4c3.4 0 3.8 6.8 7.2 6.8h2",
    "M2 11.4h2.4c1.2 0 2-.8 2.6-2M9 6.6c.6-1.2 1.4-2 2.6-2h2",
    "M11.8 2.8l1.8 1.8-1.8 1.8M11.8 9.6l1.8 1.8-1.8 1.8",
  ],
  field: [
    "M6.6 8a1.4 1.4 0 1 0 2.8 0 1.4 1.4 0 1 0-2.8 0z",
    "M2 8c0-2.4 2.7-4.2 6-4.2s6 1.8 6 4.2-2.7 4.2-6 4.2S2 10.4 2 8z",
  ],
  picture: ["M2.6 3.4h10.8v9.2H2.6z", "M2.8 11l3-3 2.4 2.2 2-1.6 3 2.4"],
  film: ["M2.6 3.4h10.8v9.2H2.6z", "M5.4 3.6v8.8M10.6 3.6v8.8M2.8 8h2.4M10.8 8h2.4"],
  key: ["M8 2.6L13.4 8 8 13.4 2.6 8z"],
  add: ["M8 3.2v9.6M3.2 8h9.6"],
  less: ["M3.2 8h9.6"],
  embed: ["M5.4 4.6L2 8l3.4 3.4M10.6 4.6L14 8l-3.4 3.4"],
  fullscreen: ["M2.6 6V2.6H6M10 2.6h3.4V6M13.4 10v3.4H10M6 13.4H2.6V10"],
  path: ["M2.8 12.8c4.6 0 1.6-5 5.4-5s1-4.6 4.6-4.6", "M11 1.4l2.2 1.8L11.4 5.2"],
  record: ["M8 4a4 4 0 1 0 0 8 4 4 0 1 0 0-8z"],
  chevron: ["M4.5 6.4L8 9.9l3.5-3.5"],
} as const;

/** Name of an icon. */
export type IconName = keyof typeof PATHS;

const FILLED: readonly IconName[] = ["play", "pause", "record"];

/** Sizes in pixels apply at the normal text size. */
const inRem = (px: number): string => `${px / 16}rem`;

/** An icon in the colour of the text around it; hidden from screen readers, which get the button's name. */
export function icon(name: IconName, size = 16): SVGSVGElement {
  const filled = FILLED.includes(name);
  return svg(
    "svg",
    {
      class: "icon",
      viewBox: "0 0 16 16",
      width: inRem(size),
      height: inRem(size),
      fill: filled ? "currentColor" : "none",
      stroke: filled ? "none" : "currentColor",
      "stroke-width": 1.4,
      "stroke-linecap": "round",
      "stroke-linejoin": "round",
      "aria-hidden": "true",
    },
    ...PATHS[name].map((d) => svg("path", { d })),
  );
}

/** The logo: the polygon control itself, a triangle with a point at weights 0.32 top, 0.27 right, 0.41 left. */
export function mark(size = 18): SVGSVGElement {
  const [top, right, left] = [
    [9, 1.8],
    [16.4, 15.6],
    [1.6, 15.6],
  ] as const;
  const at = (axis: 0 | 1) => 0.32 * top[axis] + 0.27 * right[axis] + 0.41 * left[axis];
  return svg(
    "svg",
    {
      class: "mark",
      viewBox: "0 0 18 18",
      width: inRem(size),
      height: inRem(size),
      fill: "none",
      "aria-hidden": "true",
    },
    svg("path", {
      d: `M${top.join(" ")}L${right.join(" ")}L${left.join(" ")}z`,
      stroke: "currentColor",
      "stroke-width": 1.6,
      "stroke-linejoin": "round",
    }),
    svg("circle", { cx: at(0), cy: at(1), r: 2.9, class: "mark-point" }),
  );
}
