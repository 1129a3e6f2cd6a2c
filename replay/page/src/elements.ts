/** Small parts of pages. */

/** The element of this id, which is there. */
export function get<T extends Element>(id: string): T {
  return document.getElementById(id) as unknown as T;
}

export function paragraph(text: string, name = ""): HTMLParagraphElement {
  const made = document.createElement("p");
  made.textContent = text;
  made.className = name;
  return made;
}

export function button(text: string, onClick: (made: HTMLButtonElement) => void): HTMLButtonElement {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = text;
  made.addEventListener("click", () => onClick(made));
  return made;
}

/** Into the clipboard; pages that are opened from a disk may not use the one of today, so the old way follows. */
export async function copy(text: string, from: HTMLButtonElement): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = document.createElement("textarea");
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
    from.focus();
  }
  from.textContent = "copied";
  setTimeout(() => (from.textContent = "copy"), 1200);
}
