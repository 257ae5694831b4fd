/** Texts of figures; `languages.ts` has them in each language, and each group of kinds has a table of its own. */
import type { Role } from "../../humanoid";
import { formatNumber as plain } from "../../ui/dom";
import type { InputName, Style } from "../built_in";
import type { BiasWords } from "./bias";
import type { ChainWords } from "./chain";
import type { FeetWords } from "./feet";
import type { JudgeWords } from "./judge";
import type { LineWords, SweepWords } from "./line";
import type { MapWords } from "./map";
import type { MixWords } from "./mix";
import type { NearWords } from "./near";
import type { PaceWords } from "./pace";
import type { PoseWords } from "./pose";
import type { WarpWords } from "./warp";

/** Texts of figures in a language. */
export interface Words {
  /** The decimal sign. */
  decimal: string;
  /** The field for a number. */
  number: string;
  loading: string;
  table: string;
  play: string;
  pause: string;
  noGraphics: string;
  failed: (why: string) => string;
  retry: string;
  unknown: (kind: string) => string;
  styles: Record<Style, string>;
  inputs: Record<InputName, string>;
  joints: Record<Role, string>;
  style: string;
  pairing: string;
  second: string;
  content: string;
  joint: string;
  allJoints: string;
  playhead: string;
  time: string;
  difference: string;
  distance: (joint: string) => string;
  legend: (pairing: string, now: string, mean: string) => string;
  two: string;
  ended: string;
  times: (input: string, style: string, styled: string) => string;
  pictured: (style: string, time: string, pairing: string, e: string, most: string, cm: string) => string;
  chain: ChainWords;
  feet: FeetWords;
  judge: JudgeWords;
  line: LineWords;
  bias: BiasWords;
  sweep: SweepWords;
  map: MapWords;
  mix: MixWords;
  warp: WarpWords;
  near: NearWords;
  pose: PoseWords;
  pace: PaceWords;
  curved: (style: string, time: string, content: string, second: string, mean: string, meanSecond: string) => string;
}

/** A number in a language. */
export function formatNumber(value: number, digits: number, { decimal }: Pick<Words, "decimal">): string {
  return Number.isFinite(value) ? plain(value, digits).replace(".", decimal) : "–";
}
