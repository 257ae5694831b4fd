/** The table of the views. */

import type { ViewName } from "../../link/page";
import type { AppState } from "../state/state";
import { strings } from "../strings/strings";
import type { View, ViewHost } from "../view";
import { createView as createPlay } from "../views/play/play_view";

interface ViewModule {
  createView(host: ViewHost): View;
  /** Starts long preparations, such as loading an engine, before the view is made. Called when its tab is hovered. */
  prepare?(state: Readonly<AppState>): void;
}

export interface ViewEntry {
  name: ViewName;
  title: string;
  /** Loads the code of the view when it is first shown; the code of Play is part of the page. */
  load: () => Promise<ViewModule>;
  /** Which dropped files are passed to the view; the page handles the others. */
  takes?: "motions" | "all";
  /** Whether it works in a browser without 3-D. */
  flat?: true;
}

const titles = strings.page.views;

/** All views in the order of the tabs. A new view is a name in `state/page.ts` and a row here. */
export const VIEWS: readonly ViewEntry[] = [
  { name: "play", title: titles.play, load: () => Promise.resolve({ createView: createPlay }) },
  { name: "learn", title: titles.learn, load: () => import("../views/learn/learn_view"), flat: true },
  { name: "compare", title: titles.compare, load: () => import("../views/compare/compare_view") },
  { name: "walk", title: titles.walk, load: () => import("../views/walk/walk_view") },
  {
    name: "key-style",
    title: titles["key-style"],
    load: () => import("../views/key_style/key_style_view"),
    takes: "motions",
  },
  { name: "crowd", title: titles.crowd, load: () => import("../views/crowd/crowd_view") },
  { name: "data", title: titles.data, load: () => import("../views/data/data_view"), takes: "all" },
];

/** The entry of a view. */
export function viewEntry(name: ViewName): ViewEntry {
  return VIEWS.find((view) => view.name === name)!;
}
