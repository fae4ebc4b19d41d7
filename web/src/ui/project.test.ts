import { describe, expect, it } from 'vitest';
import { lookAt, project } from './project';

const view = { position: [0, 0, 0] as [number, number, number], target: [0, 5, 0] as [number, number, number], fovDeg: 90 };

describe('projection', () => {
  it('puts the target in the middle and the rest around', () => {
    expect(project([0, 3, 0], view, [0, 0, 1], 200, 100)).toEqual([100, 50]);
    const [x, y] = project([1, 2, 1], view, [0, 0, 1], 200, 100)!;
    expect(x).toBeCloseTo(125);
    expect(y).toBeCloseTo(25);
    expect(project([0, -1, 0], view, [0, 0, 1], 200, 100)).toBeNull();
  });
  it('goes to places without leaving the bounds', () => {
    const to = lookAt([1, 1, 0.75], [0, 0, 1], view, { min: [0, 0, 0], max: [4, 4, 2.8] });
    expect(to.target).toEqual([1, 1, 0.75]);
    expect(to.position.map((v) => Number(v.toFixed(3)))).toEqual([2.414, 2.414, 1.95]);
  });
});
