//! The table: scenes, where they are read, and what is due there.

/// A room of 4 m x 3 m x 2.5 m with its fronts inside.
pub(super) const ROOM: &str = "[materials.m]\ndiffuse = 0.5\n[[geometry]]\nmaterial = 'm'\n\
    box = { min = [0, 0, 0], max = [4, 3, 2.5], inward = true }\n";
/// The same from a file `room.obj`.
const FILE: &str =
    "[materials.m]\ndiffuse = 0.5\n[[geometry]]\nfile = 'room.obj'\nup = 'z'\nmaterial = 'm'\n";
const LAMP: &str = "[[luminaire]]\nposition = [1.7, 1.4, 2]\nisotropic = { intensity_cd = 100 }\n";
/// On the floor and on a wall of the room.
const POINTS: &str = "1 1 0 0 0 1\n4 1 1 -1 0 0\n";
const OBJ: &str = "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2.5\nv 4 0 2.5\nv 4 3 2.5\nv 0 3 2.5\n\
    f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

/// A floor with a lamp over it, in the open.
const FLOOR: &str = "[materials.m]\ndiffuse = 0.5\n[[geometry]]\nmaterial = 'm'\n\
    rectangle = { corner = [-5, -5, 0], u = [10, 0, 0], v = [0, 10, 0] }\n\
    [[luminaire]]\nposition = [0, 0, 2]\nisotropic = { intensity_cd = 100 }\n";
/// The room without the wall at x = 4.
const OPEN_ROOM: &str = "[materials.m]\ndiffuse = 0.5\n\
    [[geometry]]\nmaterial = 'm'\npolygon = [[0,0,0],[4,0,0],[4,3,0],[0,3,0]]\n\
    [[geometry]]\nmaterial = 'm'\npolygon = [[0,0,2.5],[0,3,2.5],[4,3,2.5],[4,0,2.5]]\n\
    [[geometry]]\nmaterial = 'm'\npolygon = [[0,0,0],[0,0,2.5],[4,0,2.5],[4,0,0]]\n\
    [[geometry]]\nmaterial = 'm'\npolygon = [[0,3,0],[4,3,0],[4,3,2.5],[0,3,2.5]]\n\
    [[geometry]]\nmaterial = 'm'\npolygon = [[0,0,0],[0,3,0],[0,3,2.5],[0,0,2.5]]\n";
/// The sun, as bright as at noon, and a candle.
const SUN_AND_CANDLE: &str = "[[luminaire]]\nname = 'sun'\ndirection = [-1, 0.1, -1]\n\
    directional = { illuminance_lx = 90000 }\n\
    [[luminaire]]\nname = 'candle'\nposition = [1, 1, 1]\nisotropic = { intensity_cd = 1 }\n";
/// A closed box around the lamp.
const HOUSING: &str =
    "[[geometry]]\nmaterial = 'm'\nbox = { min = [1.5, 1.2, 1.8], max = [1.9, 1.6, 2.2] }\n";
/// In the plane of the floor.
const RUG: &str = "[materials.n]\ndiffuse = 0.1\n[[geometry]]\nmaterial = 'n'\n\
    rectangle = { corner = [1.5, 0.5, 0], u = [2, 0, 0], v = [0, 2, 0] }\n";
/// A luminaire that is half inside of the wall at x = 0.
const THROUGH_A_WALL: &str = "[[luminaire]]\nposition = [0.1, 1.4, 1.5]\nisotropic = { intensity_cd = 100 }\n\
    luminous_area = { shape = 'cylinder_x', size_m = [0.6, 0.1, 0.1] }\n";
/// A second room, without light, a micrometre beside the first.
const BESIDE: &str = "[[geometry]]\nmaterial = 'm'\n\
    box = { min = [4.000001, 0, 0], max = [8, 3, 2.5], inward = true }\n";

