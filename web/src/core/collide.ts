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

/** Pushes an eye sideways out of what its body touches; the body stands `height` below. */
export function pushOut(bvh: MeshBVH, eye: Vector3, up: Vector3, height: number): Vector3 {
  const foot = Math.max(0, height - STEP - RADIUS);
  const body = new Line3(eye.clone().addScaledVector(up, -foot), eye.clone());
  const box = new Box3().setFromPoints([body.start, body.end]).expandByScalar(RADIUS);
  const [onTriangle, onBody, push] = [new Vector3(), new Vector3(), new Vector3()];
  bvh.shapecast({
    intersectsBounds: (bounds) => bounds.intersectsBox(box),
    intersectsTriangle: (triangle) => {
      const distance = triangle.closestPointToSegment(body, onTriangle, onBody);
      if (distance >= RADIUS) return false;
      push.subVectors(onBody, onTriangle);
      push.addScaledVector(up, -push.dot(up));
      if (push.lengthSq() < 1e-12) return false;
      push.normalize().multiplyScalar(RADIUS - distance);
      body.start.add(push);
      body.end.add(push);
      box.translate(push);
      return false;
    },
  });
  return body.end.clone();
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
