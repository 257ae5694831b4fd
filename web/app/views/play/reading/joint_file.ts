/** The file of a joint mapping, which `strut --joints` reads, too. */
import type { JointNames } from "../../../../client/protocol";
import { ROLES } from "../../../../humanoid";
import { readingWords } from "./strings.en";

const words = readingWords.joints;

/** The text of the file. */
export function jointFile(joints: JointNames): string {
  return `${JSON.stringify({ joints }, null, 2)}\n`;
}

/** The joint mapping in a file's text, or a sentence on why it is invalid. */
export function readJointFile(name: string, text: string): { joints: JointNames } | { fault: string } {
  let file: unknown;
  try {
    file = JSON.parse(text);
  } catch {
    return { fault: words.noJson(name) };
  }
  const joints = memberOf(file, "joints");
  if (!isRecord(joints) || Object.keys(file as object).length > 1) return { fault: words.noJoints(name) };
  const role = Object.keys(joints).find((role) => !ROLES.some((known) => known === role));
  if (role !== undefined) return { fault: words.noRole(name, role) };
  if (!Object.values(joints).every((joint) => joint === null || typeof joint === "string"))
    return { fault: words.noJoints(name) };
  return { joints: joints as JointNames };
}

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);

const memberOf = (value: unknown, name: string): unknown => (isRecord(value) ? value[name] : undefined);
