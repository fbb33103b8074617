// Bodies of vehicles as they are, in any number with one draw call.

import * as THREE from "three";
import { SWARM, type Frames } from "./frames";
import { LIGHT, type Shared } from "./light";

const BETWEEN = /* glsl */ `
varying vec3 vColour, vNormal2, vToEye;
varying float vAway;
`;

const VERTEX = /* glsl */ `
${BETWEEN}
${SWARM}
attribute vec4 tint;
attribute float vehicle;
uniform vec3 uViewport;
/** The least radius on the screen, in CSS pixels; the radius of the geometry, 0: that of the vehicle. */
uniform float uLeast, uRadius;
void main() {
  vec4 place = placeOf(vehicle);
  vec4 turn = turnOf(vehicle);
  vec4 middle = uSee * vec4(place.xyz, 1.0);
  float pixel = 2.0 * middle.w / (projectionMatrix[1][1] * uViewport.y) * uViewport.z;
  float size = uRadius > 0.0 ? max(1.0, uLeast * pixel / uRadius) : max(place.w, uLeast * pixel);
  vec3 world = place.xyz + turned(turn, position) * size;
  vNormal2 = turned(turn, normal);
  vColour = mix(colourOf(vehicle).rgb, tint.rgb, tint.a);
  vColour *= vColour;
  vToEye = uFlat > 0.5 ? vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2]) : cameraPosition - world;
  vAway = middle.w;
  gl_Position = uSee * vec4(world, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
${BETWEEN}
${LIGHT}
uniform float uOpacity, uGlow;
void main() {
  vec3 n = normalize(vNormal2);
  vec3 eye = normalize(vToEye);
  if (dot(n, eye) < 0.0) n = -n;
  vec3 colour = lit(vColour, n, 1.0) + vColour * uGlow;
  // Edges darker, so that a body stands out from one of the same colour behind it.
  colour *= mix(0.42, 1.0, smoothstep(0.0, 0.5, dot(n, eye)));
  gl_FragColor = vec4(toSrgb(mix(colour, hazed(colour, vAway), 0.6)), uOpacity);
}
`;

/** A geometry once for each of some vehicles. */
export function instances(body: THREE.BufferGeometry, who: ArrayLike<number>): THREE.InstancedBufferGeometry {
  const g = new THREE.InstancedBufferGeometry();
  for (const name of Object.keys(body.attributes)) g.setAttribute(name, body.getAttribute(name));
  g.setIndex(body.index);
  g.setAttribute("vehicle", new THREE.InstancedBufferAttribute(Float32Array.from(who), 1));
  g.instanceCount = who.length;
  return g;
}

export interface BodyOptions {
  /** The least radius on the screen, CSS pixels. */
  least_px: number;
  /** The radius of the geometry, m; 0: the geometry has radius 1, and is as large as its vehicle. */
  radius_m: number;
  /** Only announced: seen through. */
  ghost: boolean;
}

/** The vehicles `who`, each with this body. */
export function bodies(
  body: THREE.BufferGeometry,
  who: ArrayLike<number>,
  frames: Frames,
  shared: Shared,
  glow: THREE.IUniform<number>,
  { least_px, radius_m, ghost }: BodyOptions,
): THREE.Mesh<THREE.InstancedBufferGeometry, THREE.ShaderMaterial> {
  const material = new THREE.ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      ...shared,
      ...frames.uniforms,
      uLeast: { value: least_px },
      uRadius: { value: radius_m },
      uOpacity: { value: ghost ? 0.42 : 1 },
      uGlow: glow,
    },
    transparent: ghost,
    depthWrite: !ghost,
    side: THREE.DoubleSide,
  });
  const mesh = new THREE.Mesh(instances(body, who), material);
  mesh.frustumCulled = false;
  mesh.renderOrder = ghost ? 30 : 5;
  return mesh;
}
