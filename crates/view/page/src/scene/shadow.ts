// Shadows of what stands still: drawn seldom, from the sun, as a picture of depths. Vehicles have their own way
// (vehicles.ts), so a shadow costs nothing while they fly.

import * as THREE from "three";
import type { Shared } from "./light";

/** Worlds wider than this have none: a texel would be wider than what throws the shadow. */
const WIDEST_M = 3000;

export interface Shadows {
  /** Once more: something was cut away, or the graphics card has forgotten them. */
  draw(): void;
  dispose(): void;
}

/** Draws the shadows of `group`, so many texels wide, if `bounds` is not too wide. */
export function castShadows(renderer: THREE.WebGLRenderer, group: THREE.Object3D, bounds: THREE.Box3, shared: Shared, texels: number): Shadows {
  const size = bounds.getSize(new THREE.Vector3());
  if (bounds.isEmpty() || size.length() > WIDEST_M) return { draw: () => undefined, dispose: () => undefined };
  const sun = shared.uSun.value;
  const middle = bounds.getCenter(new THREE.Vector3());
  // What reaches from the ground up throws its shadow down there: the picture must hold both.
  const camera = new THREE.OrthographicCamera();
  camera.up.set(0, 0, 1);
  camera.position.copy(middle).addScaledVector(sun, size.length() + 1);
  camera.lookAt(middle);
  camera.updateMatrixWorld(true);
  const box = new THREE.Box3();
  const ends = [bounds.min, bounds.max];
  for (let i = 0; i < 8; i++) {
    const corner = new THREE.Vector3(ends[i & 1]!.x, ends[(i >> 1) & 1]!.y, ends[(i >> 2) & 1]!.z);
    box.expandByPoint(corner.clone().applyMatrix4(camera.matrixWorldInverse));
    corner.addScaledVector(sun, -Math.max(corner.z, 0) / sun.z);
    box.expandByPoint(corner.applyMatrix4(camera.matrixWorldInverse));
  }
  const margin = size.length() * 0.01 + 0.05;
  camera.left = box.min.x - margin;
  camera.right = box.max.x + margin;
  camera.bottom = box.min.y - margin;
  camera.top = box.max.y + margin;
  camera.near = -box.max.z - margin;
  camera.far = -box.min.z + margin;
  camera.updateProjectionMatrix();

  const depth = new THREE.DepthTexture(texels, texels, THREE.UnsignedIntType);
  depth.minFilter = depth.magFilter = THREE.NearestFilter;
  const target = new THREE.WebGLRenderTarget(texels, texels, { depthTexture: depth, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter });
  const material = new THREE.ShaderMaterial({
    uniforms: { uCeiling: shared.uCeiling },
    vertexShader: /* glsl */ `
      attribute float foot;
      uniform float uCeiling;
      void main() {
        vec4 at = vec4(position, 1.0);
        #ifdef USE_INSTANCING
        at = instanceMatrix * at;
        #endif
        gl_Position = foot < uCeiling ? projectionMatrix * viewMatrix * at : vec4(2.0, 2.0, 2.0, 1.0);
      }`,
    fragmentShader: "void main() { gl_FragColor = vec4(1.0); }",
    side: THREE.DoubleSide,
  });
  const scene = new THREE.Scene();
  scene.overrideMaterial = material;
  const draw = () => {
    const { parent } = group;
    scene.add(group);
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    scene.remove(group);
    parent?.add(group);
  };
  draw();

  shared.uShadow.value = depth;
  shared.uShadowFrom.value.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  const texel = Math.max(camera.right - camera.left, camera.top - camera.bottom) / texels;
  shared.uShadowDepth.value = (texel * 2) / (camera.far - camera.near) + 1e-5;
  return {
    draw,
    dispose() {
      material.dispose();
      target.dispose();
    },
  };
}
