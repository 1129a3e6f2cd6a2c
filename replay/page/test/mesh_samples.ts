/** A small mesh as C++ would write it. */
import type { Data } from "../src/mesh/data.ts";
import type { Packed } from "../src/packed.ts";

const packed = (kind: Packed["kind"], numbers: { buffer: ArrayBufferLike }): Packed => ({ kind, data: Buffer.from(numbers.buffer as ArrayBuffer).toString("base64") });
export const packedFloats = (numbers: number[]): Packed => packed("f32", Float32Array.from(numbers));
export const packedWholes = (numbers: number[]): Packed => packed("u32", Uint32Array.from(numbers));

/** A square of two triangles, from (10, 10, 5) to (30, 30, 5) in its file, where face 2 is face 0 again. */
export function squareMesh(): Data {
  return {
    version: "0",
    source: "square.off",
    stem: "square",
    ring: "Z",
    points_in_file: 4,
    faces_in_file: 3,
    vertices: 4,
    edges: 5,
    faces: 2,
    polygons: 0,
    euler: 1,
    manifold: true,
    closed: false,
    orientable: true,
    consistently_oriented: true,
    boundary_loops: 1,
    remarks: [],
    components_in_all: 1,
    components: [
      { vertices: 4, edges: 5, faces: 2, euler: 1, boundary_loops: 1, manifold: true, orientable: true, closed: false, genus: 0, unsorted: "it has a boundary, so it has no inside", box: [[10, 10, 5], [30, 30, 5]] },
    ],
    betti: [1, 0, 0],
    torsion: [[], [], []],
    loops_tried: 0,
    frame: { middle: [20, 20, 5], scale: 10 },
    points: packedFloats([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]),
    numbers: null,
    part: null,
    triangles_in_all: 2,
    stride: 1,
    triangles: packedWholes([0, 1, 2, 0, 2, 3]),
    sides: packedWholes([0, 1, 0, 2, 0, 3, 1, 2, 2, 3]),
    places: {
      lines: packedWholes([]),
      boundary: packedWholes([0, 1, 0, 3, 1, 2, 2, 3]),
      boundary_loop: packedWholes([0, 0, 0, 0]),
      non_manifold_edges: packedWholes([]),
      non_manifold_vertices: packedWholes([]),
      reversed_edges: packedWholes([]),
    },
    meetings_in_all: 0,
    meetings_complete: true,
    meetings: [],
    bad_faces: {
      degenerate_in_all: 0,
      degenerate: [],
      duplicate_in_all: 1,
      duplicate: [{ face: 2, corners: [0, 1, 2], points: [-1, -1, 0, 1, -1, 0, 1, 1, 0] }],
      folded_in_all: 0,
      folded: [],
    },
    generators: true,
    shorter_than: null,
    loops_in_all: 0,
    loops: [],
    surfaces_in_all: 0,
    surfaces: [],
  };
}
