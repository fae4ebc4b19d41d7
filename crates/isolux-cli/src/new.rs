//! `isolux new`: a room as a `scene.toml`, to begin with.

use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::{NewFlags, RoomKind};
use crate::output::OutputPath;
use serde::Serialize;
use std::f64::consts::PI;
use std::fmt::Write;

/// The flux of a panel, lm: of a usual LED panel of 60 x 60 cm.
const PANEL_LM: f64 = 3600.0;
/// The edge of a panel, m.
const PANEL_M: f64 = 0.6;
/// The maintained illuminance that panels are counted for, lx: writing and reading, EN 12464-1.
const WANTED_LX: f64 = 500.0;
/// The share of the flux that comes to the working plane and stays, in a light room after some years.
const UTILIZED: f64 = 0.75;
/// The gap between the ceiling and a panel, m.
const BELOW_CEILING_M: f64 = 0.02;
/// The edges of a desk, m.
const DESK_M: [f64; 3] = [1.6, 0.8, 0.74];
/// The floor that a desk takes with its chair, m.
const DESK_FLOOR_M: [f64; 2] = [2.4, 2.2];
/// The distance of desks from walls, m.
const FROM_WALL_M: f64 = 0.3;

/// The wall left and right of a window, as a share of the width.
const WINDOW_FROM: f64 = 0.1;
/// The height of the wall below a window, and above it, m.
const SILL_M: f64 = 0.9;
const LINTEL_M: f64 = 0.3;

/// What furniture is made of.
const WOOD: &str = "[materials.wood]
diffuse = [0.45, 0.36, 0.27]

";

const GLAZING: &str =
    "[materials.glazing]                   # two panes as one; 0.70 at normal incidence
glass = { ior = 1.52, thin = true, transmittance = 0.76 }
";

/// A dull day; what else there is as a comment.
const SKY: &str = "
# The window looks south: north is +y. A clear noon: type = \"clear\", sun = { azimuth_deg = 180, elevation_deg = 40 },
# sun_normal_lx = 80000. A year of daylight: isolux daylight, with a weather file.
[sky]
type = \"overcast\"
horizontal_lx = 10000
";

/// Runs the subcommand.
pub(crate) fn run(flags: &NewFlags, json: bool) -> Result<Outcome, Failure> {
    let output = OutputPath::check(&flags.output, "toml")?;
    if output.path().exists() && !flags.force {
        return Err(Failure::bad_input(format!(
            "{}: is there already; choose another name, or replace it by --force",
            output.path().display()
        )));
    }
    let text = room(flags.kind, flags.size);
    output.write(text.as_bytes())?;
    let file = output.path().display().to_string();
    if json {
        print_json(&Written { file })?;
    } else {
        print(&format!("{file}\n"))?;
    }
    Ok(Outcome::Done)
}

/// What was written.
#[derive(Serialize)]
struct Written {
    file: String,
}

/// The text of a scene with a room of this width, depth and height, m.
fn room(kind: RoomKind, size: [f64; 3]) -> String {
    let [width, depth, height] = size;
    // Walls without thickness: what lights them from outside is of no account.
    let sided = if kind == RoomKind::Daylit { "sided = \"one\"\n" } else { "" };
    let mut furnished = String::new();
    if kind != RoomKind::Empty {
        furniture(&mut furnished, [width, depth]);
    }
    let wood = if furnished.is_empty() { "" } else { WOOD };
    let (title, own) = match kind {
        RoomKind::Office => ("Office", panel()),
        RoomKind::Empty => ("Room", panel()),
        RoomKind::Daylit => ("Daylit room", GLAZING.to_owned()),
    };
    let mut text = format!(
        "# A room of {width} m x {depth} m x {height} m: x is its width, y its depth, z up. Lengths are in metres.
# All keys: docs/book/scenes.md. To see what there is: isolux check, isolux info.
name = \"{title}\"

[materials.walls]
diffuse = 0.6
{sided}
[materials.ceiling]
diffuse = 0.8
{sided}
[materials.floor]
diffuse = 0.3
{sided}
{wood}{own}"
    );
    if kind == RoomKind::Daylit {
        daylit(&mut text, size);
    } else {
        closed(&mut text, size);
        panels(&mut text, size);
    }
    text += &furnished;
    finish(&mut text, kind, size);
    text
}

