/** The base of figures that are plots. */
import type { Extent } from "../ui/scale";
import type { Axes, AxesShape } from "./axes";
import { Handle } from "./handle";
import type { FigureParts } from "./kind";
import { LiveFigure, type NamesOf } from "./live_figure";
import { type Labels, PlotFrame } from "./plot_frame";

/** The handle of a frame. */
interface PlayheadOptions {
  /** The step of an arrow key, frames; with Shift one frame. */
  step: number;
  /** Frames per unit of the horizontal axis. */
  rate: () => number;
  /** The first and the last frame. */
  ends: () => readonly [first: number, last: number];
  /** By default the instant's. */
  term?: string;
}

export abstract class PlotFigure<State extends object, Shown> extends LiveFigure<State, Shown> {
  protected readonly frame: PlotFrame;
  /** The axes of the last picture. */
  protected axes: Axes | undefined;

  constructor(parts: FigureParts<State>, title: string) {
    super(parts);
    const draw = () => {
      if (this.state && this.shown) this.draw(this.shown, this.state);
    };
    this.frame = new PlotFrame(title, parts.words, draw, parts.signal);
  }

  /** Draws into the frame. */
  protected abstract draw(shown: Shown, state: State): void;

  protected redraw(): void {
    this.parts.changed();
    this.frame.request();
  }

  /** Axes of the whole picture, with their grid. */
  protected plot(across: Extent, up: Extent, labels: Labels, shape?: AxesShape): Axes {
    this.axes = this.frame.axes(across, up, shape);
    this.frame.drawGrid(this.axes, labels);
    return this.axes;
  }

  /** A handle for the examined frame, a member of the state. */
  protected playhead(name: NamesOf<State, number>, { step, rate, ends, term = "i" }: PlayheadOptions): Handle {
    const at = () => Math.min(this.state![name] as number, ends()[1]);
    return new Handle(
      this.words.playhead,
      term,
      this.frame.picture,
      {
        value: () => (this.axes && this.shown && this.state ? at() : undefined),
        valueOf: (x) => this.axes!.valueAtX(x) * rate(),
        stepped: (frame, direction, fine) => frame + direction * (fine ? 1 : step),
        ends,
        onInput: (frame) => this.set(name, Math.round(frame), false),
        onSettle: () => this.settle(),
      },
      this.parts.signal,
    );
  }
}
