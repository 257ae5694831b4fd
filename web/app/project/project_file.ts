/**
 * The project file, `.strut`: the open objects as one zip archive. Its `project.json` lists all other files.
 * `docs/projects.md` describes the format and its limits. A file is read completely and checked before any of it is
 * used, and every error is a sentence.
 */
import { Archive, readDirectory, readEntry, type ZipEntry, ZipError } from "../../client/build/zip";
import { ZipWriter } from "../../client/build/zip_writer";
import { type CallOptions, type ExactPoses, isCancellation } from "../../client/protocol";
import { POSE_FLOATS, ROLES, type Role } from "../../humanoid";
import { decodeReading, encodeReading } from "../../link/reading";
import type { DroppedInput } from "../../player/input_library";
import { cancelled } from "../ui/words";
import { projectWords as words } from "./strings.en";

/** The format name in `project.json`, and the version of the format that this page writes. */
const FORMAT = "strut-project";
export const VERSION = 1;
const MANIFEST = "project.json";

/** Limits of the format. */
export const LIMITS = {
  /** Bytes of `project.json`. */
  manifest: 1 << 20,
  /** Characters of the state, and of a name. */
  state: 1 << 18,
  name: 255,
  /** Motions, and entries of the archive. */
  inputs: 500,
  entries: 2000,
  /** Bytes of a motion, of its exact poses, of a database, and of a character. */
  motion: 256 << 20,
  poses: 256 << 20,
  database: 4096 * (1 << 20),
  character: 512 << 20,
  /** Bytes of all unpacked files. */
  all: 4096 * (1 << 20),
} as const;

/** Numbers of a body: 21 × xyz. */
const PROPORTIONS = 3 * ROLES.length;

/** A character: its file, or the properties that identify its file. */
export interface ProjectCharacter {
  /** Name of its file. */
  name: string;
  size: number;
  sha256: string;
  file?: Blob;
  /** Joint of each role, if the user set it. */
  roles?: Partial<Record<Role, string>>;
}

/** Contents of a project file. */
export interface Project {
  /** The state as the text of a link, without `#`. */
  state: string;
  inputs: readonly DroppedInput[];
  database?: { name: string; file: Blob };
  character?: ProjectCharacter;
}

/** The error of an invalid project file; its message is a sentence. */
export class ProjectError extends Error {}

/** Writes a project; equal projects give equal bytes. @throws ZipError if it is too large */
export async function writeProject(project: Project, { signal, onProgress }: CallOptions = {}): Promise<Blob> {
  const { state, inputs, database, character } = project;
  const zip = new ZipWriter();
  const files = inputs.length + (database ? 1 : 0) + (character?.file ? 1 : 0);
  let written = 0;
  const add = async (path: string, blob: Blob | ArrayBuffer, packed: boolean) => {
    if (signal?.aborted) throw cancelled();
    const bytes = blob instanceof Blob ? await blob.arrayBuffer() : blob;
    await zip.add(path, new Uint8Array(bytes), packed);
    onProgress?.({ label: words.saving, fraction: ++written / (files + 1) });
    return path;
  };
  const manifest = {
    format: FORMAT,
    version: VERSION,
    state,
    inputs: inputs.map(({ name, reading, exact }, i) => ({
      name,
      file: `inputs/${i + 1}.bvh`,
      ...(reading && { reading: encodeReading(reading) }),
      ...(exact && {
        exact: { file: `inputs/${i + 1}.poses`, proportions: [...exact.proportions], rateHz: exact.rateHz },
      }),
    })),
    ...(database && { database: { name: database.name, file: "database.strutdb" } }),
    ...(character && {
      character: {
        name: character.name,
        size: character.size,
        sha256: character.sha256,
        ...(character.roles && { roles: character.roles }),
        ...(character.file && { file: `character${endingOf(character.name)}` }),
      },
    }),
  };
  // First, so that readers of the file find the format at once.
  await add(MANIFEST, new TextEncoder().encode(JSON.stringify(manifest, undefined, 1)).buffer, true);
  for (const [i, { file, exact }] of inputs.entries()) {
    await add(`inputs/${i + 1}.bvh`, file, true);
    if (exact) await add(`inputs/${i + 1}.poses`, Float32Array.from(exact.poses).buffer, true);
  }
  if (database) await add("database.strutdb", database.file, true);
  if (character?.file) await add(`character${endingOf(character.name)}`, character.file, false);
  return zip.archive("application/x-strut-project");
}

