/** The Walk view: somebody who walks without end, in styles that a plan of blocks and transitions mixes. */
import "../styles/maker.css";
import "../styles/walk.css";
import { VIEWER_DEFAULTS } from "../../viewer";
import { WalkModel } from "../../worker/walk/walk";
import { button, Segment } from "../controls/buttons";
import { icon } from "../controls/icons";
import { clock, formatNumber, html, setText } from "../dom";
import { saveBvh, saveGlb } from "../outputs/save_motion";
import { normalised, type Selection, toTriangle, vertexOrder } from "../polygon/selection";
import { ProgressLine } from "../progress";
import { type PlayState, RANGES } from "../state";
import { strings } from "../strings/strings";
import { onSystemTheme } from "../theme";
import type { Picture, View, ViewHost } from "../views";
import { capitalised, errorText, isCancellation, manner, numberWord, spoken } from "../words";
import { BlockPanel } from "./block_panel";
import { figuresOf } from "./figures";
import { WalkModels, type WalkSource } from "./models";
import {
  addBlock,
  firstBlocks,
  MOST_BLOCKS,
  mainStyle,
  removeBlock,
  type WalkBlock,
  withBlock,
  withKnownStyles,
} from "./plan";
import { Planner } from "./planner";
import { PLOT_SUBJECTS, type PlotSubject } from "./plots";
import { Strip } from "./strip";
import { TapTempo } from "./tap_tempo";
import { type Walked, Walking, weightsOf } from "./walking";

export function createView(host: ViewHost): View {
  return new Walk(host);
}

/** Longest step of the clock: a hidden tab does not catch up. */
const LONGEST_STEP_SECS = 0.1;
/** The seed of drawn durations: a link shows the same walk to everybody. */
const SEED = 1;

/** Below this the picture has no room for the step's number. */
const NARROW_PX = 900;

/** What the walk depends on. */
const WALK_FIELDS = [
  "walk",
  "walkBlock",
  "walkWhole",
  "walkTempo",
  "walkCadence",
  "walkStride",
  "walkTurn",
  "walkPlot",
  "loop",
] as const satisfies readonly (keyof PlayState)[];

class Walk implements View {
  readonly element: HTMLElement;
  readonly #host: ViewHost;
  readonly #models = new WalkModels();
  readonly #progress = new ProgressLine();
  readonly #stage = html("div", { class: "maker-stage" });
  readonly #title = html("h1", { class: "stage-title" });
  readonly #caption = html("p", { class: "caption" }, strings.walk.generated);
  readonly #form: Segment<"3d" | "strip">;
  readonly #strip = new Strip();
  readonly #empty = html("div", { class: "maker-empty", hidden: true });
  readonly #planner: Planner;
  readonly #panel: BlockPanel;
  readonly #play: HTMLButtonElement;
  readonly #loop: HTMLButtonElement;
  readonly #clock = html("span", { class: "clock" });
  readonly #duration = html("span", { class: "caption" });
  readonly #add: HTMLButtonElement;
  readonly #remove: HTMLButtonElement;
  readonly #needsModel: HTMLButtonElement[];
  #picture: Picture | undefined;
  #source: WalkSource | undefined;
  #walking: Walking | undefined;
  #walked: Walked | undefined;
  #shown = false;
  #dirty = true;
  /** Whether what stands still has to be drawn once more. */
  #moved = true;
  #last = 0;
  #request = 0;
  #labelled = -1;
  readonly #taps = new TapTempo();
  #listening = new AbortController();

