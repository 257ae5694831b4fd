/** The entry of the crowd's worker. */
import { answerCalls, type Methods, type ServerPort } from "../rpc";
import { createCrowdTable } from "./crowd_table";

answerCalls(self as unknown as ServerPort, createCrowdTable() as unknown as Methods);
