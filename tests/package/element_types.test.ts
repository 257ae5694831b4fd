import { expectTypeOf, test } from "vitest";
import type { StrutPlayer } from "../../web/element";
import type {} from "../../web/package/element";

test("the page's own calls know the player and what it tells", () => {
  expectTypeOf<HTMLElementTagNameMap["strut-player"]>().toEqualTypeOf<StrutPlayer>();
  // Compiled, never run.
  const listen = (player: StrutPlayer) => {
    player.addEventListener("stylechange", ({ detail }) =>
      expectTypeOf(detail.styles).toEqualTypeOf<Record<string, number>>(),
    );
    player.addEventListener("frame", ({ detail }) => expectTypeOf(detail.inputFrame).toBeNumber());
    player.addEventListener("click", (event) => expectTypeOf(event.clientX).toBeNumber());
  };
  expectTypeOf(listen).parameter(0).toExtend<HTMLElement>();
});
