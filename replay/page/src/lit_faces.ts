/** Faces with a normal at each point, lit as MeshLambertMaterial has them, by a shader that is a tenth as long. */
import { DoubleSide, ShaderMaterial } from "three";

// The sun of scene.ts goes with the camera and shines towards the origin of space.
const vertexShader = `
varying vec3 vNormal;
varying vec3 vColor;
varying vec3 vSun;
void main() {
  vNormal = normalMatrix * normal;
  vColor = color;
  vSun = normalize(vec3(1.0, 2.0, 3.0) - viewMatrix[3].xyz);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const fragmentShader = `
uniform float opacity;
varying vec3 vNormal;
varying vec3 vColor;
varying vec3 vSun;
void main() {
  vec3 normal = normalize(gl_FrontFacing ? vNormal : -vNormal);
#ifdef FLIP_SIDED
  normal = -normal; // three.js has exchanged what is in front, to draw back sides first
#endif
  gl_FragColor = vec4(vColor * (0.47746 + 0.57296 * max(dot(normal, vSun), 0.0)), opacity);
  #include <colorspace_fragment>
}`;

/** `isOnce`: what is seen through is drawn in one pass, not its back sides first, which takes twice as long. */
export function litFaces(opacity: number, pushesBack: boolean, isOnce: boolean): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    vertexColors: true,
    uniforms: { opacity: { value: opacity } },
    side: DoubleSide,
    forceSinglePass: isOnce,
    transparent: opacity < 1,
    depthWrite: opacity >= 1,
    polygonOffset: true,
    polygonOffsetFactor: pushesBack ? 1 : -1,
    polygonOffsetUnits: pushesBack ? 1 : -1,
  });
}
