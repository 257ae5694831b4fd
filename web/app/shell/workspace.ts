/** The open objects, synchronised with the state: database, input, the available styles, and the engine's options. */

import type { StrutClient } from "../../client/client";
import type { FirstSteps } from "../../client/first_steps";
import {
  type DatabaseInfo,
  type ExactPoses,
  type FileReading,
  isCancellation,
  StrutError,
} from "../../client/protocol";
import { engineOptions } from "../../link/engine_options";
import { linkedFile } from "../../link/linked_file";
import { ENGINE_FIELDS } from "../../link/play";
import { sameReading, saysNothing } from "../../link/reading";
import { type DroppedInput, isLive } from "../../player/input_library";
import { Session, UnknownInput } from "../../player/session";
import { firstSelection } from "../../ui/polygon/selection";
import { Playhead } from "../state/playhead";
import type { AppState } from "../state/state";
import type { Store } from "../state/store";
import { withKnownLabels, withKnownStyles, withRenamedStyles } from "../state/style_settings";
import { strings } from "../strings/strings";
import { RELOAD, type ToastAction, type Toasts } from "../ui/toasts";
import { cancelled, errorText } from "../ui/words";
import { Databases } from "./databases";
import { isPlain } from "./first_set";
import { ReadingMemory } from "./reading_memory";
import { askForJoints, skeletonOf } from "./refused_skeleton";
import type { SessionProgressLines } from "./session_progress";

type Changed = ReadonlySet<keyof AppState>;
const any = (changed: Changed, ...names: (keyof AppState)[]): boolean => names.some((name) => changed.has(name));

export class Workspace {
  readonly session: Session;
  readonly playhead: Playhead;
  readonly databases: Databases;
  readonly #store: Store;
  readonly #toasts: Toasts;
  readonly #progress: SessionProgressLines;
  /** The user's readings of skeletons. */
  readonly #readings = new ReadingMemory();
  /** The opening that the state has requested. */
  #opening: Promise<void> = Promise.resolve();
  /** Number of links being followed, and of requests by the state still in progress. */
  #pending = 0;
  /** Number of inputs that the user chose and that are still being opened. */
  #choosing = 0;
  /** Whether a link is being followed: it overrides whatever the user had started to open. */
  #arriving = false;
  /** Removed inputs, by their names: undo restores them. */
  readonly #removed = new Map<string, DroppedInput>();
  /** The file that a link refers to and does not contain, and the frame that it shows. */
  #awaited: { input: string; frame: number } | undefined;

