import { describe, expect, it } from 'vitest';
import type { Vec3 } from '../wire';
import { whiteBalance } from './white';

const shown = (light: Vec3): Vec3 => whiteBalance(light).map((row) => row[0] * light[0] + row[1] * light[1] + row[2] * light[2]) as Vec3;

describe('the colour of the light', () => {
  it('is nearly white where it is warm', () => {
    const [r, , b] = shown([1.8, 0.86, 0.19]);
    expect(r / b).toBeGreaterThan(1.05);
    expect(r / b).toBeLessThan(1.6);
  });

  it('stays where it is white, coloured or none', () => {
    for (const light of [[2, 2, 2], [1, 0, 0], [0, 0, 1], [0, 0, 0]] as Vec3[]) {
      shown(light).forEach((channel, k) => expect(channel).toBeCloseTo(light[k]!, 9));
    }
  });
});
