// How far eyes adapt to the colour of the light: what `render --white auto` does (`light.rs` and `white.rs` of isolux-view).

import type { Vec3 } from '../wire';
import { luminance } from './codes';

type Rows = readonly [Vec3, Vec3, Vec3];

const IDENTITY: Rows = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
const D65: Vec3 = [0.9504559270516717, 1, 1.0890577507598784];
const XYZ_FROM_REC709: Rows = [
  [0.4123907992659595, 0.357584339383878, 0.1804807884018343],
  [0.2126390058715104, 0.7151686787677559, 0.07219231536073371],
  [0.01933081871559185, 0.119194779794626, 0.9505321522496606],
];
const REC709_FROM_XYZ: Rows = [
  [3.240969941904521, -1.537383177570093, -0.4986107602930033],
  [-0.9692436362808798, 1.875967501507721, 0.04155505740717561],
  [0.05563007969699361, -0.2039769588889766, 1.056971514242879],
];
/** From XYZ to the cones, and back. */
const BRADFORD: Rows = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];
const BRADFORD_INVERSE: Rows = [
  [0.9869929054667121, -0.1470542564209901, 0.1599626516637312],
  [0.4323052697233945, 0.5183602715367776, 0.04929122821285561],
  [-0.008528664575177331, 0.04004282165408486, 0.96848669578755],
];
/** D of CIECAM02 for eyes adapted to 20 cd/m2. */
const DEGREE = 1 - Math.exp(-62 / 92) / 3.6;
/** Distances from the colours of black bodies, CIE 1960 uv, up to which eyes adapt wholly, and from which on not at all. */
const [NEAR, FAR] = [0.02, 0.05];
/** Reciprocal temperatures of white light, 1e-6 / K. */
const [HOTTEST, COLDEST] = [80, 625];

const apply = (rows: Rows, [x, y, z]: Vec3): Vec3 => rows.map(([a, b, c]) => a * x + b * y + c * z) as Vec3;

function after(a: Rows, b: Rows): Rows {
  const columns = [0, 1, 2].map((k) => apply(a, b.map((row) => row[k]!) as Vec3));
  return [0, 1, 2].map((row) => columns.map((column) => column[row]!)) as unknown as Rows;
}

/** The matrix, row by row, that takes luminances to those shown in light of this colour; without light nothing changes. */
export function whiteBalance(light: Vec3): Rows {
  const y = luminance(light);
  if (!(y > 0) || !Number.isFinite(y)) return IDENTITY;
  const white = apply(XYZ_FROM_REC709, light.map((channel) => channel / y) as Vec3);
  const degree = DEGREE * Math.min(1, Math.max(0, (FAR - fromWhites(white)) / (FAR - NEAR)));
  const [from, to] = [apply(BRADFORD, white), apply(BRADFORD, D65)];
  const factors: Rows = [[to[0] / from[0], 0, 0], [0, to[1] / from[1], 0], [0, 0, to[2] / from[2]]];
  const cones = after(BRADFORD_INVERSE, after(factors, BRADFORD));
  const whole = after(REC709_FROM_XYZ, after(cones, XYZ_FROM_REC709));
  const mixed = whole.map((row, r) => row.map((value, c) => degree * value + (1 - degree) * IDENTITY[r]![c]!)) as unknown as Rows;
  return mixed.flat().every(Number.isFinite) ? mixed : IDENTITY;
}

function fromWhites([x, y, z]: Vec3): number {
  const sum = x + 15 * y + 3 * z;
  let least = Infinity;
  for (let mired = HOTTEST; mired <= COLDEST; mired++) {
    const [u, v] = blackBody(1e6 / mired);
    least = Math.min(least, Math.hypot((4 * x) / sum - u, (6 * y) / sum - v));
  }
  return least;
}

/** Chromaticity of a black body, CIE 1960 uv (Krystek 1985). */
function blackBody(t: number): [number, number] {
  const u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) / (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
  const v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) / (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
  return [u, v];
}
