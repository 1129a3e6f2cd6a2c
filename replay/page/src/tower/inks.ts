/** The colours of pictures, on white paper and on dark: those of page.css, as numbers for canvases and SVG files. */

export interface Inks {
  paper: string;
  text: string;
  weak: string;
  line: string;
  mark: string;
  press: string;
  dims: readonly string[];
}

export const lightInks: Inks = {
  paper: "#ffffff",
  text: "#1f2429",
  weak: "#59636d",
  line: "#d5dbe1",
  mark: "#b36b00",
  press: "#dcebf7",
  dims: ["#0072b2", "#c24e00", "#00805d", "#a8478a", "#2f7fb0", "#857300", "#6a3fb0", "#7a4a40"],
};

export const darkInks: Inks = {
  paper: "#15181c",
  text: "#e6e9ec",
  weak: "#a3acb5",
  line: "#363d45",
  mark: "#f0b429",
  press: "#24425b",
  dims: ["#56b4e9", "#ff8c42", "#2fc79b", "#e79cc9", "#8ecdf0", "#d9c63a", "#b696f0", "#cf9a8d"],
};

export const inkOf = (inks: Inks, dim: number) => inks.dims[dim % inks.dims.length];

/** Of dimensions, beside their colours. */
export type Shape = "circle" | "square" | "triangle" | "diamond";

export const shapeOf = (dim: number): Shape => (["circle", "square", "triangle", "diamond"] as const)[(dim + Math.floor(dim / 8)) % 4];

export const dashesOf = (dim: number): number[] => [[], [7, 3], [2, 3], [9, 3, 2, 3], [1, 2]][dim % 5];
