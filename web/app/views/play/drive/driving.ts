/** Driving in Play: passes the input devices' steering to the engine, and the result to the stage and the panels. */

import "./drive.css";
import type { DriveControl, DriveFrame, DriveInfo, Move } from "../../../../client/drive/protocol";
import { button } from "../../../../ui/controls/buttons";
import { clock, html, setAttributes, setText } from "../../../../ui/dom";
import { VIEWER_DEFAULTS, type Viewer } from "../../../../viewer";
import { Course } from "../../../../viewer/drive/course";
import { announce } from "../../../ui/announce";
import type { ViewerLease, ViewHost } from "../../../view";
import { DriveChart } from "./chart";
import { GamepadInput, type PadAction } from "./gamepad";
import { HeadingTool } from "./heading_tool";
import { type Device, HelpLine } from "./help_line";
import { keep } from "./keep";
import { Keyboard } from "./keyboard";
import { DrivePanel } from "./panel";
import { distanceTo, PathTool } from "./path_tool";
import { driveWords } from "./strings.en";
import { TouchStick } from "./touch_stick";
import { headingOf, overGround, type Wish } from "./wish";

/** Turn of a press of Q or E, radians. */
const TURN = Math.PI / 4;
/** Below this speed the character counts as standing, m/s: the arrow turns it on the spot. */
const STANDING = 0.3;
const NO_PATH = new Float32Array();

/** Elements of Play that contain the elements of driving. */
interface DrivePlaces {
  /** The layer over the picture. */
  readonly stage: HTMLElement;
  /** The element of the picture that receives touches. */
  readonly picture: HTMLElement;
  /** The buttons of the picture. */
  readonly controls: HTMLElement;
  /** The panel of the input, after which that of driving is inserted. */
  readonly input: HTMLElement;
  /** The transport. */
  readonly transport: HTMLElement;
}

/** Actions of Play with keys in driving. */
interface DriveActions {
  pause(): void;
  /** Selects the next style alone, or the previous one. */
  corner(by: -1 | 1): void;
  /** Moves the point of the polygon. */
  movePoint(key: "ArrowUp" | "ArrowDown" | "ArrowLeft" | "ArrowRight"): void;
}

export class Driving {
  readonly #host: ViewHost;
  readonly #info: DriveInfo;
  readonly #actions: DriveActions;
  readonly #listening = new AbortController();
  readonly #keyboard: Keyboard;
  readonly #pad: GamepadInput;
  readonly #heading: HeadingTool;
  readonly #stick: TouchStick;
  readonly #path: PathTool;
  readonly #help: HelpLine;
  readonly #panel: DrivePanel;
  readonly #chart: DriveChart;
  readonly #course = new Course();
  readonly #draw: HTMLButtonElement;
  readonly #time = html("span", { class: "clock" });
  readonly #elements: HTMLElement[];
  #lease: ViewerLease | undefined;
  #frame: DriveFrame | undefined;
  /** Heading that the character keeps while it stands. */
  #face: number | undefined;
  /** The path being followed, and whether the engine has it. */
  #line = NO_PATH;
  #isNew = false;
  #move: Move | undefined;
  #used = false;
  /** Whether another window has the focus, which then uses the gamepad. */
  #away = false;
  #isViewed = false;
  #asked: DriveControl = { move: [0, 0], gait: 1 };

