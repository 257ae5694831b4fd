import fc from "fast-check";
import { expect, test } from "vitest";
import { exp, inverse, log, multiply, quaternionAt, turned, type Vector } from "./rotations";

const number = fc.double({ min: -1.5, max: 1.5, noNaN: true });
const vectors = fc.tuple(number, number, number);
const close = (a: readonly number[], b: readonly number[]) => {
  expect(a).toHaveLength(b.length);
  a.forEach((value, i) => {
    expect(value).toBeCloseTo(b[i]!, 9);
  });
};

test("log is the inverse of exp within half a turn, and knows that q and −q are one rotation", () => {
  fc.assert(
    fc.property(vectors, (w) => {
      const q = exp(w);
      close(log(q), w);
      close(log([-q[0], -q[1], -q[2], -q[3]]), w);
    }),
  );
  close(log(exp([0, 0, 0])), [0, 0, 0]);
  close(log(exp([1e-12, 0, 0])), [1e-12, 0, 0]);
});

test("a quarter turn about +Y brings +X to −Z", () => {
  close(turned(exp([0, Math.PI / 2, 0]), [1, 0, 0]), [0, 0, -1]);
});

test("products are one turn after the other", () => {
  fc.assert(
    fc.property(vectors, vectors, vectors, (a, b, v: Vector) => {
      const [p, q] = [exp(a), exp(b)];
      close(turned(multiply(p, q), v), turned(p, turned(q, v)));
      close(turned(inverse(p), turned(p, v)), v);
    }),
  );
});

test("is read from an array", () => {
  expect(quaternionAt([9, 9, 9, 9, 1, 2, 3, 4], 1)).toEqual([1, 2, 3, 4]);
});
