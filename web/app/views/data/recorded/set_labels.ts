/** Labels of the clips of a public data set, from its catalogue entry. Pure functions. */
import type { PublicSet, SetFile } from "../catalogue";

/** A clip of a set; its labels are empty if the catalogue has none for it. */
export interface LabelledClip {
  file: SetFile;
  action: string;
  style: string;
  take: string;
}

/** The single clips of a set; empty if it is an archive. */
export function clipsOf(set: PublicSet): LabelledClip[] {
  const clips = set.files.filter(({ path }) => /\.bvh$/i.test(path));
  const label = set.labels === undefined ? fromNames(set.pattern ?? "") : fromTable(set.labels);
  return clips.map((file) => ({ file, action: "", style: "", take: "", ...label(baseName(file.path)) }));
}

/** The clip to begin with: a neutral walk if there is one, else any walk. */
export function firstClip(clips: readonly LabelledClip[]): LabelledClip | undefined {
  const walks = clips.filter(({ action }) => action === "walk");
  return walks.find(({ style }) => /^(neutral|normal)$/.test(style)) ?? walks[0] ?? clips[0];
}

type Labels = Partial<Record<"action" | "style" | "take", string>>;

const baseName = (path: string): string => path.split("/").at(-1)!;

/** Labels by a pattern of file names with `{action}`, `{style}`, `{take}` and `{any}`. */
function fromNames(pattern: string): (name: string) => Labels {
  const fields: string[] = [];
  const source = pattern.replace(/\{(\w+)\}|[^{]+|\{/g, (part, field: string | undefined) => {
    if (field === undefined) return part.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
    fields.push(field);
    return "(.+?)";
  });
  const names = new RegExp(`^${source}$`, "i");
  return (name) => {
    const [, ...values] = names.exec(name) ?? [];
    return Object.fromEntries(fields.map((field, i) => [field, values[i] ?? ""] as const).filter(isLabel));
  };
}

const isLabel = ([field]: readonly [string, string]): boolean => ["action", "style", "take"].includes(field);

/** Labels by a table with the columns file, action and style. */
function fromTable(table: string): (name: string) => Labels {
  const [, ...rows] = table.split(/\r?\n/).map((line) => line.split(",").map((cell) => cell.trim()));
  const byName = new Map(rows.map(([file = "", action = "", style = ""]) => [baseName(file), { action, style }]));
  return (name) => byName.get(name) ?? {};
}
