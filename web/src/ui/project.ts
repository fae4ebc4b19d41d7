// Where a place is on the canvas.

import type { View } from '../contract';
import type { Vec3 } from '../wire';

const sub = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vec3, b: Vec3): Vec3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a: Vec3): Vec3 => {
  const length = Math.hypot(...a);
  return length > 0 ? [a[0] / length, a[1] / length, a[2] / length] : [0, 0, 0];
};

/** CSS pixels of a canvas of this size; null behind the viewer. */
export function project(at: Vec3, view: View, up: Vec3, width: number, height: number): [number, number] | null {
  const forward = unit(sub(view.target, view.position));
  const right = unit(cross(forward, up));
  const above = cross(right, forward);
  const to = sub(at, view.position);
  const depth = dot(to, forward);
  if (!(depth > 1e-3)) return null;
  const scale = height / 2 / Math.tan((view.fovDeg * Math.PI) / 360) / depth;
  return [width / 2 + dot(to, right) * scale, height / 2 - dot(to, above) * scale];
}

/** A place to look at another from: above it, and back towards the middle of the bounds, where there is room. */
export function lookAt(at: Vec3, normal: Vec3, view: View, bounds: { min: Vec3; max: Vec3 }): View {
  const middle = bounds.min.map((v, i) => (v + bounds.max[i]!) / 2) as Vec3;
  const inward = sub(middle, at);
  const flat = sub(inward, scaled(normal, dot(inward, normal)));
  const back = Math.hypot(...flat) > 0.5 ? flat : sub(view.position, view.target);
  const away = unit(sub(back, scaled(normal, dot(back, normal))));
  const from = at.map((v, i) => {
    const margin = 0.05 * (bounds.max[i]! - bounds.min[i]!);
    return Math.min(Math.max(v + 2 * away[i]! + 1.2 * normal[i]!, bounds.min[i]! + margin), bounds.max[i]! - margin);
  }) as Vec3;
  return { position: from, target: at, fovDeg: view.fovDeg };
}

function scaled(a: Vec3, by: number): Vec3 {
  return [a[0] * by, a[1] * by, a[2] * by];
}

export function gridNormal(u: Vec3, v: Vec3): Vec3 {
  return unit(cross(u, v));
}