const endingOf = (name: string): string => /\.[a-z0-9]{1,8}$/i.exec(name)?.[0].toLowerCase() ?? "";

/**
 * Reads a project.
 * @throws ProjectError if the file is invalid; the message says why; `cancelled`
 */
export async function readProject(file: Blob, call: CallOptions = {}): Promise<Project> {
  try {
    return await new Reader(file, call).project();
  } catch (thrown) {
    if (thrown instanceof ProjectError || isCancellation(thrown)) throw thrown;
    if (thrown instanceof ZipError) throw new ProjectError(words.damaged(thrown.message));
    // Thrown by the browser for a file that was moved or changed since it was chosen.
    throw new ProjectError(words.unreadable);
  }
}

/** Reads the files that `project.json` names, within the limits. */
class Reader {
  readonly #archive: Archive;
  readonly #call: CallOptions;
  #entries = new Map<string, ZipEntry>();
  #unpacked = 0;
  /** Numbers of files read and of all files. */
  #read = 0;
  #files = 1;

  constructor(file: Blob, call: CallOptions) {
    this.#archive = new Archive(file);
    this.#call = call;
  }

  async project(): Promise<Project> {
    await this.#list();
    const manifest = await this.#manifest();
    const listed = manifest.inputs ?? [];
    if (!Array.isArray(listed)) throw new ProjectError(words.wrong("inputs"));
    if (listed.length > LIMITS.inputs) throw new ProjectError(words.tooMany(listed.length, LIMITS.inputs));
    this.#files = listed.length + 2;
    const state = manifest.state ?? "";
    if (typeof state !== "string" || state.length > LIMITS.state) throw new ProjectError(words.wrong("state"));
    const inputs: DroppedInput[] = [];
    for (const [i, input] of listed.entries()) inputs.push(await this.#input(input, `inputs[${i}]`));
    if (new Set(inputs.map(({ name }) => name)).size < inputs.length) throw new ProjectError(words.wrong("inputs"));
    const { database, character } = manifest;
    return {
      state,
      inputs,
      ...(isGiven(database) && { database: await this.#database(database) }),
      ...(isGiven(character) && { character: await this.#character(character) }),
    };
  }

  async #list(): Promise<void> {
    const entries = await readDirectory(this.#archive).catch((thrown: unknown) => {
      if (thrown instanceof ZipError) throw new ProjectError(words.noProject);
      throw thrown;
    });
    if (entries.length > LIMITS.entries) throw new ProjectError(words.noProject);
    for (const entry of entries) {
      // Readers may differ in which of two entries with the same name they use.
      if (this.#entries.has(entry.name)) throw new ProjectError(words.twice(entry.name));
      this.#entries.set(entry.name, entry);
    }
    if (!this.#entries.has(MANIFEST)) throw new ProjectError(words.noProject);
  }

  async #manifest(): Promise<Record<string, unknown>> {
    const bytes = await this.#bytes(MANIFEST, LIMITS.manifest);
    let manifest: unknown;
    try {
      manifest = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
    } catch {
      throw new ProjectError(words.noJson);
    }
    if (!isRecord(manifest) || manifest.format !== FORMAT) throw new ProjectError(words.noProject);
    const { version } = manifest;
    if (typeof version !== "number" || !Number.isInteger(version)) throw new ProjectError(words.wrong("version"));
    if (version > VERSION) throw new ProjectError(words.newer(version, VERSION));
    if (version < VERSION) throw new ProjectError(words.older(version, VERSION));
    return manifest;
  }

  async #input(input: unknown, where: string): Promise<DroppedInput> {
    if (!isRecord(input)) throw new ProjectError(words.wrong(where));
    const name = nameOf(input.name, `${where}.name`);
    const bytes = await this.#bytes(input.file, LIMITS.motion);
    const reading = typeof input.reading === "string" ? decodeReading(input.reading) : undefined;
    if (input.reading !== undefined && !reading) throw new ProjectError(words.wrong(`${where}.reading`));
    return {
      name,
      file: new Blob([bytes]),
      ...(reading && { reading }),
      ...(input.exact !== undefined && { exact: await this.#exact(input.exact, `${where}.exact`) }),
    };
  }

  async #exact(exact: unknown, where: string): Promise<ExactPoses> {
    if (!isRecord(exact)) throw new ProjectError(words.wrong(where));
    const { proportions, rateHz } = exact;
    const isNumber = (value: unknown): value is number => typeof value === "number" && Number.isFinite(value);
    if (!Array.isArray(proportions) || proportions.length !== PROPORTIONS || !proportions.every(isNumber))
      throw new ProjectError(words.wrong(`${where}.proportions`));
    if (!isNumber(rateHz) || rateHz <= 0 || rateHz > 1000) throw new ProjectError(words.wrong(`${where}.rateHz`));
    const bytes = await this.#bytes(exact.file, LIMITS.poses);
    const poses = bytes.length % (4 * POSE_FLOATS) === 0 ? new Float32Array(bytes.buffer) : new Float32Array();
    if (poses.length === 0 || !poses.every(Number.isFinite)) throw new ProjectError(words.wrong(`${where}.file`));
    return { poses, proportions: Float32Array.from(proportions), rateHz };
  }

  async #database(database: unknown): Promise<{ name: string; file: Blob }> {
    if (!isRecord(database)) throw new ProjectError(words.wrong("database"));
    const name = nameOf(database.name, "database.name");
    return { name, file: new Blob([await this.#bytes(database.file, LIMITS.database)]) };
  }

  async #character(character: unknown): Promise<ProjectCharacter> {
    if (!isRecord(character)) throw new ProjectError(words.wrong("character"));
    const { size, sha256, roles } = character;
    const name = nameOf(character.name, "character.name");
    if (!/\.(glb|vrm|fbx)$/i.test(name)) throw new ProjectError(words.wrong("character.name"));
    if (typeof size !== "number" || !Number.isInteger(size) || size < 0)
      throw new ProjectError(words.wrong("character.size"));
    if (typeof sha256 !== "string" || !/^[0-9a-f]{64}$/.test(sha256))
      throw new ProjectError(words.wrong("character.sha256"));
    const given = roles === undefined ? undefined : rolesOf(roles);
    if (roles !== undefined && !given) throw new ProjectError(words.wrong("character.roles"));
    const inside = character.file !== undefined;
    return {
      name,
      size,
      sha256,
      ...(given && { roles: given }),
      ...(inside && { file: new Blob([await this.#bytes(character.file, LIMITS.character)]) }),
    };
  }

  /** The bytes of a file that `project.json` names, in a buffer of their own. */
  async #bytes(path: unknown, max: number): Promise<Uint8Array<ArrayBuffer>> {
    const { signal, onProgress } = this.#call;
    if (signal?.aborted) throw cancelled();
    const entry = typeof path === "string" ? this.#entries.get(path) : undefined;
    if (!entry) throw new ProjectError(words.missing(typeof path === "string" ? path.slice(0, 100) : "?"));
    const left = LIMITS.all - this.#unpacked;
    const bytes = await readEntry(this.#archive, entry, Math.min(max, left));
    this.#unpacked += bytes.length;
    onProgress?.({ label: words.reading, fraction: Math.min(1, ++this.#read / this.#files) });
    return bytes.slice();
  }
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

const isGiven = (value: unknown): boolean => value !== undefined && value !== null;

/** A name for display and lookup, without invisible characters. @throws ProjectError */
function nameOf(value: unknown, where: string): string {
  // biome-ignore lint/suspicious/noControlCharactersInRegex: these are what is refused
  const valid = typeof value === "string" && value.trim() !== "" && !/[\u0000-\u001f\u007f]/.test(value);
  if (!valid || value.length > LIMITS.name) throw new ProjectError(words.wrong(where));
  return value;
}

function rolesOf(value: unknown): Partial<Record<Role, string>> | undefined {
  if (!isRecord(value)) return undefined;
  const known = new Set<string>(ROLES);
  const valid = Object.entries(value).every(
    ([role, joint]) => known.has(role) && typeof joint === "string" && joint.length <= LIMITS.name,
  );
  return valid ? (value as Partial<Record<Role, string>>) : undefined;
}

/** The digest used where none can be computed: browsers compute digests only on https. */
const UNKNOWN_DIGEST = "0".repeat(64);

/** SHA-256 of a file, in hexadecimal digits. */
export async function sha256Of(file: Blob): Promise<string> {
  const { subtle } = crypto as { subtle?: SubtleCrypto };
  if (!subtle) return UNKNOWN_DIGEST;
  const digest = new Uint8Array(await subtle.digest("SHA-256", await file.arrayBuffer()));
  return [...digest].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** Whether a file is the one with which a project was made, as far as that can be checked. */
export async function isFileOf({ size, sha256 }: ProjectCharacter, file: Blob): Promise<boolean> {
  if (file.size !== size) return false;
  const digest = await sha256Of(file);
  return digest === sha256 || digest === UNKNOWN_DIGEST || sha256 === UNKNOWN_DIGEST;
}
