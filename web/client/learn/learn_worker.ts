/** The entry of the lessons' worker. */
import { serveLearnPackage } from "../../engine/learn/wasm";
import { createLearnTable } from "./learn_table";
import { answerCalls, type Methods, type ServerPort } from "./rpc";

serveLearnPackage();
answerCalls(self as unknown as ServerPort, createLearnTable() as unknown as Methods);
