/** The state of figures about the evaluation of methods. */
import type { LearnInput } from "../../client/learn/protocol";
import { ROLES, type Role } from "../../humanoid";
import { choice, type Fields, flag, number } from "../../link/fields";
import { STYLES, type Style } from "../built_in";
import { AXES, type Axis } from "../line/line_state";

/** Takes of the built-in database that can be held out. */
export const TAKES = ["walk-pace", "walk-turns", "run-loop"] as const;
export type Take = (typeof TAKES)[number];

/** Methods, the simplest first. */
export const METHODS = ["nn", "knn", "lar", "mar", "gar", "lti", "gp"] as const;
export type Method = (typeof METHODS)[number];

/** Source of the methods' figures: this take, or recorded results on other data. */
export const SOURCES = ["live", "inside", "off"] as const;
export type Source = (typeof SOURCES)[number];

/** Which of two numbers the learner considers honest. */
export const HONEST = ["", "out", "in"] as const;
export type Honest = (typeof HONEST)[number];

/** The take, the methods, and the examined instant. */
export interface JudgeState {
  take: Take;
  style: Style;
  /** Frame of the take. */
  at: number;
  /** Whether the take is left in the database. */
  leftIn: boolean;
  honest: Honest;
  source: Source;
  /** The selected method, and the one with which it is compared. */
  pick: Method;
  rival: Method;
  /** Frames at which the learner says that one or the other is better; negative if not set. */
  pickPin: number;
  rivalPin: number;
  /** The degree of freedom whose corrections are counted. */
  joint: Role;
  axis: Axis;
}

const PIN = { min: -1, max: 5000, digits: 0 };

/** Encoding of the state in a link. */
export const JUDGE_FIELDS: Fields<JudgeState> = {
  take: choice("motion", "walk-pace", TAKES, true),
  style: choice("style", "old", STYLES, true),
  at: number("i", 160, { min: 0, max: 5000, digits: 0 }, true),
  leftIn: flag("left", false, true),
  honest: choice("honest", "", HONEST, true),
  source: choice("source", "live", SOURCES, true),
  pick: choice("pick", "mar", METHODS, true),
  rival: choice("rival", "knn", METHODS, true),
  pickPin: number("pin", -1, PIN, true),
  rivalPin: number("pin2", -1, PIN, true),
  joint: choice("joint", "left_lower_leg", ROLES, true),
  axis: choice("axis", "x", AXES, true),
};

/** The input of a state: its take, which is in the database or left out. */
export function inputOf({ take, leftIn }: Pick<JudgeState, "take" | "leftIn">): LearnInput {
  return { name: take, without: leftIn ? [] : [take] };
}
