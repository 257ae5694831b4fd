export interface MessageServer {
  readonly url: string;
  readonly receivers: number;
  send(message: string | Uint8Array): void;
  close(): Promise<void>;
}
export function serveMessages(port: number, first?: () => (string | Uint8Array)[]): Promise<MessageServer>;
