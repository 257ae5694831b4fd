/** Files dropped anywhere on the page or chosen with a button. */
import { icon } from "./controls/icons";
import { html } from "./dom";

/** Larger files are refused before they are read into memory. */
const MOST_BYTES = 512 * 1024 * 1024;

export interface FileListeners {
  onMotion: (name: string, bytes: ArrayBuffer) => void;
  onDatabase: (name: string, bytes: ArrayBuffer) => void;
  onRefused: (sentence: string) => void;
}

/** Reads files and sends them where their ending says. */
async function take(files: readonly File[], listeners: FileListeners): Promise<void> {
  const [file, ...others] = files;
  if (!file) return;
  if (others.length > 0) {
    listeners.onRefused(`${files.length} files were dropped; one at a time works. Drop the one that you want.`);
    return;
  }
  if (file.size > MOST_BYTES) {
    const megabytes = Math.round(file.size / (1024 * 1024));
    listeners.onRefused(`“${file.name}” has ${megabytes} MB; files up to 512 MB work. Export a shorter part.`);
    return;
  }
  const isDatabase = /\.strutdb$/i.test(file.name);
  if (!isDatabase && !/\.bvh$/i.test(file.name)) {
    listeners.onRefused(`“${file.name}” is neither a .bvh motion nor a .strutdb database. Drop one of those.`);
    return;
  }
  try {
    const bytes = await file.arrayBuffer();
    if (isDatabase) listeners.onDatabase(file.name, bytes);
    else listeners.onMotion(file.name, bytes);
  } catch {
    listeners.onRefused(`“${file.name}” could not be read. Drop it again.`);
  }
}

const carriesFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;

/** The overlay that appears while a file is dragged over the page, and what happens when it falls. */
export class DropZone {
  readonly element = html(
    "div",
    { class: "drop-overlay", hidden: true },
    icon("drop", 24),
    html("p", {}, "Drop a BVH here. Any humanoid skeleton works."),
  );
  readonly #picker = html("input", {
    type: "file",
    accept: ".bvh,.strutdb",
    hidden: true,
    "aria-label": "Motion file",
  });

  constructor(listeners: FileListeners) {
    this.element.append(this.#picker);
    // Moving between two elements of the page fires leave after enter: only the last leave is one.
    let depth = 0;
    const reset = () => {
      depth = 0;
      this.element.hidden = true;
    };
    addEventListener("dragenter", (event) => {
      if (!carriesFiles(event)) return;
      event.preventDefault();
      depth += 1;
      this.element.hidden = false;
    });
    addEventListener("dragleave", (event) => {
      if (carriesFiles(event)) depth -= 1;
      if (depth <= 0) reset();
    });
    addEventListener("dragover", (event) => {
      if (carriesFiles(event)) event.preventDefault();
    });
    addEventListener("drop", (event) => {
      if (!carriesFiles(event)) return;
      event.preventDefault();
      reset();
      void take([...(event.dataTransfer?.files ?? [])], listeners);
    });
    this.#picker.addEventListener("change", () => {
      void take([...(this.#picker.files ?? [])], listeners);
      this.#picker.value = "";
    });
  }

  /** Opens the browser's file dialog. */
  choose(): void {
    this.#picker.click();
  }
}
