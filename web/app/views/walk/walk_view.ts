/** The Walk view: a character that walks a plan of styles and transitions between them, synthesised by the walk model. */
import "../synthesis/editor.css";
import "./walk.css";
import { type WalkFrame, WalkModel } from "../../../client/models/walk";
import { type CallOptions, isCancellation, isFault, isUnloaded } from "../../../client/protocol";
import { Segment } from "../../../ui/controls/buttons";
import { formatNumber, html, setText } from "../../../ui/dom";
import { isNarrow } from "../../../ui/media";
import { normalised, type Selection, toTriangle, vertexOrder } from "../../../ui/polygon/selection";
import { onSystemTheme } from "../../../ui/theme";
import { AnimatedView } from "../../animated_view";
import { VIDEO_SIZES } from "../../outputs/formats";
import { saveBvh, saveGlb } from "../../outputs/save_motion";
import { checkVideoLength } from "../../outputs/video_length";
import type { AppState } from "../../state/state";
import type { WalkBlock } from "../../state/walk";
import { strings } from "../../strings/strings";
import { ProgressLine } from "../../ui/progress";
import { onResize } from "../../ui/resize";
import { errorText } from "../../ui/words";
import type { KeyTable, View, ViewerLease, ViewHost } from "../../view";
import { EmptyPanel } from "../synthesis/empty_panel";
import { ModelLoader } from "../synthesis/model_loader";
import { WalkModels, type WalkSource } from "../synthesis/walk_models";
import { BlockPanel } from "./block_panel";
import { figuresOf } from "./figures";
import { Footer } from "./footer";
import { addBlock, firstBlocks, mainStyle, removeBlock, withBlock, withKnownStyles } from "./plan";
import { type PlannedWalk, PlanWalker, weightsOf } from "./plan_walker";
import { Planner } from "./planner";
import { STATE_SHADES } from "./planner_picture";
import { Player } from "./player";
import { PLOT_SUBJECTS, type PlotSubject } from "./plots";
import { Strip } from "./strip";
import { blockName, planTitle } from "./titles";

export function createView(host: ViewHost): View {
  return new WalkView(host);
}

const words = strings.walk;

const BUILT_IN: WalkSource = { name: "", file: undefined, neutral: "neutral" };

const VIDEO_SIZE = "1920 × 1080";

/** Fields on which the plan, or its drawing, depends. */
const PLAN_FIELDS = [
  "walk",
  "walkBlock",
  "walkWhole",
  "walkTempo",
  "walkCadence",
  "walkStride",
  "walkTurn",
  "walkPlot",
  "loop",
] as const satisfies readonly (keyof AppState)[];

class WalkView extends AnimatedView {
  readonly element: HTMLElement;
  readonly #models = new WalkModels();
  readonly #progress = new ProgressLine();
  readonly #loader: ModelLoader<WalkSource, PlanWalker>;
  readonly #player: Player;
  readonly #stage = html("div", { class: "editor-stage" });
  readonly #title = html("h1", { class: "stage-title" });
  readonly #caption = html("p", { class: "caption" }, words.generated);
  readonly #form: Segment<"3d" | "strip">;
  readonly #strip = new Strip();
  readonly #empty = new EmptyPanel();
  readonly #planner: Planner;
  readonly #panel: BlockPanel;
  readonly #footer: Footer;
  /** The database without a model for which the user chose the built-in walks instead. */
  #replaced: WalkSource | undefined;
  #lease: ViewerLease | undefined;
  /** The step whose number is displayed in the picture. */
  #labelled = -1;

