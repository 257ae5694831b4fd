/** The entry of the lessons' worker. */
import { serveLearnPackage } from "../../engine/learn/wasm";
import { answerCalls, answersOf, type ServerPort } from "../rpc_server";
import { createLearnTable } from "./learn_table";

serveLearnPackage();
answerCalls(self as unknown as ServerPort, answersOf(createLearnTable()));
