/** What is wrong with a mesh, as a list of places that one can go to. */
import { wholes } from "../packed.ts";
import { add, scale, type Vec } from "../vectors.ts";
import { type BadFace, type Data, type Mesh } from "./data.ts";
import { componentText, counted, numberText } from "./mesh_text.ts";

export interface Place {
  kind: "component" | "boundary" | "edge" | "vertex" | "reversed" | "line" | "face" | "meeting";
  title: string;
  text: string;
  /** Coordinates of the page: points that are marked, and segments, two ends each. */
  points: Vec[];
  segments: Vec[];
  /** What is to be in sight. */
  box: [Vec, Vec];
}

/** A kind of places: what it is called, how many there are in all, and those that are listed. */
export interface PlaceGroup {
  title: string;
  count: number;
  places: Place[];
}

const mostListed = 300;

export function boxOf(points: readonly Vec[]): [Vec, Vec] {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const point of points) {
    for (let axis = 0; axis < 3; ++axis) {
      low[axis] = Math.min(low[axis], point[axis]);
      high[axis] = Math.max(high[axis], point[axis]);
    }
  }
  return [low as unknown as Vec, high as unknown as Vec];
}

/** The ball around a box. */
export function ballOf([low, high]: [Vec, Vec]): { middle: Vec; radius: number } {
  const middle = scale(add(low, high), 0.5);
  return { middle, radius: Math.hypot(...high.map((x, axis) => x - middle[axis])) };
}

class PlaceList {
  readonly groups: PlaceGroup[] = [];

  constructor(private readonly data: Data, private readonly mesh: Mesh) {}

  private add(title: string, count: number, makes: (k: number) => Omit<Place, "box"> & { box?: [Vec, Vec] }, there = Infinity): void {
    if (count > 0) {
      const places = Array.from({ length: Math.min(count, mostListed, there) }, (_, k) => {
        const place = makes(k);
        return { ...place, box: place.box ?? boxOf([...place.points, ...place.segments]) };
      });
      this.groups.push({ title, count, places });
    }
  }

  private edgeName(from: number, to: number): string {
    return `edge ${this.mesh.inFile(from)}-${this.mesh.inFile(to)}`;
  }

  edges(title: string, kind: Place["kind"], ends: Uint32Array, text: string): void {
    this.add(title, ends.length / 2, (k) => {
      const [from, to] = [ends[2 * k], ends[2 * k + 1]];
      return { kind, title: this.edgeName(from, to), text, points: [], segments: [this.mesh.at(from), this.mesh.at(to)] };
    });
  }

  vertices(title: string, points: Uint32Array, text: string): void {
    this.add(title, points.length, (k) => ({
      kind: "vertex",
      title: `vertex ${this.mesh.inFile(points[k])}`,
      text,
      points: [this.mesh.at(points[k])],
      segments: [],
    }));
  }

  boundary(ends: Uint32Array, loopOf: Uint32Array): void {
    const loops: Vec[][] = Array.from({ length: this.data.boundary_loops }, () => []);
    loopOf.forEach((loop, k) => loops[loop].push(this.mesh.at(ends[2 * k]), this.mesh.at(ends[2 * k + 1])));
    this.add("Boundary loops", loops.length, (k) => {
      const segments = loops[k];
      let size = 0;
      for (let e = 0; e < segments.length; e += 2) {
        size += Math.hypot(...segments[e].map((x, axis) => segments[e + 1][axis] - x));
      }
      const length = numberText(size * this.data.frame.scale);
      return { kind: "boundary", title: `boundary ${k}`, text: `${counted(segments.length / 2, "edge", "edges")}, length ${length}`, points: [], segments };
    });
  }

  faces(title: string, count: number, faces: readonly BadFace[], text: string): void {
    this.add(title, count, (k) => {
      const { face, corners, points } = faces[k];
      const at = corners.map((_, c) => points.slice(3 * c, 3 * c + 3) as unknown as Vec);
      const segments = at.flatMap((from, c) => [from, at[(c + 1) % at.length]]);
      return { kind: "face", title: `face ${face}`, text: `${text}; corners ${corners.join(" ")}`, points: at, segments };
    }, faces.length);
  }

  meetings(): void {
    const { meetings, meetings_in_all, meetings_complete } = this.data;
    this.add(`Faces that meet${meetings_complete ? "" : " (not all pairs could be looked at)"}`, meetings_in_all, (k) => {
      const { faces, crosses, place, corners } = meetings[k];
      const segments = corners.flatMap((face) => face.flatMap((point, c) => [this.mesh.at(point), this.mesh.at(face[(c + 1) % face.length])]));
      const text = crosses ? "one goes through the other" : "they touch, or lie on each other";
      return { kind: "meeting", title: `faces ${faces.join(" and ")}`, text, points: [place], segments };
    }, meetings.length);
  }

  components(): void {
    const { components, components_in_all } = this.data;
    this.add("Components", components_in_all, (k) => ({
      kind: "component",
      title: `component ${k}`,
      text: componentText(components[k]),
      points: [],
      segments: [],
      box: components[k].box.map((corner) => this.mesh.fromFile(corner)) as [Vec, Vec],
    }), components.length);
  }
}

/** Everything that there is to go to, what is wrong first. */
export function placeGroups(data: Data, mesh: Mesh): PlaceGroup[] {
  const list = new PlaceList(data, mesh);
  const { places, bad_faces: bad } = data;
  list.edges("Edges on more than two faces", "edge", wholes(places.non_manifold_edges), "more than two faces meet");
  list.vertices("Vertices where sheets touch", wholes(places.non_manifold_vertices), "the faces around it are not one disc or fan");
  list.meetings();
  list.boundary(wholes(places.boundary), wholes(places.boundary_loop));
  list.edges("Edges across which faces disagree", "reversed", wholes(places.reversed_edges), "its two faces run along it in one direction");
  list.edges("Edges on no face", "line", wholes(places.lines), "a line");
  list.faces("Degenerate faces, left out", bad.degenerate_in_all, bad.degenerate, "fewer than three different corners");
  list.faces("Faces that are there twice, left out", bad.duplicate_in_all, bad.duplicate, "an earlier face has these corners");
  list.faces("Folded faces", bad.folded_in_all, bad.folded, "its boundary runs back over itself");
  list.components();
  return list.groups;
}
