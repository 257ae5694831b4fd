/** The entry of the GPU's worker. */
import { StrutError } from "../../engine/errors";
import { Painter } from "../../engine/gpu/painter";
import { answerCalls, answersOf, type ServerPort } from "../rpc_server";
import type { GraphicsCalls } from "./graphics_protocol";

let opened: Painter | undefined;
/** The call in progress; it may still run after its caller cancelled it. */
let last: Promise<unknown> = Promise.resolve();

function inTurn<T>(answer: () => T | Promise<T>): Promise<T> {
  const turn = last.then(answer, answer);
  last = turn;
  return turn;
}

function painter(): Painter {
  if (opened) return opened;
  throw new StrutError({ code: "not-open", message: "No GPU is open.", hint: "" });
}

const TABLE: GraphicsCalls = {
  open: (packed) =>
    inTurn(async () => {
      opened = await Painter.open(packed);
      return opened.adapter;
    }),
  setLines: (lines, height) => inTurn(() => painter().setLines(lines, height)),
  draw: (columns) => inTurn(() => painter().draw(columns)),
};

answerCalls(self as unknown as ServerPort, answersOf(TABLE));
