//! An open-plan office: rows of desks with a screen and a chair each, columns, rows of luminaires. After
//! the rooms of the study that the goals of the kernel were set on (10,008 and 1,034,300 triangles).

use super::hall::GAP_M;
use super::solids::{Fronts, add_box, add_lathed, ball, turned};
use isolux_geometry::TriangleMesh;

/// Into how many pieces the parts are divided.
pub(super) struct Fineness {
    column_sides: usize,
    column_rings: usize,
    /// Cells along the edges of a cushion and of a bowl: with them, every other desk has one of each
    /// instead of the chair.
    round: Option<[usize; 2]>,
    /// Cells along and up a curtain.
    curtain: Option<[usize; 2]>,
}

/// For ten thousand triangles.
pub(super) const COARSE: Fineness =
    Fineness { column_sides: 48, column_rings: 2, round: None, curtain: None };

/// For a million triangles.
pub(super) const FINE: Fineness = Fineness {
    column_sides: 128,
    column_rings: 128,
    round: Some([41, 26]),
    curtain: Some([384, 85]),
};

const ROOM_M: [f32; 3] = [16.0, 11.0, 3.1];
const DESKS: [usize; 2] = [11, 4];
const COLUMNS: [usize; 2] = [4, 2];
const LUMINAIRES: [usize; 2] = [6, 4];
/// How far parts stand in each other: between two that only touch is a slit.
const SEAT_M: f32 = 0.004;

/// The office.
pub(super) fn furnished(fineness: &Fineness) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    let shell = |unit: [f32; 3]| [0, 1, 2].map(|axis| unit[axis] * ROOM_M[axis]);
    add_box(&mut mesh, [8, 5, 2], Fronts::Inside, shell);
    for k in 0..DESKS[0] * DESKS[1] {
        let (column, row) = (k / DESKS[1], k % DESKS[1]);
        let foot = [1.15 + column as f32 * 1.35, 1.3 + row as f32 * 2.7];
        let across = if k % 3 == 0 { std::f32::consts::FRAC_PI_2 } else { 0.0 };
        let angle_rad = 0.03 * ((k * 7 % 11) as f32 - 5.0) + across;
        add_desk(&mut mesh, foot, angle_rad);
        match fineness.round {
            Some(cells) if k % 2 == 0 => add_round(&mut mesh, cells, foot),
            _ => add_chair(&mut mesh, foot, angle_rad + 0.2 * ((k * 5 % 7) as f32 - 3.0)),
        }
    }
    add_columns(&mut mesh, fineness);
    if let Some([along, up]) = fineness.curtain {
        add_box(&mut mesh, [along, 1, up], Fronts::Outside, curtain);
    }
    for k in 0..LUMINAIRES[0] * LUMINAIRES[1] {
        let (x, y) = ((k / LUMINAIRES[1]) as f32, (k % LUMINAIRES[1]) as f32);
        let low = [0.8 + 2.6 * x, 1.25 + 2.7 * y, ROOM_M[2] - 0.16];
        add_box(&mut mesh, [1; 3], Fronts::Outside, turned(low, [1.2, 0.3, 0.08], 0.0));
    }
    mesh
}

/// Boxes by lower corner and size, relative to a foot and turned with it.
fn add_parts(mesh: &mut TriangleMesh, foot: [f32; 2], angle_rad: f32, parts: &[[[f32; 3]; 2]]) {
    let turn = turned([foot[0] - 0.5, foot[1] - 0.5, 0.0], [1.0; 3], angle_rad);
    for &[low, size] in parts {
        add_box(mesh, [1; 3], Fronts::Outside, |unit| {
            let [x, y, z] = [0, 1, 2].map(|axis| low[axis] + unit[axis] * size[axis]);
            turn([x + 0.5, y + 0.5, z])
        });
    }
}

fn add_desk(mesh: &mut TriangleMesh, foot: [f32; 2], angle_rad: f32) {
    let leg = |x: f32, y: f32| [[x - 0.025, y - 0.025, GAP_M], [0.05, 0.05, 0.72 + SEAT_M]];
    let parts = [
        [[-0.5, -0.35, 0.72], [1.0, 0.7, 0.03]],
        leg(-0.46, -0.31),
        leg(0.46, -0.31),
        leg(-0.46, 0.31),
        leg(0.46, 0.31),
        [[0.13, -0.28, 0.18], [0.3, 0.56, 0.54 + SEAT_M]],
        [[-0.27, 0.188, 0.84], [0.54, 0.024, 0.32]],
        [[-0.04, 0.205, 0.75 - SEAT_M], [0.08, 0.02, 0.17]],
        [[-0.2, -0.17, 0.75 - SEAT_M], [0.4, 0.14, 0.025]],
    ];
    add_parts(mesh, foot, angle_rad, &parts);
}

fn add_chair(mesh: &mut TriangleMesh, foot: [f32; 2], angle_rad: f32) {
    let leg = |x: f32, y: f32| [[x - 0.02, y - 0.02, GAP_M], [0.04, 0.04, 0.43 + SEAT_M]];
    let parts = [
        [[-0.22, -0.22, 0.43], [0.44, 0.44, 0.04]],
        [[-0.21, -0.222, 0.45], [0.42, 0.024, 0.54]],
        leg(-0.19, -0.19),
        leg(0.19, -0.19),
        leg(-0.19, 0.19),
        leg(0.19, 0.19),
    ];
    add_parts(mesh, [foot[0], foot[1] - 0.75], angle_rad, &parts);
}

/// A cushion in front of the desk and a bowl on it.
fn add_round(mesh: &mut TriangleMesh, [cushion, bowl]: [usize; 2], foot: [f32; 2]) {
    let [x, y] = foot;
    add_box(mesh, [cushion; 3], Fronts::Outside, ball([x, y - 0.75, 0.325], 0.32));
    add_box(mesh, [bowl; 3], Fronts::Outside, ball([x - 0.3, y, 0.86], 0.12));
}

fn add_columns(mesh: &mut TriangleMesh, fineness: &Fineness) {
    let height_m = ROOM_M[2] - 2.0 * GAP_M;
    let rings: Vec<[f32; 2]> = (0..fineness.column_rings)
        .map(|ring| ring as f32 / (fineness.column_rings - 1) as f32)
        .map(|up| [0.22 * (1.0 + 0.03 * libm::sinf(up * 40.0)), up * height_m])
        .collect();
    for k in 0..COLUMNS[0] * COLUMNS[1] {
        let (x, y) = ((k / COLUMNS[1]) as f32, (k % COLUMNS[1]) as f32);
        let foot = [1.82 + 4.0 * x, 2.45 + 5.4 * y, GAP_M];
        add_lathed(mesh, foot, &rings, height_m, fineness.column_sides);
    }
}

/// Waves along one of the long walls.
fn curtain([along, through, up]: [f32; 3]) -> [f32; 3] {
    let (x, z) = (0.3 + 15.4 * along, 0.1 + 2.9 * up);
    let folds = 0.07 * libm::sinf(x * 25.0) * (1.0 - 0.2 * z) + 0.01 * libm::sinf(z * 7.0 + x);
    [x, 10.8 + folds + 0.02 * through, z]
}
