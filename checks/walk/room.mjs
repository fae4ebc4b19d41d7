// A room with all that a page shows: two groups of light, a mirror, a texture, a calculation grid, two cameras.
import { copyFile, mkdir, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { PNG } from 'pngjs';

const SCENE = `name = "two lamps"
[materials.paint]
diffuse = 0.7
[materials.carpet]
diffuse = [0.22, 0.20, 0.18]
[materials.wood]
diffuse = 0.8
texture = "wood.png"
[materials.silver]
mirror = 0.9
sided = "one"

[[geometry]]
name = "room"
box = { min = [0, 0, 0], max = [4, 5, 2.8], inward = true }
material = "paint"
materials = { z_min = "carpet" }
[[geometry]]
name = "table"
file = "table.obj"
up = "z"
material = "wood"
[[geometry]]
name = "leg"
box = { min = [1.9, 2.5, 0.001], max = [2.1, 2.7, 0.699] }
material = "paint"
[[geometry]]
name = "mirror"
rectangle = { corner = [3.98, 1.5, 0.6], u = [0, 0, 1.4], v = [0, 2, 0] }
material = "silver"

[[luminaire]]
name = "pendant"
group = "spots"
position = [2, 2.6, 2.2]
spot = { peak_cd = 900, inner_deg = 30, outer_deg = 70 }
[[luminaire]]
name = "corner lamp"
group = "lamps"
position = [0.6, 4.4, 1.9]
isotropic = { intensity_cd = 120 }
cct_k = 3000

[[camera]]
name = "door"
position = [0.4, 0.4, 1.7]
target = [2.9, 3.6, 0.9]
[[camera]]
name = "mirror"
position = [0.6, 2.5, 1.5]
target = [4, 2.6, 1.1]
vertical_fov_deg = 70

[[grid]]
name = "table top"
corner = [1.4, 1.8, 0.74]
u = [1.2, 0, 0]
v = [0, 1.6, 0]
spacing = 0.2
`;

// A sheet with places in its texture.
const TABLE = `v 1.4 1.8 0.74
v 2.6 1.8 0.74
v 2.6 3.4 0.74
v 1.4 3.4 0.74
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 2/2 3/3 4/4
`;

const TILES = [[200, 150, 100], [120, 80, 50]];

/** Tiles of wood, 4 x 4. */
function wood() {
  const picture = new PNG({ width: 64, height: 64 });
  for (let pixel = 0; pixel < 64 * 64; pixel++) {
    const [x, y] = [pixel % 64, Math.floor(pixel / 64)];
    picture.data.set([...TILES[(x >> 4) + (y >> 4) & 1], 255], 4 * pixel);
  }
  return PNG.sync.write(picture);
}

/** Writes the scene and solves it by groups: `map.glb` with its groups, `alone/map.glb` without, `evening.glb` dimmed. */
export async function makeRoom({ run }, folder) {
  const at = (name) => join(folder, name);
  await Promise.all([writeFile(at('scene.toml'), SCENE), writeFile(at('table.obj'), TABLE), writeFile(at('wood.png'), wood()), mkdir(at('alone'))]);
  await run('solve', 'scene.toml', '-o', 'map.glb', '--accuracy', '5%', '--group', '--progress', 'none');
  await copyFile(at('map.glb'), at('alone/map.glb'));
  await run('mix', 'map.glb', '--dim', `spots=${EVENING[0]}`, '-o', 'evening.glb');
}

/** What `evening.glb` is dimmed to, in the order of the groups. */
export const EVENING = [0.3, 1];
