/** What a page says to the server of its replay, and hears from it. */
import type { News } from "./data.ts";

/** What became of steps that were sent. */
export interface Sent {
  taken: number;
  /** Of the first one that did not happen: its line, counted from 1, and why. */
  line?: number;
  error?: string;
}

/** The token is in the address that sesame printed. */
export function tokenOf(search: string): string {
  return new URLSearchParams(search).get("token") ?? "";
}

/** Sends lines as a script has them. What goes wrong on the way is an error without a line. */
export async function send(lines: string, token: string): Promise<Sent> {
  try {
    const answer = await fetch("/steps", { method: "POST", headers: { "X-Sesame-Token": token, "Content-Type": "text/plain" }, body: lines });
    return { taken: 0, ...((await answer.json()) as object) };
  } catch (error) {
    return { taken: 0, error: `The server does not answer (${(error as Error).message}).` };
  }
}

/** The lines that are left of those that were sent: from the one on that was refused, or none. */
export function linesLeft(lines: string, { line, error }: Sent): string {
  if (error === undefined) {
    return "";
  }
  return line === undefined ? lines : lines.split("\n").slice(line - 1).join("\n");
}

export type Connection = "live" | "lost" | "ended";

/** Hears what is new, until the page is left. */
export function listen(place: string, onNews: (news: News) => void, onState: (state: Connection) => void): void {
  const source = new EventSource(`/events?after=${place}`);
  source.addEventListener("open", () => onState("live"));
  source.addEventListener("message", (event) => onNews(JSON.parse(event.data) as News));
  source.addEventListener("other", () => {
    source.close();
    location.reload();
  });
  source.addEventListener("ended", () => onState("ended"));
  source.addEventListener("error", () => onState("lost")); // which comes again by itself
}
