/** Chains of simplices as text. */
import type { Term } from "./data.ts";

/** As `sesame tower --json` has it. */
export function chainJson(chain: readonly Term[]): string {
  return `[${chain.map(([coefficient, labels]) => `[${JSON.stringify(coefficient)},[${labels.join(",")}]]`).join(",")}]`;
}

/** "{3 4} - 2 {4 5}", as the table of `sesame tower` has it; nothing is "0". */
export function chainSum(chain: readonly Term[], most = 60): string {
  let text = "";
  for (const [coefficient, labels] of chain.slice(0, most)) {
    const number = String(coefficient);
    const minus = number.startsWith("-");
    const size = minus ? number.slice(1) : number;
    text += text === "" ? (minus ? "-" : "") : minus ? " - " : " + ";
    text += `${size === "1" ? "" : `${size} `}{${labels.join(" ")}}`;
  }
  const more = chain.length - most;
  return (text || "0") + (more > 0 ? ` + \u2026 (${more} more terms)` : "");
}
