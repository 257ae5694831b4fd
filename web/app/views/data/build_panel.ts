/** The database to be built: the skeletons of the clips, its name, missing data, and the button. */

import { button } from "../../../ui/controls/buttons";
import { html, setText } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import { ProgressLine } from "../../ui/progress";
import { type KnownSkeleton, SURE } from "./corpus";

const words = strings.data.build;

/** Maximum number of sentences about missing data. */
const MAX_CONCERNS = 3;

interface BuildPanelListeners {
  onBuild: (name: string) => void;
  onRoles: (skeleton: number) => void;
}

/** Contents of the panel. */
interface BuildPlan {
  usable: number;
  styles: number;
  skeletons: readonly KnownSkeleton[];
  /** Number of clips of each skeleton. */
  clipsOf: readonly number[];
  concerns: readonly string[];
}

export class BuildPanel {
  readonly element: HTMLElement;
  readonly progress = new ProgressLine();
  readonly #name = html("input", { type: "text", class: "text", "aria-label": words.nameOf, maxlength: 80 });
  readonly #skeletons = html("div");
  readonly #concerns = html("ul", { class: "concerns" });
  readonly #build: HTMLButtonElement;
  readonly #listeners: BuildPanelListeners;
  /** The displayed contents, so that the page changes only if they differ. */
  #shown = "";

  constructor(listeners: BuildPanelListeners) {
    this.#listeners = listeners;
    this.#build = button(words.build, () => listeners.onBuild(this.#name.value.trim() || strings.data.unnamed), {
      label: true,
      class: "primary",
    });
    this.element = html(
      "section",
      { class: "section build", "aria-labelledby": "build-heading" },
      this.progress.element,
      html("div", { class: "section-heading" }, html("h2", { id: "build-heading" }, words.heading)),
      this.#skeletons,
      html("label", { class: "row" }, html("span", { class: "label" }, words.name), this.#name),
      this.#concerns,
      this.#build,
    );
  }

  set name(name: string) {
    this.#name.value = name;
  }

  set busy(busy: boolean) {
    this.#build.disabled = busy;
    setText(this.#build.firstElementChild!, busy ? words.building : words.build);
  }

  show({ usable, styles, skeletons, clipsOf, concerns }: BuildPlan): void {
    this.#build.disabled = usable === 0;
    this.#build.title = strings.data.heading(usable, styles);
    const wanted = JSON.stringify([skeletons.map(({ chosen }) => chosen !== undefined), clipsOf, concerns]);
    if (wanted === this.#shown) return;
    this.#shown = wanted;
    this.#skeletons.replaceChildren(...skeletons.map((s, i) => this.#skeleton(s, i, clipsOf[i] ?? 0)));
    const shown = concerns.slice(0, MAX_CONCERNS);
    const more = concerns.length - shown.length;
    this.#concerns.replaceChildren(
      ...shown.map((text) => html("li", { class: "caption" }, text)),
      ...(more > 0 ? [html("li", { class: "caption" }, words.more(more))] : []),
    );
  }

  /** A skeleton, the confidence of its roles, and a button to correct them. */
  #skeleton(skeleton: KnownSkeleton, number: number, clips: number): HTMLElement {
    const { joints, confidence, chosen, fault } = skeleton;
    const unsure = !chosen && (fault !== "" || confidence < SURE);
    const roles = button(unsure ? words.checkJoints : words.joints, () => this.#listeners.onRoles(number), {
      label: true,
      class: unsure ? "outlined" : "",
    });
    roles.setAttribute("aria-label", words.jointsOf(number + 1));
    const sure = chosen ? words.chosen : fault ? words.unmatched : words.matched(Math.round(100 * confidence));
    return html(
      "div",
      { class: "row skeleton" },
      html("span", { class: "label" }, words.skeleton(number + 1)),
      html(
        "span",
        { class: "reading", title: fault || skeleton.note },
        words.has(joints.length, clips),
        html("span", { class: "caption" }, sure),
      ),
      roles,
    );
  }
}
