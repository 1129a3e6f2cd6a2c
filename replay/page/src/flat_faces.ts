/** Flat faces, lit as those of three.js are, by a shader that is a tenth as long: it is ready sooner, and costs less. */
import { Color, DoubleSide, ShaderMaterial } from "three";

const vertexShader = `
varying vec3 vPlace;
#ifdef USE_COLOR
varying vec3 vColor;
#endif
void main() {
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  vPlace = place.xyz;
  gl_Position = projectionMatrix * place;
#ifdef USE_COLOR
  vColor = color;
#endif
}`;

// The sun of scene.ts, which goes with the camera, and its light from everywhere.
const fragmentShader = `
uniform vec3 diffuse;
uniform float opacity;
varying vec3 vPlace;
#ifdef USE_COLOR
varying vec3 vColor;
#endif
void main() {
  vec3 normal = normalize(cross(dFdx(vPlace), dFdy(vPlace)));
  float sun = max(dot(normal, vec3(0.2673, 0.5345, 0.8018)), 0.0);
  vec3 colour = diffuse;
#ifdef USE_COLOR
  colour *= vColor;
#endif
  gl_FragColor = vec4(colour * (0.4775 + 0.573 * sun), opacity);
  #include <colorspace_fragment>
}`;

/** `colour`: of all faces; or they have one at each point. */
export function flatFaces(colour: number | null, pushesBack: boolean): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    vertexColors: colour === null,
    uniforms: { diffuse: { value: new Color(colour ?? 0xffffff) }, opacity: { value: 1 } },
    side: DoubleSide,
    forceSinglePass: true, // or what is seen through is drawn twice
    polygonOffset: true,
    polygonOffsetFactor: pushesBack ? 1 : -1,
    polygonOffsetUnits: pushesBack ? 1 : -1,
  });
}
