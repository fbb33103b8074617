// The WebSocket to the program: it comes back by itself when the program does.

import { decode } from "./decode";
import { Signal } from "./core/signal";
import type { Frame, PageMessage, ServerMessage, Values } from "./wire";

export type Link = "connecting" | "open" | "lost";

export interface Listener {
  message(message: ServerMessage): void;
  frame(frame: Frame): void;
  values(values: Values): void;
  /** What came was not understood. */
  garbled(text: string): void;
}

const FIRST_WAIT_MS = 500;
const LONGEST_WAIT_MS = 5000;

/** The stream's address: beside the page, with the page's own token. */
export function streamAddress(page: Location): string {
  const address = new URL("stream", page.href);
  address.protocol = page.protocol === "https:" ? "wss:" : "ws:";
  address.search = page.search;
  address.hash = "";
  return address.href;
}

export class Connection {
  readonly link = new Signal<Link>("connecting");
  private socket: WebSocket | null = null;
  private wait_ms = FIRST_WAIT_MS;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly address: string,
    private readonly listener: Listener,
  ) {
    this.open();
    // Somebody who comes back to this page does not want to wait.
    addEventListener("online", () => this.retry());
    document.addEventListener("visibilitychange", () => {
      if (!document.hidden) this.retry();
    });
  }

  /** Whether it was sent; what is said to nobody is forgotten. */
  send(message: PageMessage): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  retry(): void {
    if (this.link.value !== "lost") return;
    clearTimeout(this.timer);
    this.wait_ms = FIRST_WAIT_MS;
    this.open();
  }

  private open(): void {
    clearTimeout(this.timer);
    const socket = new WebSocket(this.address);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.addEventListener("open", () => {
      this.wait_ms = FIRST_WAIT_MS;
      this.link.value = "open";
    });
    socket.addEventListener("message", (event: MessageEvent<string | ArrayBuffer>) => this.hear(event.data));
    socket.addEventListener("close", () => {
      if (this.socket !== socket) return;
      this.socket = null;
      this.link.value = "lost";
      this.timer = setTimeout(() => this.open(), this.wait_ms);
      this.wait_ms = Math.min(2 * this.wait_ms, LONGEST_WAIT_MS);
    });
  }

  private hear(data: string | ArrayBuffer): void {
    if (typeof data === "string") {
      let message: ServerMessage;
      try {
        message = JSON.parse(data) as ServerMessage;
      } catch {
        this.listener.garbled("The program sent a message that is no JSON.");
        return;
      }
      this.listener.message(message);
      return;
    }
    const decoded = decode(data);
    if (decoded === null) this.listener.garbled("The program sent a binary message that this page does not know.");
    else if (decoded.kind === "frame") this.listener.frame(decoded.frame);
    else this.listener.values(decoded.values);
  }
}
