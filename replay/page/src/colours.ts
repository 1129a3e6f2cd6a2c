/** Colours that colour-blind people can tell apart (Okabe and Ito), for light and for dark. */

export interface Theme {
  dark: boolean;
  background: number;
  face: number;
  edge: number;
  vertex: number;
  highlight: number;
}

export const light: Theme = { dark: false, background: 0xffffff, face: 0x8fb8d8, edge: 0x3c4650, vertex: 0x22282e, highlight: 0xe69f00 };
export const dark: Theme = { dark: true, background: 0x15181c, face: 0x3f6f96, edge: 0xaab4be, vertex: 0xdfe5ea, highlight: 0xf0b429 };

/** Of components, and of generators of each dimension. */
export const palette = [0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0x56b4e9, 0xb59b00, 0x7f4fc9, 0x8c564b];

/** Generators begin at another colour than components, and never with the highlight. */
export function colourOfGenerator(index: number): number {
  return [0xd55e00, 0x009e73, 0xcc79a7, 0x7f4fc9, 0x0072b2, 0x56b4e9, 0xb59b00][index % 7];
}

export function cssColour(colour: number): string {
  return `#${colour.toString(16).padStart(6, "0")}`;
}
