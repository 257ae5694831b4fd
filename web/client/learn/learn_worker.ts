/** The entry of the lessons' worker. */
import { serveLearnPackage } from "../../engine/learn/wasm";
import { answerCalls, type Methods, type ServerPort } from "../rpc";
import { createLearnTable } from "./learn_table";

serveLearnPackage();
answerCalls(self as unknown as ServerPort, createLearnTable() as unknown as Methods);
