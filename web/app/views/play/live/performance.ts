/** A live performance in Play: passes the performer's poses to the engine, and the state of the stream to the panel. */
import "./live.css";
import type { StreamFrame } from "../../../../client/live/protocol";
import { Recording } from "../../../../client/server/recording";
import { bvhText } from "../../../../formats/bvh";
import { engineOptions } from "../../../../link/engine_options";
import type { LivePerformer } from "../../../../player/session";
import type { PoseSink } from "../../../../streams/pose_source";
import { addressOf, type SocketState, webSocketPoses } from "../../../../streams/web_socket_poses";
import { button } from "../../../../ui/controls/buttons";
import { clock, html, setText } from "../../../../ui/dom";
import { announce } from "../../../ui/announce";
import type { ViewHost } from "../../../view";
import { keepMotion } from "../kept";
import { askForSource } from "./live_dialog";
import { addressIn, type LiveAddress, nameOf } from "./live_name";
import { LivePanel } from "./live_panel";
import { liveWords } from "./strings.en";

/** Time between updates of the panel, milliseconds. */
const SHOW_MS = 250;
/** After this time without messages, a connected sender counts as silent, milliseconds. */
const SILENT_MS = 1000;
/** Longest recording, seconds. */
const MAX_KEPT_SECS = 300;

/** Elements of Play that contain the elements of a live performance. */
interface LivePlaces {
  /** The panel of the input, after which the performer's is inserted. */
  readonly input: HTMLElement;
  readonly transport: HTMLElement;
}

/** Asks for a sender, with that of a name as the default, and connects to it. Returns whether a performance has started. */
export async function askForPerformer(host: ViewHost, name: string): Promise<boolean> {
  const chosen = await askForSource(addressIn(name));
  return chosen !== undefined && connect(host, nameOf(chosen));
}

async function connect({ session, store }: ViewHost, name: string): Promise<boolean> {
  const opened = await session.openLive(name, undefined);
  if (opened) store.edit({ input: name, playing: true });
  return opened !== undefined;
}

export class Performance {
  readonly #host: ViewHost;
  readonly #performer: LivePerformer;
  readonly #address: LiveAddress;
  /** Names of the database's styles, its neutral style and its frame rate. */
  readonly #styles: readonly string[];
  readonly #neutral: string;
  readonly #rateHz: number;
  readonly #ending = new AbortController();
  readonly #panel: LivePanel;
  readonly #time = html("span", { class: "clock" });
  readonly #elements: HTMLElement[];
  readonly #recording: Recording;
  readonly #showing: ReturnType<typeof setInterval>;
  #state: SocketState = { kind: "connecting" };
  /** Time of the next connection attempt, milliseconds. */
  #againAt = 0;
  /** Number of messages that could not be read. */
  #unread = 0;
  /** Number of accepted frames, and when the last new one was seen, milliseconds. */
  #taken = 0;
  #heardAt = 0;

  constructor(host: ViewHost, performer: LivePerformer, places: LivePlaces) {
    this.#host = host;
    this.#performer = performer;
    this.#address = addressIn(performer.name);
    const { info } = performer.stream.database;
    [this.#styles, this.#neutral, this.#rateHz] = [info.styles, info.neutral, info.rateHz];
    this.#recording = new Recording(info.styles);
    const sender = addressOf(this.#address.url).host;
    this.#panel = new LivePanel(sender, () => void askForPerformer(host, performer.name));
    const kept = button(liveWords.keep, () => void this.keep(), { icon: "record", label: true, class: "outlined" });
    const received = html("span", { class: "caption" }, liveWords.received);
    const bar = html("div", { class: "live-bar" }, kept, html("p", { class: "time" }, this.#time, received));
    places.input.after(this.#panel.element);
    places.transport.append(bar, this.#panel.figures);
    this.#elements = [this.#panel.element, bar, this.#panel.figures];
    performer.stream.onFrame = (frame) => this.#take(frame);
    this.#showing = setInterval(() => this.#show(), SHOW_MS);
    this.#show();
    void this.#perform(sender);
  }

  /** Makes the received motion an input, with the styles in which it was displayed. */
  keep(): Promise<boolean> {
    const frames = Math.min(this.#recording.frames, MAX_KEPT_SECS * this.#rateHz);
    const { proportions, rateHz } = this.#performer.stream.database.info;
    const poses = this.#recording.last(frames);
    const bvh = frames > 0 ? bvhText({ proportions, rateHz, poses }) : "";
    const made = { frames, bvh, poses, track: this.#recording.track(frames) };
    const { name } = this.#performer;
    return keepMotion(this.#host, made, liveWords, () => void connect(this.#host, name));
  }

  dispose(): void {
    this.#ending.abort();
    clearInterval(this.#showing);
    this.#performer.stream.onFrame = undefined;
    for (const element of this.#elements) element.remove();
  }

  async #perform(sender: string): Promise<void> {
    const { url, format } = this.#address;
    const onState = (state: SocketState) => {
      this.#state = state;
      if (state.kind === "open") {
        announce(liveWords.connected(sender));
        this.#heardAt = performance.now();
        this.#panel.fault = "";
      } else if (state.kind === "waiting") this.#againAt = performance.now() + 1000 * state.secs;
      this.#show();
    };
    const onRefused = (count: number) => {
      this.#unread = count;
    };
    const source = webSocketPoses(url, { format, onState, onRefused });
    await source.start(this.#sink(), this.#ending.signal).catch((thrown) => this.#fail(thrown));
  }

  #sink(): PoseSink {
    const { stream } = this.#performer;
    const unlessEnded = (take: () => void) => {
      if (!this.#isOpen) return;
      try {
        take();
      } catch (thrown) {
        this.#fail(thrown);
      }
    };
    return {
      skeleton: (skeleton) =>
        unlessEnded(() => {
          stream.skeleton = skeleton;
        }),
      frame: (secs, pose) => unlessEnded(() => stream.push(secs, pose)),
      lost: (why) => {
        this.#panel.fault = why;
      },
    };
  }

  /** Whether the stream is open: it ends with its database. */
  get #isOpen(): boolean {
    return !this.#ending.signal.aborted && this.#host.session.live === this.#performer;
  }

  #fail(thrown: unknown): void {
    this.#panel.fault = (thrown as Error).message;
  }

  #take({ inputPose }: StreamFrame): void {
    const { styles } = engineOptions(this.#host.store.state, this.#neutral);
    const weights = this.#styles.map((name) => styles[name] ?? 0);
    this.#recording.add(inputPose, Float32Array.from(weights));
  }

  #show(): void {
    if (!this.#isOpen) return;
    const { stats } = this.#performer.stream;
    const now = performance.now();
    if (stats.taken !== this.#taken) [this.#taken, this.#heardAt] = [stats.taken, now];
    const waitSecs = Math.max(0, Math.ceil((this.#againAt - now) / 1000));
    this.#panel.showState(this.#state, waitSecs, now - this.#heardAt > SILENT_MS);
    this.#panel.show(stats, this.#unread);
    setText(this.#time, clock(stats.frames / this.#rateHz));
  }
}