  constructor(client: StrutClient, store: Store, toasts: Toasts, progress: SessionProgressLines) {
    this.#store = store;
    this.#toasts = toasts;
    this.#progress = progress;
    this.session = new Session(client, progress);
    this.session.remembered = () => this.#readings.all();
    this.playhead = new Playhead(store, this.session);
    this.databases = new Databases(store, toasts, this.session);
    this.session.listen({
      onDatabase: (database) => {
        this.#completeStyles(database);
        this.#configure();
      },
      onError: (error) => this.#report(error),
      onStopped: () => store.edit({ playing: false }),
      onRestart: ({ why, lost, reason }) =>
        lost.length > 0
          ? toasts.error(strings.page.engine.restartedWithout(lost, why, reason), { action: RELOAD })
          : toasts.note(strings.page.engine.restarted(why)),
    });
    store.subscribe((_, changed) => this.#onChange(changed));
  }

  /**
   * Opens what the state asks for, and the file in the link, and starts playback. Without a link it starts with a few
   * strides, which are available first.
   */
  async start(hash: string, firstSteps: Promise<FirstSteps> | undefined): Promise<void> {
    const { session } = this;
    // Without them the stage is empty for longer.
    firstSteps?.then((steps) => session.startWith(steps, { neutral: 1 })).catch(() => {});
    const carried = await this.#carriedInput(hash, this.#store.state.reading);
    if (carried !== undefined) this.#store.adopt({ input: carried });
    if (isPlain(hash) && !this.databases.unnamed) {
      await this.databases.startWithFirst();
      void this.#counted(this.databases.complete);
    }
    if (!session.database) await this.databases.follow(this.#store.state.input);
    if (carried !== undefined && session.inputName !== carried) session.library.remove(carried);
    if (session.database && !session.input) await session.openInput(session.library.first);
    this.#settleInput();
    const { loop, range, frame, playing, speed } = this.#store.state;
    session.setLoop(loop, range);
    session.playback.speed = speed;
    if (!playing && frame > 0) session.playback.seek(frame);
    session.playback.start();
  }

  /** Whether everything that the state asks for is open. */
  get opened(): boolean {
    return this.#pending === 0;
  }

  /** Whether the displayed pose has the input, the frame and the styles of the state. */
  get upToDate(): boolean {
    return this.opened && this.session.playback.upToDate;
  }

  /** Applies the state of a link, or the given fields of it; the link may contain a file. */
  arrive(arrived: Partial<AppState>, hash: string): Promise<void> {
    return this.#counted(this.#followLink(arrived, hash));
  }

  async #followLink(arrived: Partial<AppState>, hash: string): Promise<void> {
    const whole = arrived.input !== undefined;
    const carried = whole ? await this.#carriedInput(hash, arrived.reading ?? {}) : undefined;
    this.#arriving = whole;
    this.#store.edit(carried === undefined ? arrived : { ...arrived, input: carried });
    this.#arriving = false;
    if (whole) this.#follow(true, true);
    if (arrived.frame !== undefined && !this.#store.state.playing) this.playhead.awaitFrame(arrived.frame);
    await this.#opening;
    const { playing, frame } = this.#store.state;
    if (arrived.frame !== undefined && !playing) this.playhead.goTo(frame);
  }

  /** Opens an input of the library and stores it in the state. Returns whether it is open. */
  async chooseInput(name: string): Promise<boolean> {
    this.#choosing++;
    const opened = (await this.session.openInput(name)) === "done";
    this.#choosing--;
    if (opened) this.#store.edit({ input: this.#openInput, reading: this.session.reading, ...this.#beginning });
    return opened;
  }

  /** Cancels the opening of a chosen input, which is no edit yet. Returns whether one was being opened. */
  cancelChoice(): boolean {
    if (this.#choosing === 0) return false;
    this.#progress.input.cancel();
    return true;
  }

  /** Removes the open dropped file from the inputs. Undo restores it. */
  async removeInput(): Promise<void> {
    const { library, chosen } = this.session;
    const removed = library.file(chosen);
    if (!removed) return;
    const { offerUntilEdit } = await import("../project/offer");
    library.remove(chosen);
    if (!(await this.chooseInput(library.first))) {
      await library.bringBack(removed);
      return;
    }
    this.#removed.set(removed.name, removed);
    const place = { toasts: this.#toasts, store: this.#store };
    offerUntilEdit(strings.play.input.removed(removed.name), strings.page.bar.undo, () => this.#store.undo(), place);
  }

  /** Opens a clip of the open database and stores it as the state's input. Returns whether it is open. */
  async chooseClip(clip: number): Promise<boolean> {
    const name = await this.session.openClip(clip);
    if (name !== undefined) this.#store.edit({ input: name, reading: this.session.reading, range: undefined });
    return name !== undefined;
  }

  /** Reads the open file as the user specifies, which is stored for its skeleton. Returns whether it could be read so. */
  async readAs(reading: FileReading): Promise<boolean> {
    const { session } = this;
    const read = (await this.#counted(session.readAs(reading))) === "done";
    if (read) {
      this.#store.edit({ reading: session.reading });
      this.#rememberReading();
    }
    return read;
  }

  /** Reads a dropped motion, however slow its disk is, and opens it. Of several dropped motions, the last one is opened. */
  async takeFile(file: File): Promise<void> {
    let bytes: ArrayBuffer;
    try {
      bytes = await this.#progress.input.run(strings.page.engine.reading(file.name), ({ signal }) =>
        unlessAborted(file.arrayBuffer(), signal),
      );
    } catch (error) {
      if (!isCancellation(error)) this.#toasts.error(strings.page.drop.unreadable(file.name));
      return;
    }
    await this.takeMotion(file.name, bytes);
  }

  /** Opens a motion, read as the user specifies. */
  async takeMotion(fileName: string, bytes: ArrayBuffer, exact?: ExactPoses, reading?: FileReading): Promise<void> {
    const refused = (error: unknown) =>
      isOfFile(error) && !exact
        ? this.#toasts.error(errorText(error), { action: this.#offerOfJoints(fileName, bytes) })
        : this.#report(error);
    const name = await this.session.openFile(fileName, bytes, { exact, reading }, refused);
    if (name === undefined) return;
    if (reading) this.#rememberReading();
    const awaited = name === this.#awaited?.input ? this.#awaited : undefined;
    const { range } = awaited ? this.#store.state : {};
    this.#store.edit({ input: name, reading: this.session.reading, ...this.#beginning, range });
    // The link is complete now: its own frame is shown.
    if (awaited && !this.#store.state.playing) this.playhead.goTo(awaited.frame);
    this.#awaited = undefined;
  }

  #report(error: unknown): void {
    if (error instanceof UnknownInput) this.#toasts.error(strings.page.engine.noInput(error.input));
    else this.#toasts.failure(error);
  }

  /** The action offered when a file was refused because of its skeleton: to map the joints. */
  async #offerOfJoints(fileName: string, bytes: ArrayBuffer): Promise<ToastAction | undefined> {
    const skeleton = await skeletonOf(fileName, bytes);
    if (!skeleton?.fault) return undefined;
    const act = async () => {
      const joints = await askForJoints(skeleton);
      if (joints) await this.takeMotion(fileName, bytes, undefined, { joints });
    };
    return { label: strings.page.drop.choose, act: () => void act() };
  }

  /** Opens the first of several dropped motions; the others can be selected. */
  async takeMotions(motions: readonly { name: string; bytes: ArrayBuffer }[]): Promise<void> {
    const [first, ...others] = motions;
    if (!first) return;
    for (const { name, bytes } of others) await this.session.library.add(name, bytes);
    await this.takeMotion(first.name, first.bytes);
  }

  dispose(): void {
    this.session.dispose();
  }

  #onChange(changed: Changed): void {
    const { session } = this;
    const moving = (this.#arriving || changed.has("database")) && this.databases.mustFollow;
    // Another database has other styles: they are checked when it is open.
    if (session.database && !moving && any(changed, "styles", "parts", "track", "action", "inputStyle"))
      this.#completeStyles(session.database);
    const { loop, range, speed } = this.#store.state;
    if (any(changed, "loop", "range")) session.setLoop(loop, range);
    if (changed.has("speed")) session.playback.speed = speed;
    if (!moving && any(changed, ...ENGINE_FIELDS)) this.#configure();
    if (!this.#arriving) this.#follow(changed.has("database"), any(changed, "input", "reading"));
  }

  /** Opens the database or the input that the state asks for. */
  #follow(database: boolean, input: boolean): void {
    const { session } = this;
    const { input: name } = this.#store.state;
    if (session.database && database && this.databases.mustFollow)
      this.#opening = this.#counted(this.#followDatabase(name));
    else if (session.input && input) this.#opening = this.#counted(this.#followInput(name));
  }

  async #counted<T>(work: Promise<T>): Promise<T> {
    this.#pending += 1;
    try {
      return await work;
    } finally {
      this.#pending -= 1;
    }
  }

  #configure(): void {
    const { session } = this;
    if (!session.database) return;
    session.playback.options = engineOptions(this.#store.state, session.database.neutral);
    session.analyseSoon();
  }

  /** Drops styles that the database does not have, and selects some if none is left. */
  #completeStyles(database: DatabaseInfo): void {
    const first = firstSelection(database.styles, database.neutral);
    const renamed = withRenamedStyles(this.#store.state, this.databases.renamed);
    const state = { ...this.#store.state, ...renamed };
    const styles = withKnownStyles(state, database.styles, first);
    const labels = withKnownLabels(state, database.classes);
    if (this.databases.renamed.size > 0 || styles || labels) this.#store.adopt({ ...renamed, ...styles, ...labels });
  }

  async #followDatabase(inputName: string): Promise<void> {
    await this.databases.follow(inputName);
    if (!this.databases.moving) this.#settleInput();
  }

  /** Opens the input that undo, redo or a link brought. If that fails, the state returns to the open input. */
  async #followInput(wanted: string): Promise<void> {
    const { session } = this;
    const name = wanted || session.library.first;
    // An input being read or opened instead must not replace it afterwards.
    const { reading } = this.#store.state;
    const reread = !sameReading(reading, session.reading);
    if (name === session.chosen && !reread && !this.#progress.input.busy) return;
    if (!session.library.has(name)) {
      const removed = this.#removed.get(name);
      if (removed) await session.library.bringBack(removed);
      else await this.databases.complete;
    }
    if (this.#store.state.input !== wanted) return;
    if (name === session.chosen && reread) {
      // Undo and redo are also choices of the user.
      if ((await session.readAs(reading)) === "done") this.#rememberReading();
    } else if (session.library.has(name)) await session.openInput(name, reading);
    if (this.#store.state.input === wanted) this.#settleInput();
  }

  /** Stores the reading of the open file for other files with its skeleton. */
  #rememberReading(): void {
    const { reading } = this.session.input ?? {};
    if (reading) this.#readings.keep(reading.skeleton.id, reading.said);
  }

  /** Writes the open input to the state, and reports a missing file if the state named another one. */
  #settleInput(): void {
    const { input: wanted, frame, reading } = this.#store.state;
    const { session } = this;
    if (!session.input) return;
    if (wanted === this.#openInput || wanted === session.chosen) {
      this.#store.adopt({ reading: session.reading });
      return;
    }
    // A link never connects without consent.
    if (isLive(wanted)) session.askForLive(wanted);
    else if (!session.library.has(wanted)) {
      this.#awaited = { input: wanted, frame };
      if (!saysNothing(reading)) session.library.say(wanted, reading);
      this.#toasts.note(strings.page.links.fileMissing(wanted));
    }
    this.#store.adopt({ input: this.#openInput, reading: session.reading });
  }

  /** Another input starts at its beginning, also while paused, and is played whole. */
  get #beginning(): Partial<AppState> {
    return { range: undefined, ...(this.#store.state.playing ? {} : { frame: 0 }) };
  }

  /** The open input, as named in the state. */
  get #openInput(): string {
    const { library, chosen } = this.session;
    return chosen === library.first ? "" : chosen;
  }

  /** Adds the file in a link to the library, with the link's reading. Returns its name there. */
  async #carriedInput(hash: string, reading: FileReading): Promise<string | undefined> {
    const file = await linkedFile(hash);
    if (!file) return undefined;
    const name = await this.session.library.add(file.name, file.bytes);
    // Also if the reading is empty: a link shows the same for everyone.
    this.session.library.say(name, reading);
    return name;
  }
}

/** Whether an error means that a file cannot be used. */
const isOfFile = (error: unknown): boolean => error instanceof StrutError && error.code === "bad-file";

/** Settles as `work` does, or rejects when the signal aborts: reading a file cannot be cancelled. */
function unlessAborted<T>(work: Promise<T>, signal: AbortSignal | undefined): Promise<T> {
  return new Promise((resolve, reject) => {
    signal?.addEventListener("abort", () => reject(cancelled()), { once: true });
    work.then(resolve, reject);
  });
}
