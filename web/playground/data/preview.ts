/** A clip as it will enter the database: the mannequin in the clip's own proportions. */
import { POSE_FLOATS } from "../../viewer";
import type { Preview } from "../../worker/build/protocol";
import { html, setText } from "../dom";
import { strings } from "../strings/strings";
import type { Picture } from "../views";

const words = strings.data.preview;

export class ClipPreview {
  readonly element: HTMLElement;
  readonly #view = html("div", { class: "preview-view" });
  readonly #title = html("p", { class: "preview-title" });
  readonly #note = html("p", { class: "caption" });
  readonly #borrow: (container: HTMLElement) => Picture;
  #picture: Picture | undefined;
  #clip: Preview | undefined;
  #request = 0;
  #started = 0;
  #playing = true;

  constructor(borrow: (container: HTMLElement) => Picture) {
    this.#borrow = borrow;
    this.element = html(
      "section",
      { class: "section preview", "aria-label": words.name },
      this.#view,
      this.#title,
      this.#note,
    );
    this.clear();
  }

  /** Whether the picture moves: not while something else needs the processor. */
  set playing(playing: boolean) {
    this.#playing = playing;
    this.#picture?.freeze(!playing);
  }

  /** Shows a clip, or why there is no picture of it. */
  show(title: string, clip: Preview): void {
    setText(this.#title, title);
    const seconds = (clip.frames / clip.rateHz).toFixed(1);
    setText(this.#note, clip.fault || words.note(clip.frames, seconds, clip.note));
    this.#clip = clip.poses.length > 0 ? clip : undefined;
    this.#view.classList.toggle("empty", !this.#clip);
    this.resume();
  }

  /** Says why there is nothing to see. */
  fail(title: string, sentence: string): void {
    this.clear();
    setText(this.#title, title);
    setText(this.#note, sentence);
  }

  clear(): void {
    this.#clip = undefined;
    this.#view.classList.add("empty");
    setText(this.#title, "");
    setText(this.#note, words.invitation);
  }

  /** Plays the clip from its beginning. */
  resume(): void {
    cancelAnimationFrame(this.#request);
    if (!this.#clip) return;
    this.#picture ??= this.#borrow(this.#view);
    this.#picture.freeze(!this.#playing);
    this.#picture.viewer.setProportions(this.#clip.proportions);
    this.#picture.viewer.resetTrail();
    this.#started = performance.now();
    this.#request = requestAnimationFrame(this.#tick);
  }

  /** Stops, and gives the picture back. */
  stop(): void {
    cancelAnimationFrame(this.#request);
    this.#picture = undefined;
  }

  readonly #tick = (now: number): void => {
    const [clip, picture] = [this.#clip, this.#picture];
    if (!clip || !picture) return;
    this.#request = requestAnimationFrame(this.#tick);
    if (!this.#playing) return;
    const frame = Math.max(0, Math.floor(((now - this.#started) / 1000) * clip.rateHz));
    if (frame >= clip.frames) {
      this.#started = now;
      picture.viewer.resetTrail();
    }
    const at = frame % clip.frames;
    picture.viewer.setStyled(clip.poses.subarray(at * POSE_FLOATS, (at + 1) * POSE_FLOATS));
    picture.invalidate();
  };
}
