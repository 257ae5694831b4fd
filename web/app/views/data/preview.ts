/** Preview of a clip as it will be in the database: the mannequin in the clip's own proportions. */

import type { Preview } from "../../../client/build/protocol";
import { POSE_FLOATS } from "../../../humanoid";
import { html, setText } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import type { ViewerLease } from "../../view";

const words = strings.data.preview;

export class ClipPreview {
  readonly element: HTMLElement;
  readonly #view = html("div", { class: "preview-view" });
  readonly #title = html("p", { class: "preview-title" });
  readonly #note = html("p", { class: "caption" });
  readonly #borrow: (container: HTMLElement) => ViewerLease;
  #lease: ViewerLease | undefined;
  #clip: Preview | undefined;
  #request = 0;
  #started = 0;
  #playing = true;

  constructor(borrow: (container: HTMLElement) => ViewerLease) {
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

  /** Whether the preview plays; it is paused while a build needs the CPU. */
  set playing(playing: boolean) {
    this.#playing = playing;
    this.#lease?.freeze(!playing);
  }

  /** Shows a clip, or why it cannot be shown. */
  show(title: string, clip: Preview): void {
    setText(this.#title, title);
    const seconds = (clip.frames / clip.rateHz).toFixed(1);
    setText(this.#note, clip.fault || words.note(clip.frames, seconds, clip.note));
    this.#clip = clip.poses.length > 0 ? clip : undefined;
    this.#view.classList.toggle("empty", !this.#clip);
    this.resume();
  }

  /** Shows a sentence instead of a clip. */
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
    this.#lease ??= this.#borrow(this.#view);
    this.#lease.freeze(!this.#playing);
    this.#lease.viewer.setProportions(this.#clip.proportions);
    this.#lease.viewer.resetTrail();
    this.#started = performance.now();
    this.#request = requestAnimationFrame(this.#tick);
  }

  /** Stops, and returns the viewer. */
  stop(): void {
    cancelAnimationFrame(this.#request);
    this.#lease = undefined;
  }

  readonly #tick = (now: number): void => {
    const [clip, lease] = [this.#clip, this.#lease];
    if (!clip || !lease) return;
    this.#request = requestAnimationFrame(this.#tick);
    if (!this.#playing) return;
    const frame = Math.max(0, Math.floor(((now - this.#started) / 1000) * clip.rateHz));
    if (frame >= clip.frames) {
      this.#started = now;
      lease.viewer.resetTrail();
    }
    const at = frame % clip.frames;
    lease.viewer.setStyled(clip.poses.subarray(at * POSE_FLOATS, (at + 1) * POSE_FLOATS));
    lease.invalidate();
  };
}
