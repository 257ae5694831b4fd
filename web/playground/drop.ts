/** Files dropped anywhere on the page or chosen with a button. */

import type { DroppedFile } from "../worker/build/protocol";
import { icon } from "./controls/icons";
import { html } from "./dom";
import { filesOfDialog, filesOfDrop } from "./dropped";
import { strings } from "./strings/strings";

/** Larger files are refused before they are read into memory. */
const MOST_BYTES = 512 * 1024 * 1024;

export interface FileListeners {
  /** Whether files go to the view that is shown, whatever they are. */
  viewTakesAll: () => boolean;
  onMotion: (name: string, bytes: ArrayBuffer) => void;
  onDatabase: (name: string, file: File) => void;
  /** Several files, folders and archives are clips of a database to be. */
  onClips: (files: DroppedFile[]) => void;
  /** One motion that fell on {@link styleTarget}. */
  onStyle: (file: File) => void;
  /** Where a motion falls that is to be a style; undefined where none can. */
  styleTarget: () => Element | undefined;
  onRefused: (sentence: string) => void;
}

/** Sends files where their number and their ending say. */
async function take(files: DroppedFile[], asStyle: boolean, listeners: FileListeners): Promise<void> {
  const [first, ...others] = files;
  if (!first) return;
  const { path, file } = first;
  if (listeners.viewTakesAll() || others.length > 0 || path.includes("/") || /\.zip$/i.test(path)) {
    listeners.onClips(files);
    return;
  }
  if (file.size > MOST_BYTES) {
    const megabytes = Math.round(file.size / (1024 * 1024));
    listeners.onRefused(strings.page.drop.tooLarge(file.name, megabytes, MOST_BYTES / (1024 * 1024)));
    return;
  }
  const isDatabase = /\.strutdb$/i.test(file.name);
  if (!isDatabase && !/\.bvh$/i.test(file.name)) {
    listeners.onRefused(strings.page.drop.unknown(file.name));
    return;
  }
  if (isDatabase) {
    listeners.onDatabase(file.name, file);
    return;
  }
  if (asStyle) {
    listeners.onStyle(file);
    return;
  }
  try {
    listeners.onMotion(file.name, await file.arrayBuffer());
  } catch {
    listeners.onRefused(strings.page.drop.unreadable(file.name));
  }
}

/** The place for styles ends this far from the edges of the panel. */
const INSET = 20;

const carriesFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;

/** Whether the pointer is over the place for styles. */
function isOverStyles(event: DragEvent, listeners: FileListeners): boolean {
  const box = listeners.styleTarget()?.getBoundingClientRect();
  const { clientX: x, clientY: y } = event;
  return box !== undefined && x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
}

/** The overlay that appears while a file is dragged over the page, and what happens when it falls. */
export class DropZone {
  readonly element = html(
    "div",
    { class: "drop-overlay", hidden: true },
    icon("drop", 24),
    html("p", {}, strings.page.drop.invitation),
  );
  /** The place for styles, over the polygon. */
  readonly #target = html("p", { class: "drop-style", hidden: true }, strings.page.drop.style);
  readonly #picker = html("input", {
    type: "file",
    accept: ".bvh,.strutdb",
    hidden: true,
    "aria-label": strings.page.drop.file,
  });

  constructor(listeners: FileListeners) {
    this.element.append(this.#target, this.#picker);
    // Moving between two elements of the page fires leave after enter: only the last leave is one.
    let depth = 0;
    const reset = () => {
      depth = 0;
      this.element.hidden = true;
      this.#target.hidden = true;
    };
    addEventListener("dragenter", (event) => {
      if (!carriesFiles(event)) return;
      event.preventDefault();
      depth += 1;
      this.element.hidden = false;
      this.#showTarget(listeners.styleTarget());
    });
    addEventListener("dragleave", (event) => {
      if (carriesFiles(event)) depth -= 1;
      if (depth <= 0) reset();
    });
    addEventListener("dragover", (event) => {
      if (!carriesFiles(event)) return;
      event.preventDefault();
      this.#target.classList.toggle("over", isOverStyles(event, listeners));
    });
    addEventListener("drop", (event) => {
      if (!carriesFiles(event)) return;
      event.preventDefault();
      const asStyle = isOverStyles(event, listeners);
      reset();
      if (!event.dataTransfer) return;
      filesOfDrop(event.dataTransfer).then(
        (files) => take(files, asStyle, listeners),
        () => listeners.onRefused(strings.page.drop.oneUnreadable),
      );
    });
    this.#picker.addEventListener("change", () => {
      void take(filesOfDialog(this.#picker.files ?? []), false, listeners);
      this.#picker.value = "";
    });
  }

  #showTarget(target: Element | undefined): void {
    const box = target?.getBoundingClientRect();
    this.#target.hidden = !box || box.width === 0;
    if (!box) return;
    const { top, height } = box;
    const [left, width] = [box.left + INSET, box.width - 2 * INSET];
    for (const [name, value] of Object.entries({ left, top, width, height }))
      this.#target.style.setProperty(name, `${value}px`);
  }

  /** Opens the browser's file dialog. */
  choose(): void {
    this.#picker.click();
  }
}
