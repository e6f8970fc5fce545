// Messages as they come, until the page can show something; berth may still be reading its images.
import type { Message } from "./messages";

/** What the page begins with, in the order in which it takes them. */
const first = ["scene", "mesh", "shown"] as const;

export class Inbox {
  private held: Message[] | null = [];

  /** `take` gets the messages, the first ones in order; `wait` a word on what is missing until then. */
  constructor(
    private readonly take: (message: Message) => void,
    private readonly wait: (text: string) => void,
  ) {
    wait("Waiting for berth.");
  }

  put(message: Message): void {
    if (!this.held) return this.take(message);
    if (message.type === "loading") return this.wait(`Berth reads the images: ${message.images} so far.`);
    this.held.push(message);
    const has = (type: string) => this.held!.some((one) => one.type === type);
    if (!has("scene")) return;
    if (!has("mesh")) return this.wait("Waiting for the robot's shape.");
    if (!has("shown")) return this.wait("Waiting for the first answer.");
    const held = this.held;
    this.held = null;
    for (const type of first) held.filter((one) => one.type === type).forEach((one) => this.take(one));
    held.filter((one) => !(first as readonly string[]).includes(one.type)).forEach((one) => this.take(one));
  }
}
