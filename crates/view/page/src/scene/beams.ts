// What the sensors of the selected vehicle look along, in the frames of their mounts on the moving body.
//
// Rays go as far as they were measured, with a dot where they hit; a ray that met nothing is drawn fainter, to its
// range.

import * as THREE from "three";
import type { Details, SensorDetails, Vec3 } from "../wire";
import type { Frames } from "./frames";
import type { Shared } from "./light";
import { Lines } from "./lines";
import { rotate, scale, unit } from "./math";

const MOST_RAYS = 6000;
const COLOURS = ["#f03a5f", "#0099cf", "#e08600", "#9455e0", "#2f9e6e", "#dd4aa0"];

/** Lengths of rays from a reading: its first column of metres, if it has as many rows as there are rays. */
export function rayLengths(sensor: SensorDetails, rays: number): (number | null)[] | null {
  const { reading, columns } = sensor;
  const wide = Math.max(columns.length, 1);
  const column = columns.findIndex(([, unit]) => unit === "m");
  if (!reading || column < 0 || reading.length !== rays * wide || sensor.lost) return null;
  return Array.from({ length: rays }, (_, i) => reading[i * wide + column] ?? null);
}

interface Ray {
  /** Body frame. */
  from: Vec3;
  along: Vec3;
  length: number;
  hit: boolean;
  colour: [number, number, number];
}

export class Beams {
  readonly group = new THREE.Group();
  private lines: Lines;
  private volumes = new THREE.Group();
  private dots: THREE.Points<THREE.BufferGeometry, THREE.ShaderMaterial>;
  private rays: Ray[] = [];
  private vehicle: number | null = null;
  private quaternion = new THREE.Quaternion();
  private from = new THREE.Vector3();
  private to = new THREE.Vector3();
  private a: Vec3 = [0, 0, 0];
  private b: Vec3 = [0, 0, 0];
  private rgba = new Uint8Array(4);

  constructor(
    private frames: Frames,
    shared: Shared,
    private reach: () => number,
  ) {
    this.lines = new Lines(MOST_RAYS, frames, shared, { width_px: 1.6, order: 15 });
    const g = new THREE.BufferGeometry();
    g.setAttribute("position", new THREE.BufferAttribute(new Float32Array(MOST_RAYS * 3), 3));
    g.setAttribute("colour", new THREE.BufferAttribute(new Uint8Array(MOST_RAYS * 4), 4, true));
    g.setDrawRange(0, 0);
    this.dots = new THREE.Points(
      g,
      new THREE.ShaderMaterial({
        uniforms: { ...shared, uSize: { value: 6 } },
        vertexShader: /* glsl */ `
          attribute vec4 colour;
          uniform vec3 uViewport;
          uniform mat4 uSee;
          uniform float uSize;
          varying vec3 vColour;
          void main() {
            vColour = colour.rgb;
            gl_Position = uSee * vec4(position, 1.0);
            gl_Position.z -= 4e-5 * gl_Position.w;
            gl_PointSize = uSize * uViewport.z;
          }`,
        fragmentShader: /* glsl */ `
          varying vec3 vColour;
          void main() {
            float r = length(gl_PointCoord - 0.5);
            if (r > 0.5) discard;
            gl_FragColor = vec4(r > 0.36 ? vec3(1.0) : vColour, 1.0);
          }`,
        transparent: true,
        depthWrite: false,
      }),
    );
    this.dots.frustumCulled = false;
    this.dots.renderOrder = 16;
    this.volumes.matrixAutoUpdate = false;
    this.group.add(this.lines.mesh, this.volumes, this.dots);
  }

  set(details: Details | null): void {
    this.rays = [];
    for (const o of [...this.volumes.children]) {
      this.volumes.remove(o);
      if (o instanceof THREE.Mesh || o instanceof THREE.LineSegments) {
        o.geometry.dispose();
        (o.material as THREE.Material).dispose();
      }
    }
    this.vehicle = details?.vehicle ?? null;
    details?.sensors.forEach((sensor, i) => this.addSensor(sensor, COLOURS[i % COLOURS.length]!));
  }

  /** Before each picture: goes with the body. */
  update(): void {
    const place = this.vehicle === null ? null : this.frames.place(this.vehicle);
    this.group.visible = place !== null;
    if (!place || this.vehicle === null) return;
    const turn = this.frames.turn(this.vehicle);
    this.volumes.matrix.makeRotationFromQuaternion(this.quaternion.set(turn[1], turn[2], turn[3], turn[0])).setPosition(place[0], place[1], place[2]);
    this.volumes.updateMatrixWorld(true);
    this.lines.clear();
    const dots = this.dots.geometry;
    const [at, colour] = [dots.getAttribute("position"), dots.getAttribute("colour")];
    let n = 0;
    const opacity = this.rays.length > 60 ? 90 : 220;
    const { from, to, rgba } = this;
    for (const ray of this.rays) {
      from.set(ray.from[0], ray.from[1], ray.from[2]).applyMatrix4(this.volumes.matrix);
      to.set(ray.along[0], ray.along[1], ray.along[2]).applyQuaternion(this.quaternion).multiplyScalar(ray.length).add(from);
      rgba.set(ray.colour);
      rgba[3] = ray.hit ? opacity : opacity * 0.4;
      this.lines.add(from.toArray(this.a), to.toArray(this.b), rgba);
      if (!ray.hit) continue;
      at.setXYZ(n, to.x, to.y, to.z);
      rgba[3] = 255;
      (colour.array as Uint8Array).set(rgba, 4 * n);
      n++;
    }
    this.lines.set("uWidth", this.rays.length > 60 ? 0.5 : 1);
    this.lines.flush();
    dots.setDrawRange(0, n);
    at.needsUpdate = true;
    colour.needsUpdate = true;
    this.dots.material.uniforms["uSize"]!.value = this.rays.length > 60 ? 4 : 8;
  }