  constructor(host: ViewHost, info: DriveInfo, places: DrivePlaces, actions: DriveActions) {
    this.#host = host;
    this.#info = info;
    this.#actions = actions;
    const { signal } = this.#listening;
    this.#keyboard = new Keyboard(
      () => this.#presses(),
      host.singleKeys,
      () => this.#use("keyboard"),
      signal,
    );
    this.#pad = new GamepadInput(
      (action) => this.#act(action),
      (glyphs) => this.#use(glyphs),
    );
    // Created before the stick and the path tool, so that it can claim presses on the arrow.
    this.#heading = new HeadingTool(
      places.picture,
      {
        ...this.#ground(),
        arrow: () => this.#arrowOnPage(),
        onTurn: (heading) => {
          this.#face = heading;
          this.#use("arrow");
        },
      },
      signal,
    );
    this.#stick = new TouchStick(
      places.picture,
      () => !this.#path.draws && !this.#path.isDrawing,
      () => this.#use("touch"),
      signal,
    );
    this.#path = new PathTool(places.picture, this.#ground(), signal);
    addEventListener("blur", () => this.#leave(), { signal });
    for (const type of ["focus", "keydown", "pointerdown"]) addEventListener(type, () => this.#return(), { signal });
    this.#help = new HelpLine(info.moves, matchMedia("(pointer: coarse)").matches ? "touch" : "keyboard");
    this.#panel = new DrivePanel(info, host.session.database?.neutral ?? "", (on) => {
      this.#keyboard.latches = on;
    });
    this.#chart = new DriveChart(info);
    this.#draw = button(driveWords.drawPath, () => this.#toggleDrawing(), { icon: "path", label: true, class: "chip" });
    setAttributes(this.#draw, { title: driveWords.drawPathWhy, "aria-pressed": "false" });
    const moves = html("div", { class: "drive-moves" }, ...info.moves.map((move) => this.#moveButton(move)));
    const kept = button(driveWords.keep, () => void this.keep(), { icon: "record", label: true, class: "outlined" });
    kept.append(html("kbd", {}, "M"));
    const bar = html(
      "div",
      { class: "drive-bar" },
      kept,
      html("p", { class: "time" }, this.#time, html("span", { class: "caption" }, driveWords.driven)),
    );
    places.stage.append(this.#help.element, this.#stick.element, moves);
    places.controls.append(this.#draw);
    places.input.after(this.#panel.element);
    places.transport.append(bar, this.#chart.element);
    this.#elements = [
      this.#help.element,
      this.#stick.element,
      moves,
      this.#draw,
      this.#panel.element,
      bar,
      this.#chart.element,
    ];
    host.session.steer = () => this.#steer();
  }

  /** Sets the 3-D viewer; `undefined` returns it. */
  set lease(lease: ViewerLease | undefined) {
    const viewer = this.#lease?.viewer;
    if (viewer) {
      void viewer.setProp(undefined);
      viewer.ghostByCamera = false;
      viewer.labels = VIEWER_DEFAULTS.labels;
    }
    this.#lease = lease;
    this.#keyboard.stop();
    if (!lease) return;
    lease.viewer.ghostByCamera = true;
    lease.viewer.labels = { ...VIEWER_DEFAULTS.labels, input: driveWords.neutral };
    this.#view(lease.viewer);
    void lease.viewer.setProp(this.#course).then(lease.invalidate);
  }

  /** Moves behind the character once, to a view of the ground ahead, unless another view was chosen. */
  #view(viewer: Viewer): void {
    if (this.#isViewed || this.#host.store.state.camera !== "orbit") return;
    this.#isViewed = true;
    viewer.cameraBehind();
  }

  /** Shows a frame of the engine. */
  show(frame: DriveFrame): void {
    const before = this.#frame;
    this.#frame = frame;
    if (frame.move && frame.move !== before?.move) announce(driveWords.help.moves[frame.move]);
    this.#chart.take(this.#asked, frame);
    this.#panel.show(frame, () => (this.#line.length > 0 ? distanceTo(this.#line, this.#place()) : undefined));
    setText(this.#time, clock(frame.inputFrame / (this.#host.session.database?.rateHz ?? 60)));
    if (this.#line.length > 0 && !this.#isNew) {
      if (frame.progress === undefined && before?.progress !== undefined) {
        announce(driveWords.arrived);
        this.#setLine(NO_PATH);
      } else this.#course.progress = frame.progress ?? 0;
    }
    this.#mark(frame);
  }

  /** Makes the recording an input, with the styles in which it was displayed. */
  async keep(): Promise<boolean> {
    return keep(this.#host);
  }

  /** Applies the colours of another theme. */
  recolour(): void {
    this.#chart.recolour();
  }

  dispose(): void {
    this.#listening.abort();
    this.lease = undefined;
    this.#course.dispose();
    for (const element of this.#elements) element.remove();
  }

  // --- steering ---

  #steer(): DriveControl {
    this.#asked = this.#ask();
    return this.#asked;
  }

  #ask(): DriveControl {
    const pad = this.#away ? undefined : this.#pad.read();
    const wish = this.#keyboard.wish ?? this.#stick.wish ?? pad;
    const action = this.#move;
    this.#move = undefined;
    const path = this.#isNew ? { path: this.#line } : wish && this.#line.length > 0 ? { path: NO_PATH } : {};
    this.#isNew = false;
    if ("path" in path && path.path.length === 0) this.#setLine(NO_PATH);
    const control = wish ? this.#going(wish) : { move: [0, 0] as const, gait: 1, ...this.#facing() };
    return { ...control, ...path, ...(action && { action }) };
  }

  /** Converts the devices' input to steering over the ground. */
  #going(wish: Wish): DriveControl {
    const [x, z] = overGround(wish, this.#lease?.viewer.lineOfSight ?? [0, 0, 1]);
    this.#face = wish.turns ? headingOf(x, z) : undefined;
    return wish.turns ? { move: [0, 0], gait: 1, ...this.#facing() } : { move: [x, z], gait: wish.gait };
  }

  #facing(): { face?: number } {
    return this.#face === undefined ? {} : { face: this.#face };
  }

  #turn(by: number): void {
    this.#face = (this.#face ?? this.#frame?.root[2] ?? 0) + by;
  }

  #presses(): Record<string, () => void> {
    const ofMove = (code: string, move: Move) =>
      this.#info.moves.includes(move) ? { [code]: () => this.#begin(move) } : {};
    return {
      KeyQ: () => this.#turn(TURN),
      KeyE: () => this.#turn(-TURN),
      KeyP: () => this.#actions.pause(),
      KeyM: () => void this.keep(),
      KeyB: () => this.#toggleDrawing(),
      ...ofMove("Space", "jump"),
      ...ofMove("KeyC", "punch"),
      ...ofMove("KeyV", "kick"),
    };
  }

  #act(action: PadAction): void {
    const act: Record<PadAction, () => void> = {
      jump: () => this.#begin("jump"),
      punch: () => this.#begin("punch"),
      kick: () => this.#begin("kick"),
      previousCorner: () => this.#actions.corner(-1),
      nextCorner: () => this.#actions.corner(1),
      keep: () => void this.keep(),
      pause: () => this.#actions.pause(),
      pointUp: () => this.#actions.movePoint("ArrowUp"),
      pointDown: () => this.#actions.movePoint("ArrowDown"),
      pointLeft: () => this.#actions.movePoint("ArrowLeft"),
      pointRight: () => this.#actions.movePoint("ArrowRight"),
    };
    act[action]();
  }

  #leave(): void {
    this.#away = true;
    this.#stick.stop();
  }

  #return(): void {
    this.#away = false;
  }

  #begin(move: Move): void {
    if (this.#info.moves.includes(move)) this.#move = move;
  }

  /** Records the use of a device, or of the arrow, which belongs to none. */
  #use(device: Device | "arrow"): void {
    if (device !== "arrow") this.#help.device = device;
    if (this.#used) return;
    this.#used = true;
    // On a small screen the help covers the ground; elsewhere it stays until ? hides it.
    if (device === "touch") this.#help.isShown = false;
  }

  /** Shows the line that explains the controls, or hides it. */
  toggleHelp(): void {
    this.#help.isShown = !this.#help.isShown;
  }

  // --- the path ---

  #ground() {
    return {
      groundAt: (clientX: number, clientY: number) =>
        this.#onPicture(clientX, clientY, (viewer, x, y) => viewer.groundAt(x, y)),
      isBody: (clientX: number, clientY: number) =>
        this.#onPicture(clientX, clientY, (viewer, x, y) => viewer.jointAt(x, y)) !== undefined,
      place: () => this.#place(),
      sketch: (points: Float32Array<ArrayBuffer>) => {
        this.#course.line = points;
        this.#lease?.invalidate();
      },
      onPath: (points: Float32Array<ArrayBuffer>) => this.#follow(points),
    };
  }

  #onPicture<T>(clientX: number, clientY: number, of: (viewer: Viewer, x: number, y: number) => T): T | undefined {
    if (!this.#lease) return undefined;
    const { left, top } = this.#lease.element.getBoundingClientRect();
    return of(this.#lease.viewer, clientX - left, clientY - top);
  }

  /** Points in the page at which the arrow that turns the character can be grabbed. */
  #arrowOnPage() {
    if (!this.#lease || this.#path.draws) return [];
    const { element, viewer } = this.#lease;
    const { left, top } = element.getBoundingClientRect();
    return this.#course.arrow.map((at) => {
      const { x, y } = viewer.screenPosition(at.x, 0, at.z);
      return { x: left + x, y: top + y };
    });
  }

  /** Position of the styled character. */
  #place() {
    const pose = this.#frame?.pose;
    return { x: pose?.[0] ?? 0, z: pose?.[2] ?? 0 };
  }

  #follow(points: Float32Array<ArrayBuffer>): void {
    this.#setLine(points);
    this.#isNew = points.length > 0;
    this.#face = undefined;
    this.#keyboard.stop();
    if (this.#path.draws) this.#toggleDrawing();
    announce(driveWords.follows);
    this.#used = true;
    this.#help.isShown = false;
  }

  #setLine(points: Float32Array<ArrayBuffer>): void {
    this.#line = points;
    this.#course.line = points;
    this.#lease?.invalidate();
  }

  #toggleDrawing(): void {
    this.#path.draws = !this.#path.draws;
    setAttributes(this.#draw, { "aria-pressed": String(this.#path.draws) });
    this.#lease?.element.classList.toggle("draws", this.#path.draws);
  }

  /** Marks the next second at the styled character, whose position differs from the neutral one's. */
  #mark({ root, asked, ahead, speed }: DriveFrame): void {
    const { x, z } = this.#place();
    const [dx, dz] = [x - root[0], z - root[1]];
    const moved = (places: Float32Array) => places.map((value, i) => value + [dx, dz, 0][i % 3]!);
    this.#course.show(moved(asked), moved(ahead), x, z);
    const stands = speed < STANDING && this.#line.length === 0;
    this.#course.face(x, z, root[2], stands || this.#heading.isDragged);
  }

  #moveButton(move: Move): HTMLButtonElement {
    return button(driveWords.help.moves[move], () => this.#begin(move), { label: true, class: "drive-move" });
  }
}
