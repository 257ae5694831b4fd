import { expect, test } from "vitest";
import { addressIn, nameOf, USUAL } from "./live_name";

test("a name says where a sender is and how it writes", () => {
  expect(nameOf(USUAL)).toBe("live:ws://127.0.0.1:39541");
  expect(nameOf({ url: "wss://mocap.example/stream", format: "bvh" })).toBe("live:bvh:wss://mocap.example/stream");
  for (const address of [USUAL, { url: "wss://mocap.example/stream", format: "binary" } as const])
    expect(addressIn(nameOf(address))).toEqual(address);
});

test("a name of no sender is of the usual one", () => {
  expect(addressIn("live:")).toEqual(USUAL);
});
