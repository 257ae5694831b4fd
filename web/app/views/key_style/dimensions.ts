/**
 * Dimension lines of measures next to the body, as in a technical drawing: the end points of each one in the world.
 * Pure geometry of the joints.
 */

import { JOINT, type Role, type WorldPose } from "../../../humanoid";
import type { Axis } from "../../state/key_style";

export type Point = readonly [x: number, y: number, z: number];

/** A dimension: the measured line, and thinner extension lines from the body. */
interface Dimension {
  line: readonly [Point, Point];
  leaders: readonly (readonly [Point, Point])[];
  /** Whether its text is below it. */
  below?: boolean;
}

/** Distance between the body and the line, metres. */
const ASIDE = 0.3;
const ABOVE = 0.16;

/** The dimension of a measure, by its name, on a body that faces +Z; `undefined` for a measure without a drawing. */
export function dimensionOf(axis: Axis, joints: WorldPose, onScreenLeft: Point): Dimension | undefined {
  const at = (role: Role): Point => {
    const [x, y, z] = joints.positions.subarray(3 * JOINT[role], 3 * JOINT[role] + 3);
    return [x!, y!, z!];
  };
  /** A point moved forwards to another one's depth, at another height. */
  const abreast = (point: Point, other: Point, y: number): Point => [point[0], y, other[2]];
  /** Heights are drawn next to the body, on a given side of the picture. */
  const aside = (point: Point, y: number, by: number): Point => [
    point[0] - by * onScreenLeft[0],
    y,
    point[2] - by * onScreenLeft[2],
  ];
  const height = (role: Role): Dimension => {
    const point = at(role);
    const [top, bottom] = [aside(point, point[1], ASIDE), aside(point, 0, ASIDE)];
    return { line: [bottom, top], leaders: [[point, top]] };
  };
  const reach = (side: "left" | "right"): Dimension => {
    const [shoulder, hand, head] = [at(`${side}_upper_arm`), at(`${side}_hand`), at("head")];
    const y = Math.max(head[1] + 0.2, hand[1] + ABOVE, shoulder[1] + ABOVE);
    const [from, to] = [abreast(shoulder, shoulder, y), abreast(shoulder, hand, y)];
    return { line: [from, to], leaders: [[to, hand]] };
  };
  switch (axis) {
    case "hips_height":
      return height("hips");
    case "hand_height_left":
      return height("left_hand");
    case "hand_height_right":
      return height("right_hand");
    case "reach_left":
      return reach("left");
    case "reach_right":
      return reach("right");
    case "foot_separation": {
      const [left, right] = [at("left_foot"), at("right_foot")];
      const middle: Point = [(left[0] + right[0]) / 2, 0, (left[2] + right[2]) / 2];
      const [from, to] = [abreast(middle, right, 0.01), abreast(middle, left, 0.01)];
      return {
        line: [from, to],
        leaders: [
          [right, from],
          [left, to],
        ],
        below: true,
      };
    }
    case "foot_height_difference": {
      const [left, right] = [at("left_foot"), at("right_foot")];
      const from = aside(left, right[1], ASIDE);
      const to = aside(left, left[1], ASIDE);
      return {
        line: [from, to],
        leaders: [
          [right, from],
          [left, to],
        ],
      };
    }
    case "torso_lean": {
      const [hips, neck] = [at("hips"), at("neck")];
      const length = Math.hypot(neck[0] - hips[0], neck[1] - hips[1], neck[2] - hips[2]);
      const upright: Point = [hips[0], hips[1] + length, hips[2]];
      return { line: [upright, neck], leaders: [[hips, upright]] };
    }
    case "hands_apart":
      return { line: [at("left_hand"), at("right_hand")], leaders: [] };
    default:
      return undefined;
  }
}