  dispose(): void {
    this.set(null);
    this.lines.dispose();
    this.dots.geometry.dispose();
    this.dots.material.dispose();
  }

  private addSensor(sensor: SensorDetails, css: string): void {
    const { beams, mount } = sensor;
    if (!beams) return;
    const colour = new THREE.Color(css);
    const rgb: [number, number, number] = [colour.r * 255, colour.g * 255, colour.b * 255];
    const range = Math.min(beams.range_m, this.reach());
    if (!(range > 0)) return;
    if ("rays" in beams) {
      const lengths = rayLengths(sensor, beams.rays.length);
      beams.rays.slice(0, MOST_RAYS - this.rays.length).forEach((d, i) => {
        const along = rotate(mount.turn, unit(d));
        const measured = lengths?.[i] ?? null;
        const hit = measured !== null && measured >= 0 && measured < beams.range_m * 0.999;
        this.rays.push({ from: mount.at, along, length: hit ? measured : range, hit, colour: rgb });
      });
    } else if ("cone" in beams) {
      const half = Math.min(beams.cone, Math.PI);
      // A cap of a ball and the cone under it; from half a turn on it is a ball with a hole.
      const cap = new THREE.SphereGeometry(range, 40, 14, 0, 2 * Math.PI, 0, half).rotateZ(-Math.PI / 2);
      this.addVolume(sensor, colour, cap, 0.1);
      const rim: number[] = [];
      for (let i = 0; i < 40; i++) {
        for (const k of [i, i + 1]) rim.push(...rim3(range, half, (k * Math.PI) / 20));
        if (i % 5 === 0) rim.push(0, 0, 0, ...rim3(range, half, (i * Math.PI) / 20));
      }
      this.addEdges(sensor, colour, rim);
    } else if ("frustum" in beams) {
      const [h, v] = beams.frustum.map((a) => Math.tan(Math.min(a, 3) / 2)) as [number, number];
      const corner = (y: number, z: number): Vec3 => scale([1, y * h, z * v], range);
      const [a, b, c, d] = [corner(1, 1), corner(-1, 1), corner(-1, -1), corner(1, -1)];
      const o: Vec3 = [0, 0, 0];
      const sides = new THREE.BufferGeometry();
      sides.setAttribute("position", new THREE.Float32BufferAttribute([o, a, b, o, b, c, o, c, d, o, d, a, a, c, b, a, d, c].flat(), 3));
      this.addVolume(sensor, colour, sides, 0.09);
      this.addEdges(sensor, colour, [o, a, o, b, o, c, o, d, a, b, b, c, c, d, d, a].flat());
    } else {
      this.addVolume(sensor, colour, new THREE.SphereGeometry(range, 40, 24), 0.08);
      const circle: number[] = [];
      for (let i = 0; i < 64; i++) for (const k of [i, i + 1]) circle.push(range * Math.cos((k * Math.PI) / 32), range * Math.sin((k * Math.PI) / 32), 0);
      this.addEdges(sensor, colour, circle);
    }
  }

  private stand(o: THREE.Object3D, sensor: SensorDetails): void {
    const [w, x, y, z] = sensor.mount.turn;
    o.position.set(...sensor.mount.at);
    o.quaternion.set(x, y, z, w);
    this.volumes.add(o);
  }

  private addVolume(sensor: SensorDetails, colour: THREE.Color, g: THREE.BufferGeometry, opacity: number): void {
    const m = new THREE.MeshBasicMaterial({ color: colour, transparent: true, opacity, depthWrite: false, side: THREE.DoubleSide, forceSinglePass: true });
    const mesh = new THREE.Mesh(g, m);
    mesh.renderOrder = 22;
    this.stand(mesh, sensor);
  }

  private addEdges(sensor: SensorDetails, colour: THREE.Color, points: number[]): void {
    const g = new THREE.BufferGeometry();
    g.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    const edges = new THREE.LineSegments(g, new THREE.LineBasicMaterial({ color: colour, transparent: true, opacity: 0.8, depthWrite: false }));
    edges.renderOrder = 23;
    this.stand(edges, sensor);
  }
}

function rim3(range: number, half: number, phi: number): Vec3 {
  return [range * Math.cos(half), range * Math.sin(half) * Math.cos(phi), range * Math.sin(half) * Math.sin(phi)];
}
