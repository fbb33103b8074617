// A soft shadow on the ground under each small flyer: how high it flies is seen by the distance.

import * as THREE from "three";
import { instances } from "./bodies";
import { SWARM, type Frames } from "./frames";
import type { Shared } from "./light";

const VERTEX = /* glsl */ `
${SWARM}
attribute float vehicle;
uniform vec3 uViewport;
uniform float uLeast, uStrength;
varying vec2 vAt;
varying float vDark;
void main() {
  vec4 place = placeOf(vehicle);
  vec4 middle = uSee * vec4(place.xy, 0.0, 1.0);
  float pixel = 2.0 * middle.w / (projectionMatrix[1][1] * uViewport.y) * uViewport.z;
  float size = max(place.w, uLeast * pixel);
  float height = max(place.z, 0.0) / size;
  // The higher, the wider and the fainter.
  float wide = size * (1.2 + min(height * 0.02, 0.8));
  vDark = uStrength / (1.0 + height * 0.012);
  vAt = position.xy;
  gl_Position = uSee * vec4(place.xy + position.xy * wide, 0.0, 1.0);
  gl_Position.z -= 1e-5 * gl_Position.w;
  if (!(place.z > -size)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
varying vec2 vAt;
varying float vDark;
void main() {
  float r = dot(vAt, vAt);
  if (r > 1.0) discard;
  gl_FragColor = vec4(0.02, 0.05, 0.1, vDark * (1.0 - r) * (1.0 - r));
}
`;

/** `strength`: how dark a shadow is right below its flyer, 0 to 1. */
export function blobs(who: number[], least_px: number, strength: THREE.IUniform<number>, frames: Frames, shared: Shared): THREE.Mesh<THREE.InstancedBufferGeometry, THREE.ShaderMaterial> {
  const square = new THREE.PlaneGeometry(2, 2);
  square.deleteAttribute("normal");
  square.deleteAttribute("uv");
  const material = new THREE.ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...shared, ...frames.uniforms, uLeast: { value: least_px }, uStrength: strength },
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
  });
  const mesh = new THREE.Mesh(instances(square, who), material);
  mesh.frustumCulled = false;
  mesh.renderOrder = 2;
  return mesh;
}
