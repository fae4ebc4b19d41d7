import { Vector3 } from 'three';
import { MeshBVH } from 'three-mesh-bvh';
import { describe, expect, it } from 'vitest';
import { geometryOf, OPTIONS } from './bvh-shared';
import { floorBelow, RADIUS, roomAbove, slide, STEP } from './collide';

type Corner = [number, number, number];
const UP = new Vector3(0, 0, 1);
const EYES = 1.65;
/** Steps of a walker are shorter than that, m. */
const SHORT = RADIUS / 2;

/** Quadrilaterals as a tree. */
function worldOf(...faces: Corner[][]): MeshBVH {
  const positions = new Float32Array(faces.flat(2));
  const index = new Uint32Array(faces.flatMap((_, i) => [0, 1, 2, 0, 2, 3].map((k) => 4 * i + k)));
  return new MeshBVH(geometryOf({ positions, index }), OPTIONS);
}

/** A wall over a line of the floor, 3 m high. */
const wall = ([x0, y0]: [number, number], [x1, y1]: [number, number]): Corner[] => [[x0, y0, 0], [x1, y1, 0], [x1, y1, 3], [x0, y0, 3]];
const floor = (z: number): Corner[] => [[-9, -9, z], [9, -9, z], [9, 9, z], [-9, 9, z]];

/** Where an eye comes to that goes one way for so many steps. */
function walk(world: MeshBVH, from: Corner, way: Corner, steps = 200): Vector3 {
  let eye = new Vector3(...from);
  const step = new Vector3(...way).setLength(SHORT);
  for (let i = 0; i < steps; i++) eye = slide(world, eye, step, UP, EYES);
  return eye;
}

describe('a walker', () => {
  it('stops at a wall, from both of its sides', () => {
    const world = worldOf(wall([2, -9], [2, 9]));
    expect(walk(world, [0, 0, EYES], [1, 0, 0]).x).toBeCloseTo(2 - RADIUS, 2);
    expect(walk(world, [4, 0, EYES], [-1, 0, 0]).x).toBeCloseTo(2 + RADIUS, 2);
  });
  it('slides along a wall', () => {
    const end = walk(worldOf(wall([2, -9], [2, 9])), [0, 0, EYES], [1, 1, 0], 30);
    expect(end.x).toBeCloseTo(2 - RADIUS, 2);
    expect(end.y).toBeGreaterThan(2);
  });
  it('passes no corner, however narrow', () => {
    for (const degrees of [90, 60, 30, 10, 3]) {
      const [x, y] = [6 * Math.cos((degrees * Math.PI) / 360), 6 * Math.sin((degrees * Math.PI) / 360)];
      const world = worldOf(wall([0, 0], [x, y]), wall([0, 0], [x, -y]));
      for (const aside of [-0.02, 0, 0.03]) {
        const end = walk(world, [8, aside, EYES], [-1, aside / 3, 0]);
        expect(end.x, `${degrees} degrees`).toBeGreaterThan(0);
        expect(Math.abs(end.y) / end.x, `${degrees} degrees`).toBeLessThan(y / x);
      }
    }
  });
  // One that is a little narrower is passed in one step.
  it('passes no gap that is much narrower than a body', () => {
    const gap = (width: number): MeshBVH => worldOf(wall([2, -9], [2, -width / 2]), wall([2, width / 2], [2, 9]));
    expect(walk(gap(1.6 * RADIUS), [0, 0, EYES], [1, 0, 0]).x).toBeLessThan(2);
    expect(walk(gap(2.4 * RADIUS), [0, 0, EYES], [1, 0, 0]).x).toBeGreaterThan(2);
  });
  it('leaves what it stands within', () => {
    const world = worldOf(wall([-0.1, -9], [-0.1, 9]), wall([0.1, -9], [0.1, 9]));
    expect(walk(world, [0, 0, EYES], [0, 1, 0]).length()).toBeGreaterThan(1);
  });
  it('steps over what is low', () => {
    const sill: Corner[] = [[2, -9, 0], [2, 9, 0], [2, 9, STEP - 0.02], [2, -9, STEP - 0.02]];
    expect(walk(worldOf(sill), [0, 0, EYES], [1, 0, 0]).x).toBeGreaterThan(3);
  });
});

describe('what a walker stands on', () => {
  it('is the first floor below the eyes, and no wall', () => {
    const world = worldOf(floor(0), floor(-3), wall([0.001, -9], [-0.001, 9]));
    expect(floorBelow(world, new Vector3(0, 1, EYES), UP)).toBeCloseTo(EYES);
    expect(floorBelow(world, new Vector3(0, 1, -1), UP)).toBeCloseTo(2);
    expect(floorBelow(world, new Vector3(0, 1, -4), UP)).toBeNull();
  });
  it('has room above up to what is there', () => {
    expect(roomAbove(worldOf(floor(2.8)), new Vector3(0, 1, EYES), UP)).toBeCloseTo(2.8 - EYES);
  });
});
