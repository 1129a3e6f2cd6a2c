/** The part of a page that goes on with its replay: how that is, and a field for steps if the page may send any. */
import { get } from "../elements.ts";
import type { News } from "./data.ts";
import { type Connection, linesLeft, listen, send, tokenOf } from "./live.ts";
import { patterns } from "./patterns.ts";

const states: Record<Connection, string> = {
  live: "live: this page grows with the replay",
  lost: "not connected: trying again",
  ended: "the replay has ended",
};

export class LivePanel {
  private readonly field = get<HTMLTextAreaElement>("lines");
  private readonly token = tokenOf(location.search);

  constructor({ place, writable }: { place: string; writable: boolean }, onNews: (news: News) => void) {
    get<HTMLElement>("live").hidden = false;
    listen(place, onNews, (state) => {
      get("connection").textContent = states[state];
      get("connection").className = state;
    });
    if (writable && this.token !== "") {
      this.allowWriting();
    } else if (writable) {
      get("refusal").textContent = "To send steps open the address that sesame printed: it has a token in it.";
    }
  }

  private allowWriting(): void {
    const form = get<HTMLFormElement>("send");
    form.hidden = false;
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.send(this.field.value, true);
    });
    this.field.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
        event.preventDefault();
        void this.send(this.field.value, true);
      }
    });
    get("undo").addEventListener("click", () => void this.send('{"op":"undo"}', false));
    const list = get<HTMLSelectElement>("patterns");
    list.append(new Option("insert a pattern", ""), ...patterns.map(([what, step]) => new Option(what, step)));
    list.addEventListener("change", () => {
      this.insert((this.isAtLineBegin() ? "" : "\n") + list.value);
      list.value = "";
    });
  }

  /** Writes the name of a cell where the caret is, if somebody writes. */
  insertName(name: string): void {
    if (!get<HTMLElement>("send").hidden) {
      this.insert(JSON.stringify(name));
    }
  }

  private isAtLineBegin(): boolean {
    return this.field.value.slice(0, this.field.selectionStart).split("\n").at(-1)!.trim() === "";
  }

  private insert(text: string): void {
    this.field.setRangeText(text, this.field.selectionStart, this.field.selectionEnd, "end");
    this.field.focus();
  }

  private async send(lines: string, isOfField: boolean): Promise<void> {
    if (lines.trim() === "") {
      return;
    }
    const sent = await send(lines, this.token);
    const left = linesLeft(lines, sent);
    get("refusal").textContent = sent.error ?? "";
    if (isOfField) {
      this.field.value = left;
      this.field.setAttribute("aria-invalid", String(sent.error !== undefined));
      if (sent.line !== undefined) {
        this.field.focus();
        this.field.setSelectionRange(0, left.split("\n", 1)[0].length); // the line that was refused
      }
    }
  }
}
