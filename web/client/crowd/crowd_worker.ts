/** The entry of the crowd's worker. */
import { answerCalls, answersOf, type ServerPort } from "../rpc_server";
import { createCrowdTable } from "./crowd_table";

answerCalls(self as unknown as ServerPort, answersOf(createCrowdTable()));
