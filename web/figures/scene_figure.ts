/** The base of figures that are 3-D pictures. */
import { setText } from "../ui/dom";
import type { Viewer, ViewerOptions } from "../viewer";
import { FigureStage } from "./figure_stage";
import type { FigureParts } from "./kind";
import { LiveFigure } from "./live_figure";

export abstract class SceneFigure<State extends object, Shown> extends LiveFigure<State, Shown> {
  readonly stage: FigureStage;
  /** The data of the last poses. */
  #posed: Shown | undefined;

  constructor(parts: FigureParts<State>, options: Omit<ViewerOptions, "screen">) {
    super(parts);
    this.stage = new FigureStage(parts.words, options, {
      advance: (dtSecs) => this.advance(dtSecs),
      drawn: () => this.placeMarks(),
    });
  }

  /** Poses the bodies. @param before the previous data */
  protected abstract pose(viewer: Viewer, shown: Shown, state: State, before: Shown | undefined): void;

  /** The text below the picture: by default the sentence. */
  protected read(shown: Shown, state: State): string {
    return this.describe(shown, state);
  }

  /** Called while the picture is visible. */
  protected advance(_dtSecs: number): void {}

  /** Moves the marks to the joints of the drawn picture. */
  protected placeMarks(): void {}

  protected redraw(): void {
    const { shown, state } = this;
    if (!shown || !state) return;
    const { viewer } = this.stage;
    if (viewer) {
      this.pose(viewer, shown, state, this.#posed);
      viewer.description = this.sentence();
    }
    this.#posed = shown;
    setText(this.readout, this.read(shown, state));
    this.stage.invalidate();
    this.parts.changed();
  }
}
