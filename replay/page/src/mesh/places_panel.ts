/** The list of places: what is wrong with the mesh and where, and its components. */
import { Listing, type Row } from "./listing.ts";
import type { Place, PlaceGroup } from "./places.ts";

function part(name: string, text: string): HTMLElement {
  const made = document.createElement("span");
  [made.className, made.textContent] = [name, text];
  return made;
}

export class PlacesPanel {
  private readonly places: Place[];
  private readonly lists: { list: Listing; first: number }[] = [];

  /** Makes a list with a title for each kind of places; `on` is told numbers over all of them. */
  constructor(into: HTMLElement, groups: readonly PlaceGroup[], on: { onChoose: (place: number) => void; onOpen: (place: number) => void }) {
    this.places = groups.flatMap(({ places }) => places);
    into.classList.remove("list");
    into.removeAttribute("aria-label");
    let first = 0;
    for (const { title, count, places } of groups) {
      const here = first;
      const box = document.createElement("div");
      box.className = "list";
      box.setAttribute("aria-label", title);
      const rows: Row[] = places.map((place) => ({ parts: [part("what", place.title), part("rest", place.text)], title: place.text }));
      const head = document.createElement("p");
      head.className = "places-head";
      head.textContent = `${title}: ${count}${count > places.length ? `, the first ${places.length} are listed` : ""}`;
      into.append(head, box);
      const list = new Listing(
        box,
        (row) => {
          this.lists.forEach((other) => other.list !== list && other.list.mark(-1));
          on.onChoose(row < 0 ? -1 : here + row);
        },
        (row) => on.onOpen(here + row),
      );
      list.fill(rows);
      this.lists.push({ list, first });
      first += places.length;
    }
  }

  at(place: number): Place {
    return this.places[place];
  }

  mark(place: number): void {
    for (const [k, { list, first }] of this.lists.entries()) {
      const end = this.lists[k + 1]?.first ?? this.places.length;
      list.mark(place >= first && place < end ? place - first : -1);
    }
  }
}
