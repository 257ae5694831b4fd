/** The file of a dropped input: a bar about it, and a panel with its reading. Each is loaded when it is first needed. */
import type { FrameRange, InputInfo, Note } from "../../../../client/protocol";
import type { ViewHost } from "../../../view";
import type { Likeness } from "../likeness";
import type { ReadingPanel } from "../reading/reading_panel";
import type { FileBar } from "./file_bar";

/** Elements of the view in which the bar and the panel stand. */
interface Places {
  /** Contains the panel, and has the classes `with-file` and `with-reading`. */
  view: HTMLElement;
  /** Follows the bar. */
  transport: HTMLElement;
  /** Contains the input's progress while the panel is closed. */
  input: HTMLElement;
}

export class InputFile {
  readonly #host: ViewHost;
  readonly #places: Places;
  #bar: FileBar | undefined;
  #loadingBar: Promise<void> | undefined;
  #panel: ReadingPanel | undefined;
  #range: FrameRange | undefined;
  /** The recognised class of the whole input, once it was analysed. */
  #likeness: Likeness | undefined;

  constructor(host: ViewHost, places: Places) {
    this.#host = host;
    this.#places = places;
  }

  /** Shows the bar if the open input was dropped, and hides it otherwise. */
  show(): void {
    const { library, chosen, input, endless } = this.#host.session;
    const file = input && !endless && library.isDropped(chosen) ? { name: chosen, input } : undefined;
    if (file && !this.#bar) this.#loadingBar ??= this.#loadBar();
    this.#bar?.show(file);
    this.#places.view.classList.toggle("with-file", file !== undefined && this.#bar !== undefined);
  }

  /** The trim; `undefined` is the whole clip. */
  set range(range: FrameRange | undefined) {
    this.#range = range;
    if (this.#bar) this.#bar.range = range;
  }

  /** A newly opened input, which is not analysed yet. */
  set input(input: InputInfo) {
    this.#likeness = undefined;
    this.#showReading(input, []);
    if (!input.reading) this.close();
  }

  /** Notes on the styled motion. */
  set styledNotes(notes: readonly Note[]) {
    if (this.#panel) this.#panel.styledNotes = notes;
  }

  set likeness(likeness: Likeness | undefined) {
    this.#likeness = likeness;
    this.showLikeness();
  }

  /** Shows the recognised class beside the labels of the state. */
  showLikeness(): void {
    if (!this.#panel) return;
    const { session, store } = this.#host;
    const { action, inputStyle } = store.state;
    const actions = session.database?.actions ?? [];
    this.#panel.likeness = { likeness: this.#likeness, actions, action, said: action !== "" || inputStyle !== "" };
  }

  /** Closes the panel; the focus returns to the button that opened it. */
  close(): void {
    const panel = this.#panel?.element;
    if (!panel || panel.hidden) return;
    const hadFocus = panel.contains(document.activeElement) || document.activeElement === document.body;
    panel.hidden = true;
    this.#places.input.prepend(this.#host.progress.input.element);
    if (this.#bar) this.#bar.reading = false;
    this.#places.view.classList.remove("with-reading");
    if (hadFocus) this.#bar?.howRead.focus({ preventScroll: true });
  }

  /** Opens the panel, or closes it. */
  async #toggle(): Promise<void> {
    if (this.#panel && !this.#panel.element.hidden) {
      this.close();
      return;
    }
    const { session, toasts, progress, signal } = this.#host;
    try {
      this.#panel ??= await this.#loadPanel();
    } catch (error) {
      toasts.failure(error);
      return;
    }
    if (!session.input?.reading || signal.aborted) return;
    this.#showReading(session.input, session.analysis?.notes ?? []);
    this.#panel.takeProgress(progress.input.element);
    this.#panel.element.hidden = false;
    if (this.#bar) this.#bar.reading = true;
    this.#places.view.classList.add("with-reading");
    this.#panel.element.focus({ preventScroll: true });
  }

  #showReading(input: InputInfo, ofStyled: readonly Note[]): void {
    if (!this.#panel) return;
    this.#panel.input = input;
    this.#panel.styledNotes = ofStyled;
    this.showLikeness();
  }

  async #loadPanel(): Promise<ReadingPanel> {
    const { ReadingPanel } = await import("../reading/reading_panel");
    const { store, toasts } = this.#host;
    const panel = new ReadingPanel({
      onRead: (reading) => this.#host.readAs(reading),
      onAction: (action) => store.edit({ action }),
      onAnything: () => store.edit({ action: "", inputStyle: "" }),
      onClose: () => this.close(),
      onRefused: (sentence) => toasts.error(sentence),
    });
    this.#places.view.append(panel.element);
    return panel;
  }

  async #loadBar(): Promise<void> {
    try {
      const { FileBar } = await import("./file_bar");
      if (this.#host.signal.aborted) return;
      this.#bar = new FileBar({
        onReading: () => void this.#toggle(),
        onRange: (range) => this.#host.store.edit({ range }),
        onRemove: () => void this.#host.removeInput(),
      });
      this.#bar.range = this.#range;
      this.#places.transport.before(this.#bar.element);
      this.show();
    } catch (error) {
      this.#loadingBar = undefined;
      this.#host.toasts.failure(error);
    }
  }
}
