/** Every WASM package throws errors as values with the same shape, and panics as JavaScript errors. */
import { readFileSync } from "node:fs";
import { expect, test } from "vitest";

/** Error of a package. */
interface EngineError {
  readonly code: string;
  readonly message: string;
  readonly hint: string;
}

type Constructor = new (...args: unknown[]) => unknown;
type Method = (...args: unknown[]) => unknown;

/** The bindings of a package. */
type Glue = Record<string, unknown> & { initSync: Method; EngineError: Constructor };

const make = (glue: Glue, name: string, ...args: unknown[]) => new (glue[name] as Constructor)(...args);
const call = (glue: object, name: string, ...args: unknown[]) => (glue as Record<string, Method>)[name]!(...args);

/** Each package with a call that is refused for its bytes and, if available, one that is refused for an argument. */
const PACKAGES = [
  {
    folder: "web/engine/pkg",
    name: "strut_wasm",
    file: (glue: Glue) => call(glue.Database as object, "fromBytes", new Uint8Array(100)),
    message: "This is not a Strut database, or its beginning is damaged; a safetensors header was expected.",
    argument: (glue: Glue) => call(glue, "interpolatePoses", new Float32Array(3), new Float32Array(3), 0.5),
  },
  {
    folder: "web/engine/build/pkg",
    name: "strut_wasm_build",
    file: (glue: Glue) => make(glue, "WalkTraining", new Uint8Array(100)),
    message: "This is not a Strut database, or its beginning is damaged; a safetensors header was expected.",
    argument: (glue: Glue) => call(glue, "labelsOf", ["a.bvh"], "{", undefined),
  },
  {
    folder: "web/engine/walk/pkg",
    name: "strut_wasm_walk",
    file: (glue: Glue) => make(glue, "WalkModel", new Uint8Array(100)),
    message: "This is not a walk model, or its beginning is damaged; a safetensors header was expected.",
  },
  {
    folder: "web/engine/crowd/pkg",
    name: "strut_crowd",
    file: (glue: Glue) => make(glue, "WalkModel", new Uint8Array(100)),
    message: "This is not a walk model, or its beginning is damaged; a safetensors header was expected.",
  },
  {
    folder: "web/engine/key_style/pkg",
    name: "strut_wasm_key_style",
    file: (glue: Glue) => make(glue, "KeyStyleModel", new Uint8Array(100)),
    message: "This is not a key-style model, or its beginning is damaged; a safetensors header was expected.",
  },
  {
    folder: "web/engine/character/pkg",
    name: "strut_wasm_character",
    file: (glue: Glue) => character(glue, 1),
    message: "No legs and arms were found in this skeleton. Use a file of a humanoid.",
    argument: (glue: Glue) => character(glue, 0),
  },
];

/** Creates a character of one joint, with this number of metres per unit. */
function character(glue: Glue, metresPerUnit: number) {
  const roles = new Int32Array(21).fill(-1);
  const [parents, offsets, turn] = [Int32Array.of(-1), new Float32Array(3), Float32Array.of(0, 0, 0, 1)];
  return make(glue, "Character", ["Hips"], parents, offsets, turn, turn, roles, metresPerUnit);
}

async function load(folder: string, name: string): Promise<Glue> {
  const at = new URL(`../../${folder}/`, import.meta.url);
  const glue = await import(/* @vite-ignore */ new URL(`${name}.js`, at).href);
  glue.initSync({ module: readFileSync(new URL(`${name}_bg.wasm`, at)) });
  return glue;
}

function thrownBy(call: () => unknown): unknown {
  try {
    call();
  } catch (thrown) {
    return thrown;
  }
  throw new Error("nothing was thrown");
}

test("strut_drive, which reads no files", async () => {
  const glue = await load("web/engine/drive/pkg", "strut_drive");
  for (const wrong of [
    () => make(glue, "Clips", new Float32Array(3), 60),
    () => make(glue, "Driver", make(glue, "Clips", new Float32Array(63), 60)),
    () =>
      call(
        make(glue, "Clips", new Float32Array(63), 60) as object,
        "add",
        0,
        "a",
        "b",
        new Float32Array(3),
        new Uint8Array(2),
        new Float32Array(63),
        60,
      ),
  ]) {
    const error = thrownBy(wrong);
    expect(error).toBeInstanceOf(glue.EngineError);
    expect((error as EngineError).code).toBe("bad-input");
  }
});

test.each(PACKAGES)("$name", async ({ folder, name, file, message, argument }) => {
  const glue = await load(folder, name);
  const refused = thrownBy(() => file(glue));
  expect(refused).toBeInstanceOf(glue.EngineError);
  const error = refused as EngineError;
  expect([error.code, error.message, typeof error.hint]).toEqual(["bad-file", message, "string"]);
  if (!argument) return;
  const wrong = thrownBy(() => argument(glue));
  expect(wrong).toBeInstanceOf(glue.EngineError);
  expect((wrong as EngineError).code).toBe("bad-input");
  expect((wrong as EngineError).message).toMatch(/\.$/);
});