  constructor(host: ViewHost) {
    super(host);
    const { store } = host;
    this.#loader = new ModelLoader<WalkSource, PlanWalker>({
      isSame: (a, b) => a.file === b.file,
      load: (source) =>
        this.#progress.run(source.file ? words.reading : words.opening, (call) => this.#load(source, call)),
      cancel: () => this.#progress.cancel(),
      onReady: () => this.#present(),
      onFailed: (error, source) => this.#refuse(source, error),
    });
    this.#player = new Player(store, {
      onPlan: (walk) => this.#showPlan(walk),
      onFrame: (frame, secs, step) => this.#showFrame(frame, secs, step),
      onJump: ({ pose, planted }) => {
        const viewer = this.#lease?.viewer;
        viewer?.setStyled(pose);
        // With the feet of the frame before, a picture drawn before the next tick would leave a print here.
        viewer?.setPlanted(planted);
        viewer?.resetTrail();
      },
    });
    this.#planner = new Planner(store, (secs) => this.#player.seek(secs));
    this.#panel = new BlockPanel(store, {
      onBlock: (patch, gesture) => this.#editBlock(patch, gesture),
      onWhole: (walkWhole) => this.#mixWhole(walkWhole),
      onTap: () => this.#player.tapBeat(),
    });
    this.#form = new Segment(
      words.view,
      [
        { value: "3d", label: words.threeD },
        { value: "strip", label: words.strip },
      ],
      (form) => store.edit({ walkStrip: form === "strip" }),
    );
    this.#footer = new Footer(store, {
      onPlay: () => this.#player.togglePlay(),
      onPrevious: () => this.#player.stepBy(-1),
      onNext: () => this.#player.stepBy(1),
      onAdd: () => this.#addBlock(),
      onRemove: () => this.#removeBlock(),
      onBvh: () => void this.#export(bvhOf),
      onGlb: () => void this.#export(glbOf),
      onVideo: () => void this.#film(),
      onStyle: () => void this.#styleThis(),
    });
    this.element = html(
      "main",
      { class: "view walk" },
      html(
        "div",
        { class: "editor-picture" },
        this.#stage,
        this.#strip.element,
        html("div", { class: "stage-heading" }, this.#title, this.#caption),
        html("div", { class: "walk-form" }, this.#form.element),
        this.#progress.element,
        this.#empty.element,
      ),
      html("div", { class: "walk-plan" }, this.#planner.element, stateLegend()),
      this.#footer.element,
      this.#panel.element,
    );
  }

  protected appear(signal: AbortSignal): void {
    const { store } = this.host;
    store.subscribe((_, changed) => {
      if (PLAN_FIELDS.some((name) => changed.has(name))) this.#player.changePlan();
      this.#showState();
    }, signal);
    onSystemTheme(() => this.#showState(), signal);
    // Plots depend on their width, and the step's number is shown only if it fits.
    const onWidth = () => {
      this.#labelled = -1;
      this.#player.redraw();
    };
    onResize(this.element, onWidth, signal);
    this.#planner.attach(signal);
    this.#strip.attach(signal);
    this.#lease = this.host.borrowViewer(this.#stage);
    this.#lease.viewer.description = words.picture;
    this.#labelled = -1;
    this.#player.start(performance.now());
    this.refresh();
  }

  protected disappear(): void {
    this.#loader.cancel();
    this.#progress.cancel();
    this.#lease = undefined;
  }

  /** Shows the model of the open database. */
  refresh(): void {
    if (!this.isShown) return;
    const { state } = this.host.store;
    const { database } = this.host.session;
    setText(this.#title, words.opening);
    this.#showState();
    // A database stored on this device is opened first; the page calls again when it is open.
    if (state.database !== "" && !database) return;
    const { name, file } = this.host.databaseFile();
    if (this.#replaced?.file !== file) this.#replaced = undefined;
    this.#open(this.#replaced || !file ? BUILT_IN : { name, file, neutral: database?.neutral ?? "" });
  }

  override dispose(): void {
    super.dispose();
    this.#panel.dispose();
    this.#loader.dispose();
  }

  // --- the model ---

  /** Opens the model of a database: of the built-in one it comes with the page, others are trained unless it is known. */
  #open(source: WalkSource): void {
    this.#empty.hide();
    if (this.#loader.isReady(source)) this.#present();
    else {
      setText(this.#title, source.file ? words.training : words.opening);
      this.#player.walker = undefined;
      void this.#loader.request(source);
      this.#showState();
    }
  }

  async #load(source: WalkSource, call: CallOptions): Promise<PlanWalker> {
    if (!source.file) return new PlanWalker(await WalkModel.builtIn());
    const { trained, fresh } = await this.#models.of(source.file, call);
    const model = await WalkModel.open(trained.file);
    const { styles, clips, secs } = trained;
    if (fresh && !call.signal?.aborted)
      this.host.toasts.note(words.trained(styles.length, clips, formatNumber(secs, 1)));
    return new PlanWalker(model);
  }

  /** Shows why there is no model, and what can be done. */
  #refuse(source: WalkSource, error: unknown): void {
    this.#showState();
    setText(this.#title, words.nothing);
    const again = { label: words.tryAgain, onChoose: () => this.#open(source) };
    if (isCancellation(error)) {
      this.#empty.show(words.nothing, [again]);
      return;
    }
    const why = errorText(error);
    // The failure was not caused by the database.
    if (isFault(error) || isUnloaded(error)) {
      this.#empty.show(why, [again]);
      return;
    }
    const builtIn = {
      label: words.useBuiltIn,
      onChoose: () => {
        this.#replaced = source;
        this.refresh();
      },
    };
    const data = { label: words.goToData, onChoose: () => this.host.store.edit({ view: "data" }) };
    const message = `${words.noModel(source.name || words.builtInDatabase)} ${why}`;
    this.#empty.show(message, source.file ? [builtIn, data] : [again]);
  }

  /** The walker of the open database. */
  get #walker(): PlanWalker | undefined {
    return this.#loader.loading || this.#loader.failed ? undefined : this.#loader.model;
  }

  /** Applies the model's body to the picture and its styles to the plan. */
  #present(): void {
    const { store } = this.host;
    const walker = this.#walker!;
    const { styles, proportions } = walker.model;
    const neutral = this.#neutral;
    this.#lease?.viewer.setProportions(proportions);
    this.#strip.setProportions(proportions);
    this.#panel.setStyles(styles, neutral ?? "");
    const { walk } = store.state;
    const known = withKnownStyles(walk, styles, neutral) ?? walk;
    const blocks = known.length > 0 ? known : firstBlocks(styles, neutral);
    if (blocks !== walk)
      store.adopt({ walk: blocks.map((block) => ({ ...block, styles: this.#mixed(block.styles) })) });
    this.#player.walker = walker;
    this.#player.changePlan();
    this.#showState();
  }

  /** A selection as mixed by the polygon: three styles between which the handle moves, or all. */
  #mixed(styles: Selection, whole = this.host.store.state.walkWhole): Selection {
    const vertices = vertexOrder(this.#walker!.model.styles, this.#neutral ?? "");
    return whole ? normalised(styles) : toTriangle(styles, vertices);
  }

  /** The neutral style, if the model has it. */
  get #neutral(): string | undefined {
    const neutral = this.#loader.opened?.neutral;
    return this.#walker?.model.styles.find((name) => name === neutral);
  }

  // --- the plan ---

  get #chosen(): number {
    const { walk, walkBlock } = this.host.store.state;
    return Math.min(walkBlock, walk.length - 1);
  }

  readonly #nameOf = (block: WalkBlock): string => blockName(block, this.#neutral);

  #showPlan(walk: PlannedWalk): void {
    const { state } = this.host.store;
    const { walk: blocks } = state;
    const chosen = this.#chosen;
    const block = blocks[chosen]!;
    const neutral = this.#neutral;
    this.#planner.show({ blocks, chosen, neutral, walk, title: this.#nameOf });
    this.#strip.set(walk, blocks, neutral, this.#nameOf);
    this.#panel.show(state, {
      block,
      title: words.block(chosen + 1, this.#nameOf(block)),
      alone: blocks.length < 2,
      figures: figuresOf(walk, chosen),
    });
    this.#showPlot(walk, block, chosen);
    this.#footer.length = walk.frames / walk.rateHz;
    setText(this.#title, planTitle(blocks, walk.stepStarts.length - 1, neutral));
  }

  #showPlot({ segments }: PlannedWalk, block: WalkBlock, chosen: number): void {
    const { model } = this.#walker!;
    const { walkPlot } = this.host.store.state;
    const subject: PlotSubject = PLOT_SUBJECTS.find((name) => name === walkPlot) ?? "states";
    const { first } = segments.find((segment) => segment.kind === "block" && segment.block === chosen)!;
    const side = first % 2 === 0 ? 0 : 1;
    this.#panel.plot.show({ model, subject, weights: weightsOf(block, model), side });
    const foot = side === 0 ? words.leftFoot : words.rightFoot;
    this.#panel.showSubject(subject, subject === "states" ? words.ofStep(first + 1, foot) : "");
  }

  #editBlock(patch: Partial<WalkBlock>, gesture?: string): void {
    const { store } = this.host;
    store.edit({ walk: withBlock(store.state.walk, this.#chosen, patch) }, gesture);
  }

  /** Switches the polygon between all styles and three. */
  #mixWhole(walkWhole: boolean): void {
    const { store } = this.host;
    const { styles, right } = store.state.walk[this.#chosen]!;
    const mixed = (selection: Selection) => this.#mixed(selection, walkWhole);
    const patch = { styles: mixed(styles), right: right && mixed(right) };
    store.edit({ walkWhole, walk: withBlock(store.state.walk, this.#chosen, patch) });
  }

  /** Adds a block after the selected one, with a style that no block has yet. */
  #addBlock(): void {
    const { store } = this.host;
    const { walk } = store.state;
    const used = new Set(walk.map(mainStyle));
    const all = this.#walker!.model.styles;
    const style = all.find((name) => !used.has(name)) ?? all[0]!;
    const styles = this.#mixed([{ name: style, weight: 1 }]);
    store.edit({ walk: addBlock(walk, this.#chosen, styles), walkBlock: this.#chosen + 1 });
  }

  #removeBlock(): void {
    const { store } = this.host;
    const chosen = this.#chosen;
    store.edit({ walk: removeBlock(store.state.walk, chosen), walkBlock: Math.max(0, chosen - 1) });
  }

  // --- time ---

  protected tick(now: number): void {
    this.#player.tick(now);
    this.#strip.draw(now);
  }

  #showFrame(frame: WalkFrame, secs: number, step: number): void {
    const { viewer } = this.#lease!;
    viewer.setStyled(frame.pose);
    viewer.setPlanted(frame.planted);
    this.#lease!.invalidate();
    this.#planner.setPlayhead(secs, step);
    this.#strip.show(step, frame.pose);
    this.#footer.secs = secs;
    if (this.#labelled === step) return;
    this.#labelled = step;
    // The step's number does not fit in a narrow picture.
    viewer.labels = { styled: isNarrow() ? "" : words.stepCaption(step + 1), input: "" };
  }

  /** Shows the fields of the state on which the plan does not depend. */
  #showState(): void {
    const { state } = this.host.store;
    const ready = this.#walker !== undefined;
    this.element.classList.toggle("without-model", !ready);
    this.element.classList.toggle("as-strip", state.walkStrip);
    this.#form.value = state.walkStrip ? "strip" : "3d";
    this.#strip.setVisible(state.walkStrip, state.theme);
    this.#footer.show(state, ready);
  }

  readonly keys: KeyTable = {
    " ": () => this.#player.togglePlay(),
    ArrowLeft: () => this.#player.stepBy(-1),
    ArrowRight: () => this.#player.stepBy(1),
    Home: () => this.#player.seek(0),
    l: () => this.host.store.edit({ loop: !this.host.store.state.loop }),
    b: () => this.#player.tapBeat(),
  };

  // --- exports ---

  /** Saves one pass through the plan. */
  async #export(save: (model: WalkModel, poses: Float32Array) => string | Promise<string>): Promise<void> {
    const { model } = this.#walker ?? {};
    const { walk } = this.#player;
    if (!model || !walk) return;
    try {
      this.host.toasts.note(strings.synthesis.saved(await save(model, walk.poses)));
    } catch (error) {
      this.host.toasts.failure(error);
    }
  }

  /** Saves one pass through the plan as a video. */
  async #film(): Promise<void> {
    const lease = this.#lease;
    if (!this.#player.walk || !lease || this.#progress.busy) return;
    const { recording, saved, noVideo } = strings.page.outputs;
    try {
      const name = await this.#progress.run(recording, async ({ signal, onProgress }) => {
        const { saveVideo, VIDEO_RATE } = await import("../../outputs/video");
        const player = this.#player;
        checkVideoLength(player.passSecs);
        return lease.film(
          (pictureAt) => {
            async function* frames(): AsyncGenerator<HTMLCanvasElement> {
              let count = 0;
              for (const fraction of player.pass(VIDEO_RATE)) {
                onProgress?.({ label: recording, fraction });
                yield pictureAt(count++ / VIDEO_RATE);
              }
            }
            return saveVideo(words.fileName, frames(), VIDEO_SIZE);
          },
          { signal, size: VIDEO_SIZES[VIDEO_SIZE] },
        );
      });
      if (name === undefined) this.host.toasts.error(noVideo);
      else this.host.toasts.note(saved(name));
    } catch (error) {
      if (!isCancellation(error)) this.host.toasts.failure(error);
    }
  }

  /** Opens one pass through the plan in Play, as the input. */
  async #styleThis(): Promise<void> {
    const { model } = this.#walker ?? {};
    const { walk } = this.#player;
    if (!model || !walk) return;
    const bvh = new TextEncoder().encode(model.toBvh(walk.poses));
    await this.host.playMotion(`${words.fileName}.bvh`, bvh.buffer);
  }
}

const bvhOf = (model: WalkModel, poses: Float32Array) => saveBvh(words.fileName, model.toBvh(poses));
const glbOf = (model: WalkModel, poses: Float32Array) => saveGlb(words.fileName, model, poses);

/** A legend of the states of a step by their shades, first to last. */
function stateLegend(): HTMLElement {
  const entries = words.states.map((name, i) => {
    const entry = html("span", {}, name);
    entry.style.setProperty("--shade", `${100 * STATE_SHADES[i]!}%`);
    return entry;
  });
  return html("p", { class: "walk-states caption", "aria-hidden": "true" }, ...entries);
}
