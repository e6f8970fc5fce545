// The socket to the program.
import { readBinary, type Message } from "./messages";

export type Request = Record<string, unknown> & { do: string };

export class Connection {
  private socket: WebSocket;
  /** Whether this page has asked for anything yet. */
  hasAsked = false;

  /** `ended` is called once, where the program ends or cannot be reached. */
  constructor(take: (message: Message) => void, ended: () => void) {
    this.socket = new WebSocket(`ws://${location.host}/socket${location.search}`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onmessage = ({ data }) =>
      take(typeof data === "string" ? JSON.parse(data) : readBinary(data));
    this.socket.onclose = ended;
  }

  send(request: Request): void {
    this.hasAsked = true;
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(request));
  }
}
