/** Files dropped anywhere on the page or chosen with a button. */

import type { DroppedFile } from "../../client/build/protocol";
import { icon } from "../../ui/controls/icons";
import { html } from "../../ui/dom";
import { strings } from "../strings/strings";
import { filesOfDialog, filesOfDrop } from "../ui/dropped_files";

/** Larger files are refused before they are read into memory. */
const MAX_BYTES = 512 * 1024 * 1024;
/** The limit for databases, whose memory use the engine knows. */
const MAX_DATABASE_BYTES = 4096 * 1024 * 1024;

interface FileListeners {
  /** Which files are passed to the current view, through {@link FileListeners.onClips}. */
  takes: () => "motions" | "all" | undefined;
  onMotion: (file: File) => void;
  onDatabase: (name: string, file: File) => void;
  onProject: (file: File) => void;
  /**
   * Called with a file that may contain a rigged character, motions, or both, and with the files dropped together with
   * it, which it may name.
   */
  onModel: (file: File, beside: readonly DroppedFile[]) => void;
  /** Called with several files, folders and archives: clips to build a database from. */
  onClips: (files: DroppedFile[]) => void;
  /** Called with a single motion dropped on {@link styleTarget}. */
  onStyle: (file: File) => void;
  /** Element on which a dropped motion becomes a style; `undefined` if there is none. */
  styleTarget: () => Element | undefined;
  onRefused: (sentence: string) => void;
}

/** Dispatches dropped files by their number, their type and the current view. */
function take(files: DroppedFile[], asStyle: boolean, listeners: FileListeners): void {
  const [first, ...others] = files;
  if (!first) return;
  const { path, file } = first;
  if (files.some((dropped) => /\.strut$/i.test(dropped.file.name))) {
    // A project names what is open, whatever view is shown.
    if (others.length > 0) listeners.onRefused(strings.page.drop.projectAlone);
    else listeners.onProject(file);
    return;
  }
  const split = files.filter((each) => /\.gltf$/i.test(each.path));
  if (split.length === 1 && listeners.takes() !== "all") {
    listeners.onModel(split[0]!.file, files);
    return;
  }
  if (listeners.takes() === "all" || others.length > 0 || path.includes("/") || /\.zip$/i.test(path)) {
    listeners.onClips(files);
    return;
  }
  const isDatabase = /\.strutdb$/i.test(file.name);
  const most = isDatabase ? MAX_DATABASE_BYTES : MAX_BYTES;
  if (file.size > most) {
    const megabytes = Math.round(file.size / (1024 * 1024));
    listeners.onRefused(strings.page.drop.tooLarge(file.name, megabytes, most / (1024 * 1024)));
    return;
  }
  if (/\.(glb|vrm|vrma|fbx)$/i.test(file.name)) {
    listeners.onModel(file, []);
    return;
  }
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
  if (listeners.takes() === "motions") {
    listeners.onClips(files);
    return;
  }
  listeners.onMotion(file);
}

/** Inset of the drop target for styles from the edges of the polygon, pixels. */
const INSET = 20;

const carriesFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;

/** Whether the pointer is over the drop target for styles. */
function isOverStyles(event: DragEvent, listeners: FileListeners): boolean {
  const box = listeners.styleTarget()?.getBoundingClientRect();
  const { clientX: x, clientY: y } = event;
  return box !== undefined && x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
}

/** The overlay shown while a file is dragged over the page. It handles the drop. */
export class DropZone {
  readonly element = html(
    "div",
    { class: "drop-overlay", hidden: true },
    icon("drop", 24),
    html("p", {}, strings.page.drop.invitation),
  );
  /** The drop target for styles, over the polygon. */
  readonly #target = html("p", { class: "drop-style", hidden: true }, strings.page.drop.style);
  readonly #picker = html("input", {
    type: "file",
    accept: ".bvh,.zip,.strut,.strutdb,.glb,.gltf,.bin,.png,.jpg,.vrm,.vrma,.fbx",
    multiple: true,
    hidden: true,
    "aria-label": strings.page.drop.file,
  });

  readonly #stylePicker = html("input", {
    type: "file",
    accept: ".bvh",
    hidden: true,
    "aria-label": strings.page.drop.styleFile,
  });

  readonly #listeners: FileListeners;
  readonly #ready: Promise<void>;

  /**
   * @param ready settles when the page has opened its first input. Dropped files wait for it, as opening that input
   * would cancel them
   */
  constructor(listeners: FileListeners, ready: Promise<void>, signal: AbortSignal) {
    [this.#listeners, this.#ready] = [listeners, ready];
    this.element.append(this.#target, this.#picker, this.#stylePicker);
    // When the pointer moves between two elements, dragenter fires before dragleave: only the outermost dragleave
    // leaves the page.
    let depth = 0;
    const reset = () => {
      depth = 0;
      this.element.hidden = true;
      this.#target.hidden = true;
    };
    addEventListener(
      "dragenter",
      (event) => {
        if (!carriesFiles(event)) return;
        event.preventDefault();
        depth += 1;
        this.element.hidden = false;
        this.#showTarget(listeners.styleTarget());
      },
      { signal },
    );
    addEventListener(
      "dragleave",
      (event) => {
        if (carriesFiles(event)) depth -= 1;
        if (depth <= 0) reset();
      },
      { signal },
    );
    addEventListener(
      "dragover",
      (event) => {
        if (!carriesFiles(event)) return;
        event.preventDefault();
        this.#target.classList.toggle("over", isOverStyles(event, listeners));
      },
      { signal },
    );
    addEventListener(
      "drop",
      (event) => {
        if (!carriesFiles(event)) return;
        event.preventDefault();
        const asStyle = isOverStyles(event, listeners);
        reset();
        if (!event.dataTransfer) return;
        filesOfDrop(event.dataTransfer).then(
          (files) => void this.#take(files, asStyle),
          () => listeners.onRefused(strings.page.drop.oneUnreadable),
        );
      },
      { signal },
    );
    for (const picker of [this.#picker, this.#stylePicker])
      picker.addEventListener("change", () => {
        void this.#take(filesOfDialog(picker.files ?? []), picker === this.#stylePicker);
        picker.value = "";
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

  /** Handles files from another source as if they had been dropped. */
  take(files: Iterable<File>): void {
    void this.#take(filesOfDialog(files), false);
  }

  async #take(files: DroppedFile[], asStyle: boolean): Promise<void> {
    await this.#ready;
    take(files, asStyle, this.#listeners);
  }

  /** Opens the browser's file dialog. */
  choose(): void {
    this.#picker.click();
  }

  /** Opens the browser's file dialog for a clip that becomes a style. */
  chooseStyle(): void {
    this.#stylePicker.click();
  }
}
