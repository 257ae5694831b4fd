/** The entry of the lessons' worker. */
import { serveComparePackage } from "../../engine/compare/wasm";
import { createLearnTable } from "./learn_table";
import { answerCalls, type Methods, type ServerPort } from "./rpc";

serveComparePackage();
answerCalls(self as unknown as ServerPort, createLearnTable() as unknown as Methods);
