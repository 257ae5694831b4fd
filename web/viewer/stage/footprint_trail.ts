/**
 * Bookkeeping of footprints: a ring buffer of prints, without any drawing.
 *
 * A print begins when a foot is planted. While it stays planted, the print moves to the place where the sole has been
 * flattest so far, since the foot lands on its heel and leaves from its toes. Every further step of either foot ages
 * it.
 */

/** Steps after which a print has faded. */
export const FADE_STEPS = 4;
/** Prints that are kept. */
export const MAX_PRINTS = 8;

/** Position and orientation of a sole. */
export interface Sole {
  /** The ground point below the ankle, metres. */
  x: number;
  z: number;
  /** Direction of the foot about +Y, radians, 0 to +Z. */
  heading: number;
  /** Angle of the foot from flat on the ground, radians; 0 is flat. */
  tilt: number;
}

/** One print. */
interface Footprint extends Sole {
  side: 0 | 1;
  /** Whether its foot is still planted on it. */
  planted: boolean;
  /** Number of steps since. */
  age: number;
}

/** The prints of one character. */
export class FootprintTrail {
  readonly #prints: Footprint[] = [];
  readonly #planted = [false, false];

  /** The prints, oldest first. */
  get prints(): readonly Footprint[] {
    return this.#prints;
  }

  /** Updates the trail with the state of both feet (left, right) in the current frame. */
  update(planted: readonly [boolean, boolean], soles: readonly [Sole, Sole]): void {
    for (const side of [0, 1] as const) {
      if (planted[side] && !this.#planted[side]) this.#begin(side, soles[side]);
      const print = this.#prints.findLast((p) => p.side === side && p.planted);
      if (print && !planted[side]) print.planted = false;
      if (print && planted[side] && soles[side].tilt <= print.tilt) Object.assign(print, soles[side]);
      this.#planted[side] = planted[side];
    }
  }

  /** Removes all prints, as after a jump. */
  clear(): void {
    this.#prints.length = 0;
    this.#planted.fill(false);
  }

  #begin(side: 0 | 1, sole: Sole): void {
    for (const print of this.#prints) print.age++;
    while (this.#prints.length && (this.#prints[0]!.age > FADE_STEPS || this.#prints.length >= MAX_PRINTS))
      this.#prints.shift();
    this.#prints.push({ ...sole, side, planted: true, age: 0 });
  }
}
