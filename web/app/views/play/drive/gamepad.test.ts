import { expect, test } from "vitest";
import { GamepadInput, glyphsOf, type Pad } from "./gamepad";

/** A pad with a stick position and some pressed buttons. */
function pad(axes: readonly number[], pressed: readonly number[] = [], id = "Pad"): Pad {
  const buttons = Array.from({ length: 17 }, (_, i) => ({
    pressed: pressed.includes(i),
    value: pressed.includes(i) ? 1 : 0,
  }));
  return { id, connected: true, mapping: "standard", axes, buttons };
}

test("a stick goes, and its trigger runs", () => {
  let pads: (Pad | null)[] = [null, pad([0, -1])];
  const used: string[] = [];
  const input = new GamepadInput(
    () => {},
    (glyphs) => used.push(glyphs),
    () => pads,
  );
  expect(input.read()).toEqual({ right: 0, ahead: 1, gait: 1, turns: false });
  pads = [pad([1, 0], [7], "Wireless Controller (Vendor: 054c)")];
  expect(input.read()).toMatchObject({ right: 1, gait: 2 });
  expect(used).toEqual(["numbers", "shapes"]);
});

test("a pad that is gone asks for nothing, and one that rests is not in use", () => {
  let pads: (Pad | null)[] = [pad([0, 0])];
  let uses = 0;
  const input = new GamepadInput(
    () => {},
    () => uses++,
    () => pads,
  );
  expect([input.read(), uses]).toEqual([undefined, 0]);
  pads = [{ ...pad([0, -1]), connected: false }, null];
  expect(input.read()).toBeUndefined();
});

test("a button acts once, however long it is held", () => {
  let pads = [pad([0, 0], [0])];
  const done: string[] = [];
  const input = new GamepadInput(
    (action) => done.push(action),
    () => {},
    () => pads,
  );
  for (let i = 0; i < 3; i++) input.read();
  pads = [pad([0, 0], [1, 2, 8])];
  input.read();
  pads = [pad([0, 0], [0])];
  input.read();
  expect(done).toEqual(["jump", "kick", "punch", "keep", "jump"]);
});

test("its marks are its vendor's", () => {
  expect([glyphsOf("054c-09cc"), glyphsOf("Xbox Wireless"), glyphsOf("")]).toEqual(["shapes", "letters", "numbers"]);
});