  constructor(host: ViewHost) {
    this.#host = host;
    const { store } = host;
    this.#planner = new Planner({
      blocks: () => store.state.walk,
      onChoose: (walkBlock) => store.edit({ walkBlock }),
      onEdit: (walk, gesture, chosen) =>
        store.edit({ walk, ...(chosen !== undefined && { walkBlock: chosen }) }, gesture),
      onSettle: () => store.endGesture(),
      onSeek: (secs) => this.#seek(secs),
    });
    this.#panel = new BlockPanel({
      onBlock: (patch, gesture) => store.edit({ walk: withBlock(store.state.walk, this.#chosen, patch) }, gesture),
      onSettle: () => store.endGesture(),
      onWhole: (walkWhole) => {
        const { styles, right } = store.state.walk[this.#chosen]!;
        const mixed = (selection: Selection) => this.#mixed(selection, walkWhole);
        const patch = { styles: mixed(styles), right: right && mixed(right) };
        store.edit({ walkWhole, walk: withBlock(store.state.walk, this.#chosen, patch) });
      },
      onTap: () => this.#tapBeat(),
      onTempo: (walkTempo) => store.edit({ walkTempo }),
      onCadence: (walkCadence) => store.edit({ walkCadence }, "walk cadence"),
      onStride: (walkStride) => store.edit({ walkStride }, "walk stride"),
      onTurn: (walkTurn) => store.edit({ walkTurn }, "walk turn"),
      onSubject: (walkPlot) => store.edit({ walkPlot }),
    });
    this.#form = new Segment(
      strings.walk.view,
      [
        { value: "3d", label: strings.walk.threeD },
        { value: "strip", label: strings.walk.strip },
      ],
      (form) => store.edit({ walkStrip: form === "strip" }),
    );
    this.#play = button(strings.walk.play, () => this.#togglePlay(), { icon: "play", class: "play", keys: "Space" });
    const previous = button(strings.walk.previous, () => this.#goBySteps(-1), { icon: "previous", keys: "←" });
    const next = button(strings.walk.next, () => this.#goBySteps(1), { icon: "next", keys: "→" });
    this.#loop = button(strings.walk.loop, () => store.edit({ loop: !store.state.loop }), { icon: "loop", keys: "L" });
    this.#add = button(strings.walk.add, () => this.#addBlock(), { icon: "add", label: true });
    this.#remove = button(strings.walk.remove, () => this.#removeBlock(), { icon: "remove" });
    const bvh = button(strings.walk.exportBvh, () => void this.#export(bvhOf), {
      icon: "export",
      label: true,
      class: "outlined",
    });
    const glb = button(strings.walk.exportGlb, () => void this.#export(glbOf), {
      icon: "export",
      label: true,
      class: "outlined",
    });
    const style = button(strings.walk.styleThis, () => void this.#styleThis(), {
      icon: "share",
      label: true,
      class: "outlined",
    });
    style.title = strings.walk.styleThisWhy;
    this.#needsModel = [this.#play, previous, next, this.#loop, this.#add, this.#remove, bvh, glb, style];
    this.element = html(
      "main",
      { class: "view walk" },
      html(
        "div",
        { class: "maker-picture" },
        this.#stage,
        this.#strip.element,
        html("div", { class: "stage-heading" }, this.#title, this.#caption),
        html("div", { class: "walk-form" }, this.#form.element),
        this.#progress.element,
        this.#empty,
      ),
      html("div", { class: "walk-plan" }, this.#planner.element, legend()),
      html(
        "footer",
        { class: "maker-foot" },
        html("div", { class: "maker-transport" }, this.#play, previous, next, this.#loop),
        html("p", { class: "maker-time" }, this.#clock, this.#duration),
        html("div", { class: "maker-actions" }, this.#add, this.#remove, bvh, glb, style),
      ),
      this.#panel.element,
    );
    store.subscribe((_, changed) => {
      if (!this.#shown) return;
      if (WALK_FIELDS.some((name) => changed.has(name))) this.#dirty = true;
      this.#showTransport();
    });
    // Plots are drawn for the width that they have.
    new ResizeObserver(() => {
      this.#dirty = true;
    }).observe(this.element);
    this.#enable(false);
  }

  get history() {
    return this.#host.store;
  }

  show(): void {
    this.#shown = true;
    this.#listening = new AbortController();
    const { signal } = this.#listening;
    addEventListener("keydown", (event) => this.#onKey(event), { signal });
    onSystemTheme(() => this.#showTransport(), signal);
    this.#picture = this.#host.borrowPicture(this.#stage);
    this.#picture.viewer.description = strings.walk.picture;
    this.#showTransport();
    this.#dirty = true;
    void this.#open(this.#host.databaseFile());
    this.#last = performance.now();
    this.#request = requestAnimationFrame(this.#tick);
  }

  hide(): void {
    this.#shown = false;
    this.#listening.abort();
    this.#progress.cancel();
    cancelAnimationFrame(this.#request);
    if (this.#picture) this.#picture.viewer.description = VIEWER_DEFAULTS.description;
    this.#picture = undefined;
  }

  refresh(): void {
    if (this.#shown) void this.#open(this.#host.databaseFile());
  }

  takeFiles(): void {
    // Files go to the page: a motion becomes the input, clips go to the Data view.
  }

  dispose(): void {
    this.hide();
    this.#strip.dispose();
    this.#walking?.dispose();
  }

  // --- the model ---

  /** Trains on a database, unless its model is the one that walks. */
  async #open(source: WalkSource): Promise<void> {
    const known = this.#walking && this.#source?.file === source.file;
    this.#source = source;
    if (known) {
      this.#present();
      return;
    }
    this.#empty.hidden = true;
    setText(this.#title, strings.walk.training);
    try {
      const { trained, fresh } = await this.#progress.run(strings.walk.reading, (call) =>
        this.#models.of(source, call),
      );
      const model = await WalkModel.open(trained.file);
      if (this.#source !== source) {
        model.dispose();
        return;
      }
      this.#walking?.dispose();
      this.#walking = new Walking(model);
      if (fresh) this.#tell(trained.styles.length, trained.clips, trained.secs);
      this.#present();
      this.#restart();
    } catch (error) {
      if (this.#source !== source) return;
      this.#walking?.dispose();
      this.#walking = undefined;
      this.#refuse(source, isCancellation(error) ? "" : errorText(error));
    }
  }

  #tell(styles: number, clips: number, secs: number): void {
    this.#host.notices.note(strings.walk.trained(styles, clips, formatNumber(secs, 1)));
  }

  /** Says why nobody walks, and what can be done. */
  #refuse(source: WalkSource, why: string): void {
    this.#enable(false);
    setText(this.#title, strings.walk.nothing);
    const name = source.name || strings.walk.builtInDatabase;
    const again = button(strings.walk.tryAgain, () => void this.#open(source), { label: true, class: "outlined" });
    const builtIn = button(strings.walk.useBuiltIn, () => void this.#open({ name: "", file: undefined }), {
      label: true,
      class: "outlined",
    });
    const data = button(strings.walk.goToData, () => this.#host.store.edit({ view: "data" }), {
      label: true,
      class: "outlined",
    });
    const choices = why === "" ? [again] : source.file ? [builtIn, data] : [again];
    this.#empty.replaceChildren(
      html("p", {}, why === "" ? strings.walk.nothing : `${strings.walk.noModel(name)} ${why}`),
      html("div", {}, ...choices),
    );
    this.#empty.hidden = false;
  }

  /** Puts the model's body on the stage and its styles into the plan. */
  #present(): void {
    const { store } = this.#host;
    const { styles, proportions } = this.#walking!.model;
    this.#enable(true);
    this.#picture?.viewer.setProportions(proportions);
    this.#strip.setProportions(proportions);
    this.#panel.setStyles(styles, this.#neutral ?? "");
    const { walk } = store.state;
    const known = withKnownStyles(walk, styles, this.#neutral) ?? walk;
    const blocks = known.length > 0 ? known : firstBlocks(styles, this.#neutral);
    if (blocks !== walk)
      store.adopt({ walk: blocks.map((block) => ({ ...block, styles: this.#mixed(block.styles) })) });
    this.#dirty = true;
    this.#moved = true;
  }

  /** A selection with room for the handle to move, unless the whole polygon is mixed. */
  #mixed(styles: Selection, whole = this.#host.store.state.walkWhole): Selection {
    const vertices = vertexOrder(this.#walking!.model.styles, this.#neutral ?? "");
    return whole ? normalised(styles) : toTriangle(styles, vertices);
  }

  #enable(can: boolean): void {
    for (const element of this.#needsModel) element.disabled = !can;
    this.element.classList.toggle("without-model", !can);
  }

  /** The neutral style, where the model has it. */
  get #neutral(): string | undefined {
    const neutral = this.#source?.file ? this.#host.session()?.database?.neutral : "neutral";
    return this.#walking?.model.styles.find((name) => name === neutral);
  }

  get #chosen(): number {
    const { walk, walkBlock } = this.#host.store.state;
    return Math.min(walkBlock, walk.length - 1);
  }

  // --- the plan ---

  #apply(): void {
    const { state } = this.#host.store;
    const walking = this.#walking!;
    if (state.walk.length === 0) return;
    const tempo =
      state.walkTempo === "fixed"
        ? { kind: "fixed" as const, cadence: state.walkCadence }
        : state.walkTempo === "sampled"
          ? { kind: "sampled" as const, seed: SEED }
          : { kind: "model" as const };
    this.#walked = walking.set({
      blocks: state.walk,
      loop: state.loop,
      tempo,
      stride: state.walkStride / 100,
      turn: (state.walkTurn * Math.PI) / 180,
    });
    const chosen = this.#chosen;
    const block = state.walk[chosen]!;
    const neutral = this.#neutral;
    this.#planner.show({ blocks: state.walk, chosen, neutral, walked: this.#walked, title: this.#nameOf });
    this.#panel.show({
      block,
      title: strings.walk.block(chosen + 1, this.#nameOf(block)),
      whole: state.walkWhole,
      tempo: state.walkTempo,
      cadence: state.walkCadence,
      stride: state.walkStride,
      turn: state.walkTurn,
      alone: state.walk.length < 2,
      figures: figuresOf(this.#walked, chosen),
    });
    this.#showPlot(block, chosen);
    this.#showHeading(state.walk, neutral);
    this.#strip.set(this.#walked, state.walk, neutral, this.#nameOf);
    this.#add.disabled = state.walk.length >= MOST_BLOCKS;
    this.#remove.disabled = state.walk.length < 2;
    setText(this.#duration, strings.walk.of(formatNumber(this.#walked.frames / this.#walked.rateHz, 2)));
    this.#moved = true;
  }

  /** What a block is like, in words. */
  readonly #nameOf = ({ styles, right, intensity }: WalkBlock): string => {
    if (Math.abs(intensity) < 0.05) return strings.walk.averageStyle;
    const of = (selection: Selection) => {
      const some = selection.filter((s) => Math.abs(s.weight) > 0.005);
      return some.length === 1 ? spoken(some[0]!.name) : manner(selection, 1, this.#neutral ?? "");
    };
    const name = right ? strings.walk.limping(of(styles), of(right)) : of(styles);
    if (intensity < 0) return strings.walk.opposite(name);
    return intensity > 1.05 ? strings.walk.very(name) : intensity < 0.95 ? strings.walk.slightly(name) : name;
  };

  #showPlot(block: WalkBlock, chosen: number): void {
    const { model } = this.#walking!;
    const asked = this.#host.store.state.walkPlot;
    const subject: PlotSubject = PLOT_SUBJECTS.find((name) => name === asked) ?? "states";
    const first = this.#walked!.segments.find((s) => s.kind === "block" && s.block === chosen)!.first;
    const side = first % 2 === 0 ? 0 : 1;
    this.#panel.plot.show({ model, subject, weights: weightsOf(block, model), side });
    const foot = side === 0 ? strings.walk.leftFoot : strings.walk.rightFoot;
    this.#panel.showSubject(subject, subject === "states" ? strings.walk.ofStep(first + 1, foot) : "");
  }

  #showHeading(blocks: readonly WalkBlock[], neutral: string | undefined): void {
    const steps = this.#walked!.begins.length - 1;
    const all = blocks.flatMap(({ styles, right }) => [...styles, ...(right ?? [])]);
    const names = new Set(all.filter((s) => s.weight !== 0).map((s) => s.name));
    if (names.size === 0 && neutral) names.add(neutral);
    const title = strings.walk.title(
      strings.walk.steps(steps, capitalised(numberWord(steps))),
      strings.walk.styles(names.size, numberWord(names.size)),
    );
    setText(this.#title, title);
  }

  /** A beat: the cadence is that of the last ones, and a step is to end with it. */
  #tapBeat(): void {
    if (!this.#walking || this.#host.store.state.walkTempo !== "fixed") return;
    const cadence = this.#taps.tap(performance.now());
    if (cadence === undefined) return;
    const { min, max } = RANGES.cadence;
    this.#host.store.edit({ walkCadence: Math.round(Math.min(max, Math.max(min, cadence))) }, "walk cadence");
    this.#dirty = false;
    this.#apply();
    this.#walking.beatNow();
  }

  #addBlock(): void {
    const { store } = this.#host;
    const { walk } = store.state;
    const used = new Set(walk.map(mainStyle));
    const all = this.#walking!.model.styles;
    const style = all.find((name) => !used.has(name)) ?? all[0]!;
    const styles = this.#mixed([{ name: style, weight: 1 }]);
    store.edit({ walk: addBlock(walk, this.#chosen, styles), walkBlock: this.#chosen + 1 });
  }

  #removeBlock(): void {
    const { store } = this.#host;
    const chosen = this.#chosen;
    store.edit({ walk: removeBlock(store.state.walk, chosen), walkBlock: Math.max(0, chosen - 1) });
  }

  // --- time ---

  readonly #tick = (now: number): void => {
    this.#request = requestAnimationFrame(this.#tick);
    const dt = Math.min((now - this.#last) / 1000, LONGEST_STEP_SECS);
    this.#last = now;
    const walking = this.#walking;
    if (!walking) return;
    if (this.#dirty) {
      this.#dirty = false;
      this.#apply();
    }
    if (!this.#walked) return;
    const { state } = this.#host.store;
    if (state.playing) {
      walking.advance(dt * state.speed);
      this.#moved = true;
      if (!state.loop && walking.place.rounds > 0) {
        walking.seek(walking.steps - 1, 0.999);
        this.#host.store.edit({ playing: false });
      }
    }
    if (this.#moved) this.#draw();
    this.#strip.draw(now);
  };

  #draw(): void {
    this.#moved = false;
    const { frame, place } = this.#walking!;
    const { viewer } = this.#picture!;
    viewer.setStyled(frame.pose);
    viewer.setPlanted(frame.planted);
    this.#picture!.invalidate();
    const secs = this.#secsAt(place.step, frame.done);
    this.#planner.setPlayhead(secs, place.step);
    this.#strip.show(place.step, frame.pose);
    setText(this.#clock, clock(secs));
    if (this.#labelled !== place.step) {
      this.#labelled = place.step;
      const styled = this.element.clientWidth < NARROW_PX ? "" : strings.walk.stepCaption(place.step + 1);
      viewer.labels = { styled, input: "" };
    }
  }

  #secsAt(step: number, done: number): number {
    const { begins, rateHz } = this.#walked!;
    const [from, to] = [begins[step] ?? 0, begins[step + 1] ?? begins.at(-1)!];
    return (from + (to - from) * done) / rateHz;
  }

  /** Puts the walk at a time of the plan. */
  #seek(secs: number): void {
    if (!this.#walking || !this.#walked) return;
    const { begins, rateHz, frames } = this.#walked;
    const frame = Math.min(Math.max(0, secs * rateHz), frames - 0.01);
    const step = Math.min(
      begins.findLastIndex((begin) => begin <= frame),
      begins.length - 2,
    );
    const [from, to] = [begins[step]!, begins[step + 1]!];
    this.#walking.seek(step, (frame - from) / Math.max(1, to - from));
    this.#picture?.viewer.setStyled(this.#walking.frame.pose);
    this.#picture?.viewer.resetTrail();
    this.#moved = true;
  }

  #restart(): void {
    this.#dirty = false;
    this.#apply();
    this.#seek(0);
  }

  #goBySteps(by: number): void {
    if (!this.#walking || !this.#walked) return;
    const { steps, place } = this.#walking;
    this.#host.store.edit({ playing: false });
    const step = (place.step + by + steps) % steps;
    this.#seek(this.#secsAt(step, 0.5));
  }

  #togglePlay(): void {
    const { store } = this.#host;
    if (!this.#walking) return;
    const atEnd = !store.state.loop && this.#walking.place.step === this.#walking.steps - 1;
    if (!store.state.playing && atEnd) this.#seek(0);
    store.edit({ playing: !store.state.playing });
  }

  #showTransport(): void {
    const { state } = this.#host.store;
    const name = state.playing ? strings.walk.pause : strings.walk.play;
    if (this.#play.getAttribute("aria-label") !== name) {
      this.#play.setAttribute("aria-label", name);
      this.#play.title = `${name} (Space)`;
      this.#play.replaceChildren(icon(state.playing ? "pause" : "play", 18));
    }
    this.#loop.setAttribute("aria-pressed", String(state.loop));
    this.#form.value = state.walkStrip ? "strip" : "3d";
    this.element.classList.toggle("as-strip", state.walkStrip);
    this.#strip.setVisible(state.walkStrip, state.theme);
  }

  #onKey(event: KeyboardEvent): void {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    const active = document.activeElement;
    if (document.querySelector("dialog[open]") || active?.matches("button, select, input, canvas")) return;
    const { store } = this.#host;
    const act = {
      " ": () => this.#togglePlay(),
      ArrowLeft: () => this.#goBySteps(-1),
      ArrowRight: () => this.#goBySteps(1),
      Home: () => this.#seek(0),
      l: () => store.edit({ loop: !store.state.loop }),
      b: () => this.#tapBeat(),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  // --- what leaves the view ---

  /** Saves one time through the plan. */
  async #export(save: (model: WalkModel, poses: Float32Array) => string | Promise<string>): Promise<void> {
    if (!this.#walking || !this.#walked) return;
    try {
      this.#host.notices.note(strings.walk.saved(await save(this.#walking.model, this.#walked.poses)));
    } catch (error) {
      this.#host.notices.error(errorText(error));
    }
  }

  /** Takes one time through the plan to Play, as the input. */
  async #styleThis(): Promise<void> {
    if (!this.#walking || !this.#walked) return;
    const bvh = new TextEncoder().encode(this.#walking.model.toBvh(this.#walked.poses));
    await this.#host.playMotion(`${strings.walk.fileName}.bvh`, bvh.buffer);
  }
}

const bvhOf = (model: WalkModel, poses: Float32Array) => saveBvh(strings.walk.fileName, model.toBvh(poses));
const glbOf = (model: WalkModel, poses: Float32Array) => saveGlb(strings.walk.fileName, model, poses);

/** The states of a step, darkest first. */
function legend(): HTMLElement {
  return html(
    "p",
    { class: "walk-states caption" },
    ...strings.walk.states.map((name, i) => html("span", { style: `--shade: ${[95, 74, 55, 38, 24][i]}%` }, name)),
  );
}
