/** The user's reading of a file, as the text of a link. */
import { type FileReading, UP_AXES } from "../client/protocol";
import { ROLES, type Role } from "../humanoid";
import { SEPARATOR } from "./fields";

/** Example: `up~z;floor~-0.93;left_hand~Wrist_L;chest~`. A role without a name is specified to have no joint. */
export function encodeReading(reading: FileReading): string {
  const { up, floor, swapSides, mirrored, unit, joints } = reading;
  const entries: [name: string, value: string | undefined][] = [
    ["up", up],
    ["floor", floor === undefined ? undefined : String(floor)],
    ["swap", swapSides ? "1" : undefined],
    ["mirrored", mirrored === undefined ? undefined : mirrored ? "1" : "0"],
    ["unit", unit === undefined ? undefined : String(unit)],
    // A joint mapping without any role still records that the joints were checked.
    ["joints", joints ? "1" : undefined],
    ...ROLES.map((role): [string, string | undefined] => [role, joints && encodeJoint(joints[role])]),
  ];
  const said = entries.filter((entry): entry is [string, string] => entry[1] !== undefined);
  return said.map(([name, value]) => `${name}${SEPARATOR.name}${value}`).join(SEPARATOR.entry);
}

/** Decodes {@link encodeReading}; `undefined` if it is invalid. */
export function decodeReading(text: string): FileReading | undefined {
  const reading: FileReading = {};
  const joints: Partial<Record<Role, string | null>> = {};
  for (const entry of text === "" ? [] : text.split(SEPARATOR.entry)) {
    const at = entry.indexOf(SEPARATOR.name);
    if (at < 0 || !takeEntry(reading, joints, entry.slice(0, at), entry.slice(at + 1))) return undefined;
  }
  return reading.joints ? { ...reading, joints } : reading;
}

/** Whether two readings are equal. */
export const sameReading = (a: FileReading, b: FileReading): boolean => encodeReading(a) === encodeReading(b);

/** Whether nothing is specified. */
export const saysNothing = (reading: FileReading): boolean => encodeReading(reading) === "";

/** Applies an entry. Returns whether it was valid. */
function takeEntry(reading: FileReading, joints: Record<string, string | null>, name: string, value: string): boolean {
  const number = value === "" ? Number.NaN : Number(value);
  const isFlag = value === "0" || value === "1";
  switch (name) {
    case "up": {
      const up = UP_AXES.find((axis) => axis === value);
      if (up) reading.up = up;
      return up !== undefined;
    }
    case "floor":
      reading.floor = number;
      return Number.isFinite(number);
    case "unit":
      reading.unit = number;
      return Number.isFinite(number) && number > 0;
    case "swap":
      reading.swapSides = true;
      return value === "1";
    case "mirrored":
      reading.mirrored = value === "1";
      return isFlag;
    case "joints":
      reading.joints = {};
      return value === "1";
    default: {
      const joint = decodeJoint(value);
      if (joint === undefined || !ROLES.some((role) => role === name)) return false;
      joints[name] = joint;
      return true;
    }
  }
}

/** Names of joints may contain any characters. */
function encodeJoint(joint: string | null | undefined): string | undefined {
  return joint === undefined ? undefined : encodeURIComponent(joint ?? "").replaceAll("~", "%7E");
}

/** The name of a joint, or `null` for none; `undefined` if it cannot be decoded. */
function decodeJoint(text: string): string | null | undefined {
  try {
    return text === "" ? null : decodeURIComponent(text);
  } catch {
    return undefined;
  }
}
