/** Texts of the figures of feet. */

export interface FeetWords {
  /** Titles of the plot, the soles and the leg. */
  title: string;
  soles: string;
  leg: string;
  foot: string;
  sides: Record<"left" | "right", string>;
  hold: string;
  ankle: string;
  /** Axes. */
  time: string;
  speed: string;
  likelihood: string;
  across: string;
  along: string;
  forwards: string;
  upwards: string;
  read: (speed: string, likelihood: string) => string;
  slid: (cm: string) => string;
  reached: (d: string, gamma: string) => string;
  said: (time: string, foot: string, stands: boolean, speed: string, held: boolean) => string;
  seen: (foot: string, cm: string, held: boolean) => string;
  bent: (d: string, gamma: string, bend: string) => string;
  /** Headers of the tables. */
  columns: readonly [string, string, string];
  places: readonly [string, string, string];
  parts: readonly [string, string];
  /** Rows of the leg's table. */
  rows: Readonly<Record<"a" | "b" | "d" | "gamma", string>>;
}