/// What is due of a scene.
#[derive(Debug)]
pub(super) enum Due {
    /// Readings of the map are those of complete paths.
    AsPaths,
    /// Readings are those of the room from a file, to the last bit.
    AsTheRoom,
    /// Readings are this illuminance, to rounding, lx.
    Exactly(&'static [f64]),
    /// All is dark, and known to be.
    Dark,
    /// There is no reading, and a message says why.
    Told(&'static str),
    /// The error of the map is not known, which a message says, with exit code 3.
    WithoutError(&'static str),
    /// There is no map, and a message says why, with exit code 2.
    Refused(&'static str),
}

pub(super) struct Case {
    pub(super) name: &'static str,
    pub(super) scene: String,
    /// The file `room.obj`.
    pub(super) obj: String,
    pub(super) points: String,
    pub(super) due: Due,
}

/// The room from a file.
pub(super) fn room() -> Case {
    case("the room", format!("{FILE}{LAMP}"), Due::AsPaths)
}

pub(super) fn cases() -> Vec<Case> {
    let plain = format!("{ROOM}{LAMP}");
    let turned = plain.replace("inward = true", "inward = false");
    let at = |points: &str, case: Case| Case { points: points.to_owned(), ..case };
    let of_file = |name, more: &str, due| Case {
        obj: format!("{OBJ}{more}"),
        ..case(name, format!("{FILE}{LAMP}"), due)
    };
    vec![
        case("no light", ROOM.to_owned(), Due::Refused("the scene has no light; add")),
        case("no surface", LAMP.to_owned(), Due::Refused("the scene has no geometry; add")),
        // I cos / r2: of 100 cd from 2 m above, and from the square root of 8 m at 45 degrees.
        at(
            "0 0 0 0 0 1\n2 0 0 0 0 1\n",
            case("open", FLOOR.to_owned(), Due::Exactly(&[25.0, 8.838_834_764_831_844])),
        ),
        of_file("triangles without area", "v 2 0 0\nf 1 1 2\nf 1 9 2\n", Due::AsTheRoom),
        of_file("triangles twice", "f 1 2 3 4\nf 4 3 2 1\n", Due::AsTheRoom),
        of_file("a corner of NaN", "v nan 0 0\n", Due::Refused("line 15: `nan 0 0` is not three")),
        case(
            "a luminaire at NaN",
            plain.replace("1.7", "nan"),
            Due::Refused("NaN is out of range"),
        ),
        shifted("3 km away", 3000.0, Due::AsPaths),
        shifted("1000 km away", 1e6, Due::Refused("single precision resolves 62 mm")),
        scaled("1 mm", 0.000_25),
        scaled("10 km", 2500.0),
        case(
            "all light reflected",
            plain.replace("diffuse = 0.5", "diffuse = 1"),
            Due::WithoutError("surfaces that absorb almost nothing"),
        ),
        case("light inside a closed box", format!("{plain}{HOUSING}"), Due::Dark),
        case("a luminaire outside of the room", plain.replace("1.4, 2]", "1.4, 3]"), Due::Dark),
        at(
            "1 1 0 0 0 1\n4 1 1 -1 0 0\n0.7 2.5 0 0 0 1\n",
            case("a rug in the plane of the floor", format!("{plain}{RUG}"), Due::AsPaths),
        ),
        case("normals turned, sides alike", turned.clone(), Due::AsPaths),
        case(
            "normals turned, black inside",
            turned.replace("0.5\n", "0.5\nsided = 'one'\n"),
            Due::Told("no light reaches any surface"),
        ),
        case("a luminaire on the ceiling", plain.replace("1.4, 2]", "1.4, 2.5]"), Due::AsPaths),
        at(
            "4 1 1 -1 0 0\n3 2.9 0 0 0 1\n",
            case("a luminaire through a wall", format!("{ROOM}{THROUGH_A_WALL}"), Due::AsPaths),
        ),
        at(
            "1 1 0 0 0 1\n",
            case("sun beside a candle", format!("{OPEN_ROOM}{SUN_AND_CANDLE}"), Due::AsPaths),
        ),
        of_file("needles of a micrometre", &needles(), Due::AsPaths),
        at(
            "1 1 0 0 0 1\n4 1 1 -1 0 0\n6 1 0 0 0 1\n8 1 1 -1 0 0\n",
            case("dark behind a micrometre", format!("{plain}{BESIDE}"), Due::AsPaths),
        ),
    ]
}

fn case(name: &'static str, scene: String, due: Due) -> Case {
    Case { name, scene, obj: OBJ.to_owned(), points: POINTS.to_owned(), due }
}

/// The room and its lamp in another size; the illuminance stays what it is.
fn scaled(name: &'static str, factor: f64) -> Case {
    let [x, y, z] = [4.0, 3.0, 2.5].map(|side| side * factor);
    let at = [1.7, 1.4, 2.0].map(|c| c * factor);
    let cd = 100.0 * factor * factor;
    let scene = format!("{ROOM}{LAMP}")
        .replace("[4, 3, 2.5]", &format!("[{x:?}, {y:?}, {z:?}]"))
        .replace("[1.7, 1.4, 2]", &format!("{at:?}"))
        .replace("intensity_cd = 100", &format!("intensity_cd = {cd:?}"));
    let points = format!("{factor} {factor} 0 0 0 1\n{x} {factor} {factor} -1 0 0\n");
    Case { points, ..case(name, scene, Due::AsPaths) }
}

/// The room and its lamp so many metres along x.
fn shifted(name: &'static str, x_m: f64, due: Due) -> Case {
    let at = |x: f64| x + x_m;
    let scene = format!("{ROOM}{LAMP}")
        .replace("min = [0,", &format!("min = [{:?},", at(0.0)))
        .replace("max = [4,", &format!("max = [{:?},", at(4.0)))
        .replace("[1.7,", &format!("[{:?},", at(1.7)));
    let points = format!("{} 1 0 0 0 1\n{} 1 1 -1 0 0\n", at(1.0), at(4.0));
    Case { points, ..case(name, scene, due) }
}

/// Twenty upright strips of a micrometre by two metres, after the eight corners of the room.
fn needles() -> String {
    let mut text = String::new();
    for k in 0..20 {
        let x = 0.5 + 0.1 * f64::from(k);
        for [x, y] in [[x, 0.5], [x, 2.5], [x + 1e-6, 2.5], [x + 1e-6, 0.5]] {
            text += &format!("v {x} {y} 1\n");
        }
        text += "f -4 -3 -2 -1\n";
    }
    text
}
