/** What pictures are made of, from lists of numbers. */
import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  CylinderGeometry,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  Points,
  PointsMaterial,
  Quaternion,
  type ShaderMaterial,
  SphereGeometry,
  type Texture,
  Vector3,
} from "three";
import type { FaceBuffers, LineBuffers } from "./buffers.ts";
import { flatFaces } from "./flat_faces.ts";
import { litFaces } from "./lit_faces.ts";
import type { Vec } from "./vectors.ts";

/** Of more triangles than this that are seen through, back sides are not drawn before front sides: which is in front of which is chance anyway. */
const mostSortedTriangles = 5000;

/** Points that several parts have: they stay on the graphics card when one of these is forgotten. */
const shared = new WeakSet<object>();

export function sharedPoints(points: Float32Array): BufferAttribute {
  const attribute = new BufferAttribute(points, 3);
  shared.add(attribute);
  return attribute;
}

/** Frees what it has on the graphics card. */
export function forget(part: Mesh | LineSegments | Points | InstancedMesh): void {
  const material = part.material as Material & { map?: Texture | null };
  for (const [name, attribute] of Object.entries(part.geometry.attributes)) {
    if (shared.has(attribute)) {
      part.geometry.deleteAttribute(name);
    }
  }
  part.geometry.dispose();
  material.map?.dispose();
  material.dispose();
  if ("dispose" in part) {
    part.dispose();
  }
}

/** Faces with a normal and a colour at each corner. */
export function facesPart({ positions, normals, colours }: FaceBuffers, opacity: number, pushesBack: boolean): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(normals, 3));
  geometry.setAttribute("color", new BufferAttribute(colours, 3));
  return new Mesh(geometry, litFaces(opacity, pushesBack, positions.length > 9 * mostSortedTriangles));
}

/** Stand for many faces that are seen through, thin edges and vertices: the shaders of these are those of any. */
export function partsOfLargeObjects(): (Mesh | LineSegments | Points)[] {
  const none = new Float32Array(9);
  const geometry = new BufferGeometry();
  for (const name of ["position", "normal", "color"]) {
    geometry.setAttribute(name, new BufferAttribute(none, 3));
  }
  return [new Mesh(geometry, litFaces(0.5, true, true)), colouredLinesPart({ positions: [...none], colours: [...none], cells: [] }, 0.5), dotsPart(none, 0, 1)];
}

/** Flat triangles that share their points, by number; `colours` of points, or one for all. */
export function trianglesPart(points: BufferAttribute, corners: Uint32Array, colours: BufferAttribute | number, pushesBack = true): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", points);
  geometry.setIndex(new BufferAttribute(corners, 1));
  if (typeof colours !== "number") {
    geometry.setAttribute("color", colours);
  }
  return new Mesh(geometry, flatFaces(typeof colours === "number" ? colours : null, pushesBack));
}

/** As solid as this, from then on. */
export function setOpacity(part: Mesh, opacity: number): void {
  const material = part.material as ShaderMaterial;
  material.uniforms.opacity.value = opacity;
  material.transparent = opacity < 1;
  material.depthWrite = opacity >= 1;
}

/** Lines of one pixel between points, by number: however many, they cost little. */
export function thinLinesPart(points: BufferAttribute, ends: Uint32Array, colour: number, opacity = 1): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", points);
  geometry.setIndex(new BufferAttribute(ends, 1));
  return new LineSegments(geometry, new LineBasicMaterial({ color: colour, transparent: opacity < 1, opacity }));
}

/** Lines of one pixel, each end with its colour. */
export function colouredLinesPart({ positions, colours }: LineBuffers, opacity: number): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(colours), 3));
  return new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true, transparent: opacity < 1, opacity }));
}

/** Dots of a size in pixels. */
export function dotsPart(positions: Float32Array, colour: number, size: number): Points {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  return new Points(geometry, new PointsMaterial({ color: colour, size, sizeAttenuation: false }));
}

/** Rings of a size in pixels around points, in front of everything: so what is marked is found. */
export function ringsPart(positions: Float32Array, colour: number, size: number): Points {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [64, 64];
  const context = canvas.getContext("2d")!;
  context.strokeStyle = "#fff";
  context.lineWidth = 9;
  context.arc(32, 32, 25, 0, 2 * Math.PI);
  context.stroke();
  const part = dotsPart(positions, colour, size);
  const material = part.material as PointsMaterial;
  material.map = new CanvasTexture(canvas);
  material.transparent = true;
  material.depthTest = false;
  material.alphaTest = 0.2;
  return part;
}

/** Round bars along segments, two points each. */
export function tubesPart(segments: readonly (readonly [Vec, Vec])[], radius: number, colour: number): InstancedMesh {
  const material = new MeshLambertMaterial({ color: colour });
  const tubes = new InstancedMesh(new CylinderGeometry(1, 1, 1, 10, 1, true), material, segments.length);
  const up = new Vector3(0, 1, 0);
  segments.forEach(([from, to], k) => {
    const [a, b] = [new Vector3(...from), new Vector3(...to)];
    const line = b.clone().sub(a);
    const size = line.length();
    const turn = new Quaternion().setFromUnitVectors(up, line.normalize());
    tubes.setMatrixAt(k, new Matrix4().compose(a.add(b).multiplyScalar(0.5), turn, new Vector3(radius, size, radius)));
  });
  return tubes;
}

export function ballsPart(centres: readonly Vec[], radius: number, colour: number): InstancedMesh {
  const balls = new InstancedMesh(new SphereGeometry(1, 12, 8), new MeshLambertMaterial({ color: colour }), centres.length);
  centres.forEach((at, k) => {
    balls.setMatrixAt(k, new Matrix4().makeScale(radius, radius, radius).setPosition(...(at as [number, number, number])));
  });
  return balls;
}
