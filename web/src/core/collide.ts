// Bodies that walk: what they bump into and what they stand on.

import { Box3, DoubleSide, Line3, Ray, Vector3 } from 'three';
import type { MeshBVH } from 'three-mesh-bvh';

/** Half the width of a walker, m. */
export const RADIUS = 0.25;
/** Obstacles up to this height are stepped on, m. */
export const STEP = 0.35;
/** Floors are no steeper than this (cosine). */
const FLAT = 0.5;
/** Falls end here, m. */
const DEEPEST = 60;

/** A body in a corner is pushed by one wall into the other, and back; after so many times there is no room for it. */
const MOST_PUSHES = 8;
/** Pushes that are shorter are none, m. */
const TINY = 1e-4;

/** Moves an eye by a short way as far as walls let its body, which stands `height` below. Into a corner that is too narrow it does not go. */
export function slide(bvh: MeshBVH, eye: Vector3, way: Vector3, up: Vector3, height: number): Vector3 {
  let at = eye.clone().add(way);
  for (let i = 0; i < MOST_PUSHES; i++) {
    const next = pushOut(bvh, at, up, height);
    if (next.distanceTo(at) < TINY) return next;
    at = next;
  }
  // Who stands within something already may leave it.
  return pushOut(bvh, eye, up, height).distanceTo(eye) < 2 * TINY ? eye.clone() : eye.clone().add(way);
}

/** Pushes an eye sideways out of what its body touches most; the body stands `height` below. */
function pushOut(bvh: MeshBVH, eye: Vector3, up: Vector3, height: number): Vector3 {
  const foot = Math.max(0, height - STEP - RADIUS);
  const body = new Line3(eye.clone().addScaledVector(up, -foot), eye.clone());
  const box = new Box3().setFromPoints([body.start, body.end]).expandByScalar(RADIUS);
  const [onTriangle, onBody, away, push] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
  // Nearest first: what lies farther along a wall would push along it.
  let nearest = RADIUS;
  bvh.shapecast({
    intersectsBounds: (bounds) => bounds.intersectsBox(box),
    intersectsTriangle: (triangle) => {
      const distance = triangle.closestPointToSegment(body, onTriangle, onBody);
      if (distance >= nearest) return false;
      away.subVectors(onBody, onTriangle);
      away.addScaledVector(up, -away.dot(up));
      if (away.lengthSq() < 1e-12) return false;
      nearest = distance;
      push.copy(away).setLength(RADIUS - distance);
      return false;
    },
  });
  return eye.clone().add(push);
}

/** How far below the eye a floor is, m; null if there is none. */
export function floorBelow(bvh: MeshBVH, eye: Vector3, up: Vector3): number | null {
  const ray = new Ray(eye.clone(), up.clone().negate());
  const hits = bvh.raycast(ray, DoubleSide, 0, DEEPEST).sort((a, b) => a.distance - b.distance);
  return hits.find(({ face }) => face && Math.abs(face.normal.dot(up)) > FLAT)?.distance ?? null;
}

/** How much room is above the eye, m. */
export function roomAbove(bvh: MeshBVH, eye: Vector3, up: Vector3): number {
  return bvh.raycastFirst(new Ray(eye.clone(), up.clone()), DoubleSide, 0, 5)?.distance ?? 5;
}
