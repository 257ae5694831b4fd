/** The catalogue of public data sets: the contents of `catalog.json`, checked before use. */
import { StrutError } from "../../../client/protocol";
import { strings } from "../../strings/strings";

const words = strings.data.sets;

/** A data set of the catalogue. */
export interface PublicSet {
  id: string;
  name: string;
  /** Its contents in a few words. */
  about: string;
  licence: { name: string; url: string; note: string };
  citation: string;
  /** Web page with information, and for manual download. */
  page: string;
  /** Total bytes; 0 if unknown. */
  bytes: number;
  /** Prefix of the files' URLs: https, with a slash at the end. */
  base: string;
  files: SetFile[];
  /** Pattern of the clips' names, if they contain the labels. */
  pattern?: string;
  /** Table of labels (CSV), if the names do not contain them. */
  labels?: string;
}

/** A clip or an archive of a set. */
export interface SetFile {
  /** Path in the set. */
  path: string;
  /** Path after `base` in its URL; by default `path`. */
  url?: string;
  /** SHA-256 of its bytes, 64 hexadecimal digits, if it is known. */
  sha256?: string;
}

/** Maximum number of files of a set. */
const MAX_FILES = 10_000;

/**
 * Loads the sets of a catalogue.
 * @throws StrutError if it cannot be loaded, or does not meet {@link parseCatalogue}
 */
export async function loadCatalogue(url: string | URL = "catalog.json"): Promise<PublicSet[]> {
  const response = await fetch(url, { credentials: "omit", referrerPolicy: "no-referrer" }).catch(() => undefined);
  if (!response?.ok) throw failure(words.noList);
  const catalogue: unknown = await response.json().catch(() => {
    throw failure(words.noList);
  });
  return parseCatalogue(catalogue);
}

/**
 * Checks a catalogue.
 * @throws StrutError that names the first invalid field
 */
export function parseCatalogue(catalogue: unknown): PublicSet[] {
  const { version, sets } = recordAt("", catalogue);
  expected("version", "1", version === 1);
  const checked = listAt("sets", sets).map((set, i) => checkedSet(`sets[${i}]`, set));
  expected("sets", "sets with different ids", new Set(checked.map(({ id }) => id)).size === checked.length);
  return checked;
}

/** The files of a set with complete URLs. */
export function filesOf({ base, files }: PublicSet): (SetFile & { url: string })[] {
  return files.map((file) => ({ ...file, url: base + (file.url ?? encodeURI(file.path)) }));
}

function checkedSet(at: string, value: unknown): PublicSet {
  const set = recordAt(at, value);
  const licence = recordAt(`${at}.licence`, set.licence);
  const { bytes, pattern, labels } = set;
  expected(`${at}.bytes`, "a whole number of bytes", Number.isSafeInteger(bytes) && (bytes as number) >= 0);
  const base = textAt(`${at}.base`, set.base);
  expected(`${at}.base`, "an https address that ends with a slash", isUrl(base, ["https:"]) && base.endsWith("/"));
  const files = listAt(`${at}.files`, set.files).map((file, i) => checkedFile(`${at}.files[${i}]`, base, file));
  expected(`${at}.files`, `1 to ${MAX_FILES} files`, files.length > 0 && files.length <= MAX_FILES);
  const different = new Set(files.map(({ path }) => path)).size === files.length;
  expected(`${at}.files`, "files with different paths", different);
  return {
    id: textAt(`${at}.id`, set.id),
    name: textAt(`${at}.name`, set.name),
    about: textAt(`${at}.about`, set.about),
    licence: {
      name: textAt(`${at}.licence.name`, licence.name),
      url: linkAt(`${at}.licence.url`, licence.url),
      note: textAt(`${at}.licence.note`, licence.note),
    },
    citation: textAt(`${at}.citation`, set.citation),
    page: linkAt(`${at}.page`, set.page),
    bytes: bytes as number,
    base,
    files,
    ...(pattern !== undefined && { pattern: textAt(`${at}.pattern`, pattern) }),
    ...(labels !== undefined && { labels: textAt(`${at}.labels`, labels) }),
  };
}

/** A file is a path, or an object. Its URL must stay below that of the set, and its path within the set. */
function checkedFile(at: string, base: string, value: unknown): SetFile {
  const file = typeof value === "string" ? { path: value } : recordAt(at, value);
  const path = textAt(`${at}.path`, file.path);
  const parts = path.split(/[/\\]/);
  expected(`${at}.path`, "a path in the set", !parts.some((part) => part === "" || part === "." || part === ".."));
  const url = file.url === undefined ? undefined : textAt(`${at}.url`, file.url);
  const whole = base + (url ?? encodeURI(path));
  expected(`${at}.url`, "an address below base", isUrl(whole, ["https:"]) && new URL(whole).href === whole);
  const { sha256 } = file;
  const isHash = typeof sha256 === "string" && /^[0-9a-f]{64}$/.test(sha256);
  expected(`${at}.sha256`, "64 hexadecimal digits", sha256 === undefined || isHash);
  return { path, ...(url !== undefined && { url }), ...(isHash && { sha256 }) };
}

function recordAt(at: string, value: unknown): Record<string, unknown> {
  expected(at, "an object", typeof value === "object" && value !== null && !Array.isArray(value));
  return value as Record<string, unknown>;
}

function listAt(at: string, value: unknown): unknown[] {
  expected(at, "a list", Array.isArray(value));
  return value as unknown[];
}

function textAt(at: string, value: unknown): string {
  expected(at, "a text", typeof value === "string" && value !== "");
  return value as string;
}

function linkAt(at: string, value: unknown): string {
  const link = textAt(at, value);
  expected(at, "a web address", isUrl(link, ["https:", "http:"]));
  return link;
}

function isUrl(text: string, protocols: readonly string[]): boolean {
  return URL.canParse(text) && protocols.includes(new URL(text).protocol);
}

function expected(at: string, what: string, holds: boolean): void {
  if (!holds) throw failure(words.badList(at || "catalog.json", what));
}

function failure(message: string): StrutError {
  return new StrutError({ code: "bad-file", message, hint: "" });
}
