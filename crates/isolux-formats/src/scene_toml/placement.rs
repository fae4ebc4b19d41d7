//! Where geometry stands in the scene.

use super::context::Context;
use super::quantity::plain;
use super::record::{PlacementRecord, ScaleRecord};
use super::spans::At;
use isolux::geometry::{Transform, Vector};
use isolux::scene::UpAxis;
use isolux::units::sincos_deg;

/// The map a placement describes: scale, then turns about the scene's x, y and z axes in this
/// order, then the shift; or a matrix. `None` after a problem.
pub(super) fn resolve(record: &At<PlacementRecord>, context: &mut Context) -> Option<Transform> {
    let PlacementRecord { scale, rotate_deg, translate, matrix } = record.get_ref();
    let map = match matrix {
        None => in_steps(record.get_ref(), context.unit_m),
        Some(_) if scale.is_some() || rotate_deg.is_some() || translate.is_some() => {
            let what = "a matrix beside `scale`, `rotate_deg` or `translate`";
            context.problem(&record.span(), what, "give either the matrix or the steps");
            return None;
        }
        Some(rows) => {
            let rows = rows.map(|n| n.0);
            if rows[12..] != [0.0, 0.0, 0.0, 1.0] {
                let what = "the last row of the matrix is not 0, 0, 0, 1";
                context.problem(&record.span(), what, "write 16 numbers row by row");
                return None;
            }
            from_rows(&rows, context.unit_m)
        }
    };
    if map.inverse().is_none() {
        let what = "the placement flattens what it places";
        context.problem(&record.span(), what, "use scales that are not zero");
        return None;
    }
    Some(map)
}

fn in_steps(record: &PlacementRecord, unit_m: f64) -> Transform {
    let [sx, sy, sz] = match record.scale {
        None => [1.0; 3],
        Some(ScaleRecord::Uniform(all)) => [all.0; 3],
        Some(ScaleRecord::Axes(axes)) => plain(axes),
    };
    let turns = record.rotate_deg.map_or([0.0; 3], plain);
    let shift = record.translate.map_or([0.0; 3], plain).map(|c| c * unit_m);
    let turned = (0..3).fold(Transform::scale(sx, sy, sz), |map, axis| {
        turn_about(axis, turns[axis]).then_from(&map)
    });
    Transform::translation(Vector::from(shift)).then_from(&turned)
}

/// A right-handed turn about a coordinate axis.
fn turn_about(axis: usize, angle_deg: f64) -> Transform {
    let (s, c) = sincos_deg(angle_deg);
    let mut columns = Transform::IDENTITY.columns.map(<[f64; 3]>::from);
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    (columns[u][u], columns[u][v]) = (c, s);
    (columns[v][u], columns[v][v]) = (-s, c);
    Transform { columns: columns.map(Vector::from), translation: Vector::ZERO }
}

fn from_rows(rows: &[f64; 16], unit_m: f64) -> Transform {
    let column = |k: usize| Vector::new(rows[k], rows[4 + k], rows[8 + k]);
    Transform { columns: [column(0), column(1), column(2)], translation: column(3) * unit_m }
}

/// Takes +y of one convention to +z of the other or back, x unchanged.
pub(super) fn scene_from_up(scene: UpAxis, of_file: UpAxis) -> Transform {
    match (of_file, scene) {
        (UpAxis::Y, UpAxis::Z) => turn_about(0, 90.0),
        (UpAxis::Z, UpAxis::Y) => turn_about(0, -90.0),
        _ => Transform::IDENTITY,
    }
}
