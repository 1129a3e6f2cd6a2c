/** What is said of the thing that is chosen. */
import { button, copy, paragraph } from "../elements.ts";
import type { Component, Loop, Mesh, Surface } from "./data.ts";
import { boxText, counted, numberText, orderText, pointText, roundingOfPage, sideMeaning, sideText, sizeOfBox, verticesText } from "./mesh_text.ts";
import type { Place } from "./places.ts";
import { lineSwatch } from "./swatch.ts";

function heading(text: string, ...before: Node[]): HTMLElement {
  const made = document.createElement("h2");
  made.append(...before, text);
  return made;
}

function list(rows: readonly (readonly [string, string])[]): HTMLElement {
  const made = document.createElement("dl");
  for (const [name, text] of rows.filter(([, text]) => text !== "")) {
    const [term, value] = [document.createElement("dt"), document.createElement("dd")];
    [term.textContent, value.textContent] = [name, text];
    value.dataset.name = name;
    made.append(term, value);
  }
  return made;
}

function buttons(...made: HTMLButtonElement[]): HTMLElement {
  const row = document.createElement("p");
  row.className = "buttons";
  row.append(...made);
  return row;
}

export function loopDetails(loop: Loop, number: number, mesh: Mesh, components: readonly Component[], onFly: () => void): Node[] {
  const size = sizeOfBox(loop.box);
  const name = loop.side ? `${loop.side[0].toUpperCase()}${loop.side.slice(1)} loop` : "Loop";
  const text = document.createElement("textarea");
  text.readOnly = true;
  text.rows = 2;
  text.value = verticesText(loop, mesh);
  text.setAttribute("aria-label", loop.closed ? "vertices along the loop" : "edges of the cycle");
  const rows: [string, string][] = [
    ["length", numberText(loop.length)],
    ["order", orderText(loop.order)],
    ["edges", String(loop.edges.length / 2)],
    ["centre", pointText(loop.centre, size)],
    ["box", boxText(loop.box)],
    ["component", components.length > 1 ? String(loop.component) : ""],
    ["note", loop.closed ? (loop.short ? "" : "not shortened: any cycle of its class") : "not one simple loop: a cycle of several, or one that meets itself"],
  ];
  return [
    heading(`${name} ${number + 1}`, lineSwatch(loop.side)),
    paragraph(sideMeaning(loop, components)),
    list(rows),
    paragraph(loop.closed ? "Its vertices, as the file counts them from 0:" : "Its edges, by their vertices:", "weak"),
    text,
    buttons(button("copy", (made) => void copy(text.value, made)), button("fly to", onFly)),
  ];
}

export function surfaceDetails(surface: Surface, number: number, onFly: () => void): Node[] {
  const size = sizeOfBox(surface.box);
  const inwards = typeof surface.volume === "number" && surface.volume < 0 ? " (the faces point inwards)" : "";
  return [
    heading(`Closed surface ${number + 1}`),
    list([
      ["triangles", String(surface.triangles)],
      ["area", numberText(surface.area)],
      ["volume", surface.volume === null ? "" : numberText(surface.volume) + inwards],
      ["order", orderText(surface.order)],
      ["centre", pointText(surface.centre, size)],
      ["box", boxText(surface.box)],
    ]),
    buttons(button("fly to", onFly)),
  ];
}

export function placeDetails(place: Place, mesh: Mesh, onFly: () => void): Node[] {
  const box = place.box.map((corner) => mesh.toFile(corner)) as Place["box"];
  return [
    heading(`${place.title[0].toUpperCase()}${place.title.slice(1)}`),
    list([
      ["what", place.text],
      ["box", boxText(box, roundingOfPage)],
    ]),
    buttons(button("fly to", onFly)),
  ];
}

/** What a row of the list of loops says. */
export function loopRow(loop: Loop, severalComponents: boolean): [string, string][] {
  const edges = counted(loop.edges.length / 2, "edge", "edges");
  const rest = [edges, ...(loop.order === "0" ? [] : [`order ${loop.order}`]), ...(severalComponents ? [`component ${loop.component}`] : [])];
  return [
    ["what", sideText(loop)],
    ["number", numberText(loop.length)],
    ["rest", rest.join(", ")],
  ];
}