fn panel() -> String {
    let cd_m2 = PANEL_LM / (PI * PANEL_M * PANEL_M);
    format!(
        "[materials.panel]                     # a luminous surface: flux / (pi area)
luminance_cd_m2 = {cd_m2:.0}
sided = \"one\"
"
    )
}

fn closed(text: &mut String, [width, depth, height]: [f64; 3]) {
    _ = write!(
        text,
        "
[[geometry]]
name = \"room\"
box = {{ min = [0, 0, 0], max = [{width}, {depth}, {height}], inward = true }}
material = \"walls\"
materials = {{ z_min = \"floor\", z_max = \"ceiling\" }}
"
    );
}

/// Walls with a window at y = 0, and what is outside.
fn daylit(text: &mut String, [width, depth, height]: [f64; 3]) {
    let (left, sill) = (WINDOW_FROM * width, SILL_M.min(0.35 * height));
    let (right, head) = (width - left, height - LINTEL_M.min(0.1 * height));
    let (floor, back, side) = ([0.0, depth, 0.0], [width, 0.0, 0.0], [0.0, 0.0, height]);
    let of = |v: [f64; 3]| v.map(|x| format!("{x:.3}")).join(", ");
    // A rectangle faces the way of u cross v: into the room.
    for (name, corner, (u, v), material) in [
        ("floor", [0.0; 3], (back, floor), "floor"),
        ("ceiling", [0.0, 0.0, height], (floor, back), "ceiling"),
        ("west wall", [0.0; 3], (floor, side), "walls"),
        ("east wall", [width, 0.0, 0.0], (side, floor), "walls"),
        ("north wall", [0.0, depth, 0.0], (back, side), "walls"),
        ("parapet", [0.0; 3], ([0.0, 0.0, sill], back), "walls"),
        ("lintel", [0.0, 0.0, head], ([0.0, 0.0, height - head], back), "walls"),
        (
            "left of the window",
            [0.0, 0.0, sill],
            ([0.0, 0.0, head - sill], [left, 0.0, 0.0]),
            "walls",
        ),
        ("right of it", [right, 0.0, sill], ([0.0, 0.0, head - sill], [left, 0.0, 0.0]), "walls"),
        ("pane", [left, 0.0, sill], ([0.0, 0.0, head - sill], [right - left, 0.0, 0.0]), "glazing"),
    ] {
        _ = write!(
            text,
            "
[[geometry]]
name = \"{name}\"
rectangle = {{ corner = [{}], u = [{}], v = [{}] }}
material = \"{material}\"
",
            of(corner),
            of(u),
            of(v)
        );
    }
    *text += SKY;
}

/// Rows of panels below the ceiling, as many as the illuminance takes.
fn panels(text: &mut String, [width, depth, height]: [f64; 3]) {
    let wanted = WANTED_LX * width * depth / (PANEL_LM * UTILIZED);
    let across = (wanted * width / depth).sqrt().round().max(1.0);
    let along = (wanted / across).round().max(1.0);
    _ = write!(
        text,
        "
# {:.0} luminaires of {PANEL_LM} lm. For a measured one write instead: [[luminaire]] ies = \"lamp.ies\", position, array.
",
        across * along
    );
    let z = height - BELOW_CEILING_M;
    for k in 0..(across * along) as usize {
        let share = |k: usize, of: f64| (k as f64 + 0.5) / of;
        let x = share(k % across as usize, across) * width - 0.5 * PANEL_M;
        let y = share(k / across as usize, along) * depth - 0.5 * PANEL_M;
        let (u, v) = (x + PANEL_M, y + PANEL_M);
        _ = write!(
            text,
            "
[[geometry]]
name = \"panel {}\"
polygon = [[{x:.3}, {y:.3}, {z:.3}], [{x:.3}, {v:.3}, {z:.3}], [{u:.3}, {v:.3}, {z:.3}], [{u:.3}, {y:.3}, {z:.3}]]
material = \"panel\"
",
            k + 1
        );
    }
}

/// Desks along the far wall, and a cupboard beside the door.
fn furniture(text: &mut String, [width, depth]: [f64; 2]) {
    let [wide, deep, high] = DESK_M;
    let room_for = |space: f64, each: f64| ((space - 2.0 * FROM_WALL_M) / each).floor().max(0.0);
    let across = room_for(width, DESK_FLOOR_M[0]) as usize;
    let along = room_for(depth, DESK_FLOOR_M[1]) as usize;
    for k in 0..across * along {
        let x = FROM_WALL_M + DESK_FLOOR_M[0] * (k % across) as f64;
        let y = depth - FROM_WALL_M - deep - DESK_FLOOR_M[1] * (k / across) as f64;
        let parts = [
            ("top", [0.0, 0.0, high - 0.03], [wide, deep, high]),
            ("left side", [0.05, 0.05, 0.0], [0.08, deep - 0.05, high - 0.03]),
            ("right side", [wide - 0.08, 0.05, 0.0], [wide - 0.05, deep - 0.05, high - 0.03]),
        ];
        for (part, low, high) in parts {
            slab(text, &format!("desk {} {part}", k + 1), [x, y], (low, high));
        }
    }
    if width > 2.0 && depth > 2.0 {
        slab(text, "cupboard", [width - 0.46, 0.0], ([0.0, 0.05, 0.0], [0.45, 1.05, 1.8]));
    }
}

/// A box of wood, from its lowest to its highest corner from a place of the floor on.
fn slab(text: &mut String, name: &str, [x, y]: [f64; 2], (low, high): ([f64; 3], [f64; 3])) {
    let at = |[dx, dy, z]: [f64; 3]| format!("[{:.3}, {:.3}, {z:.3}]", x + dx, y + dy);
    _ = write!(
        text,
        "
[[geometry]]
name = \"{name}\"
box = {{ min = {}, max = {} }}
material = \"wood\"
",
        at(low),
        at(high)
    );
}

/// A camera at the door, which is opposite of the window, and a grid over the working plane.
fn finish(text: &mut String, kind: RoomKind, [width, depth, height]: [f64; 3]) {
    let eye = 1.6_f64.min(0.7 * height);
    let (from_y, to_y) = match kind {
        RoomKind::Daylit => (0.94 * depth, 0.0),
        RoomKind::Office | RoomKind::Empty => (0.06 * depth, depth),
    };
    let border = 0.5_f64.min(0.15 * width.min(depth));
    _ = write!(
        text,
        "
[[camera]]
name = \"door\"
position = [{:.2}, {:.2}, {eye:.2}]
target = [{:.2}, {:.2}, {:.2}]
vertical_fov_deg = 62

# Em, Emin and U0 of the working plane: isolux grid map.glb
[[grid]]
name = \"working plane\"
corner = [{border:.3}, {border:.3}, 0.75]
u = [{:.3}, 0, 0]
v = [0, {:.3}, 0]
",
        0.06 * width,
        from_y,
        0.7 * width,
        to_y,
        0.3 * height,
        width - 2.0 * border,
        depth - 2.0 * border
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::scene::Scene;

    #[test]
    fn every_room_is_a_scene_without_problems() {
        let folder = tempfile::tempdir().unwrap();
        for (kind, size) in [
            (RoomKind::Office, [6.0, 5.0, 2.8]),
            (RoomKind::Office, [2.0, 1.5, 2.2]),
            (RoomKind::Office, [30.0, 12.0, 3.2]),
            (RoomKind::Office, [1.0, 1.0, 1.0]),
            (RoomKind::Empty, [4.0, 4.0, 3.0]),
            (RoomKind::Daylit, [6.0, 5.0, 2.8]),
            (RoomKind::Daylit, [1.0, 1.0, 1.0]),
        ] {
            let path = folder.path().join("room.toml");
            std::fs::write(&path, room(kind, size)).unwrap();
            let parts = crate::source::read_parts(&path).unwrap_or_else(|_| panic!("{size:?}"));
            // Regression: rooms without furniture had a material that nothing used.
            assert_eq!(parts.warnings, [], "{kind:?} {size:?}");
            let scene = Scene::assemble(parts.value).unwrap();
            assert_eq!(scene.cameras().len(), 1);
            if kind == RoomKind::Daylit {
                assert!(scene.gives_light() && scene.luminous_flux_lm() == 0.0, "{size:?}");
                continue;
            }
            let lm_a_m2 = scene.luminous_flux_lm() / (size[0] * size[1]);
            // Between half and twice the flux that the illuminance takes: panels are whole ones.
            assert!(
                (0.5..2.0).contains(&(lm_a_m2 * UTILIZED / WANTED_LX)) || size[0] < 3.0,
                "{lm_a_m2}"
            );
        }
    }
}
