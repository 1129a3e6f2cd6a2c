/** Lines of any width in pixels: two triangles a segment, a third of what those of three.js take. */
import { BufferAttribute, BufferGeometry, Color, Mesh, ShaderMaterial, Vector2 } from "three";

const vertexShader = `
attribute vec3 other;
attribute float side;
#ifdef USE_COLOR
varying vec3 vColor;
#endif
uniform vec2 resolution;
uniform float width;
void main() {
  vec4 here = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  vec4 there = projectionMatrix * modelViewMatrix * vec4(other, 1.0);
  // What is behind the camera is cut off, or it would turn up on the other side.
  float near = 1e-5;
  if (here.w < near) { here = mix(here, there, (near - here.w) / (there.w - here.w)); }
  if (there.w < near) { there = mix(there, here, (near - there.w) / (here.w - there.w)); }
  vec2 along = (there.xy / there.w - here.xy / here.w) * resolution;
  float size = length(along);
  along = size > 1e-6 ? along / size : vec2(1.0, 0.0);
  // Squares at the ends, so that segments which follow have no gaps.
  vec2 shift = width * (vec2(-along.y, along.x) * side - along * 0.5);
  here.xy += shift / resolution * here.w;
  gl_Position = here;
#ifdef USE_COLOR
  vColor = color;
#endif
}`;

const fragmentShader = `
uniform vec3 diffuse;
uniform float opacity;
#ifdef USE_COLOR
varying vec3 vColor;
#endif
void main() {
#ifdef USE_COLOR
  gl_FragColor = vec4(vColor, opacity);
#else
  gl_FragColor = vec4(diffuse, opacity);
#endif
  #include <colorspace_fragment>
}`;

/** `positions` of both ends of each segment; `colour` for all, or of each end, linear. */
export function wideLines(positions: ArrayLike<number>, colour: number | ArrayLike<number>, width: number, opacity = 1): Mesh {
  const segments = positions.length / 6;
  const here = new Float32Array(12 * segments);
  const other = new Float32Array(12 * segments);
  const side = new Float32Array(4 * segments);
  const colours = typeof colour === "number" ? null : new Float32Array(12 * segments);
  const corners = new Uint32Array(6 * segments);
  for (let s = 0; s < segments; ++s) {
    for (let k = 0; k < 4; ++k) {
      const end = k < 2 ? 0 : 1;
      for (let axis = 0; axis < 3; ++axis) {
        here[12 * s + 3 * k + axis] = positions[6 * s + 3 * end + axis];
        other[12 * s + 3 * k + axis] = positions[6 * s + 3 * (1 - end) + axis];
        if (colours) {
          colours[12 * s + 3 * k + axis] = (colour as ArrayLike<number>)[6 * s + 3 * end + axis];
        }
      }
      side[4 * s + k] = k % 2 === 0 ? 1 : -1;
    }
    // At the far end left and right are exchanged, as the line runs the other way there.
    corners.set([4 * s, 4 * s + 1, 4 * s + 2, 4 * s, 4 * s + 2, 4 * s + 3], 6 * s);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(here, 3));
  geometry.setAttribute("other", new BufferAttribute(other, 3));
  geometry.setAttribute("side", new BufferAttribute(side, 1));
  if (colours) {
    geometry.setAttribute("color", new BufferAttribute(colours, 3));
  }
  geometry.setIndex(new BufferAttribute(corners, 1));
  const resolution = new Vector2(1, 1);
  const material = new ShaderMaterial({
    vertexShader,
    fragmentShader,
    vertexColors: colours !== null,
    transparent: opacity < 1,
    uniforms: { resolution: { value: resolution }, width: { value: width }, opacity: { value: opacity }, diffuse: { value: new Color(colours ? 0 : (colour as number)) } },
    side: 2,
  });
  const lines = new Mesh(geometry, material);
  lines.onBeforeRender = (renderer) => renderer.getSize(resolution); // as large as the page has it, not in its own pixels
  return lines;
}
