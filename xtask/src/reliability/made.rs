//! Scenes with many of one thing, as texts that are made by repetition.

/// The size that files are filled up to, bytes.
const SIZE: usize = 1_000_000;

/// Files with many of one thing.
pub(super) struct Kind {
    /// The name of the file.
    pub(super) name: &'static str,
    pub(super) what: &'static str,
    head: &'static str,
    /// What is repeated. `{i}` counts; `{x}` and `{y}` are places in a room of 100 m, `{z}` is between 1 and 2, different each time.
    unit: &'static str,
    tail: &'static str,
    /// Where a file says how often something is there, that number: it stands for `{n}`.
    multiplied: Option<usize>,
    /// Other files that it needs.
    pub(super) beside: &'static [(&'static str, &'static str)],
}

impl Kind {
    /// The text of the file, and how many things it has.
    pub(super) fn file(&self) -> (String, usize) {
        if let Some(count) = self.multiplied {
            let text = [self.head, self.unit, self.tail].concat();
            return (text.replace("{n}", &count.to_string()), count);
        }
        let mut text = self.head.to_owned();
        let mut count = 0;
        loop {
            let unit = self.one(count);
            if text.len() + unit.len() + self.tail.len() > SIZE {
                return (text + self.tail, count);
            }
            text += &unit;
            count += 1;
        }
    }

    fn one(&self, number: usize) -> String {
        let across = |step: usize| (1 + number / step % 97).to_string();
        let height = 1.0 + (number % 100_000) as f64 * 1e-5;
        let places = [("{x}", across(1)), ("{y}", across(97)), ("{z}", format!("{height:.5}"))];
        let one = self.unit.replace("{i}", &number.to_string());
        places.iter().fold(one, |text, (name, place)| text.replace(name, place))
    }
}

const ROOM: &str = "[materials.p]\ndiffuse = 0.5\n[materials.g]\nluminance_cd_m2 = 100\n[materials.w]\nglass = { thin = true }\n[materials.m]\nmirror = 0.9\n\
    [[geometry]]\nbox = { min = [0, 0, 0], max = [100, 100, 3], inward = true }\nmaterial = \"p\"\n\
    [[luminaire]]\nisotropic = { intensity_cd = 100 }\nposition = [1, 1, 1]\n";
const RAD: &str = "void plastic g\n0\n0\n5 .5 .5 .5 0 0\ng polygon f\n0\n0\n12 0 0 0 100 0 0 100 100 0 0 100 0\n\
    void light l\n0\n0\n3 10 10 10\nl polygon L\n0\n0\n12 0 0 2.9 0 .1 2.9 .1 .1 2.9 .1 0 2.9\n";
const OBJ: &str = "mtllib m.mtl\nv 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 100 0\nv 0 0 3\nv 1 0 3\nv 1 1 3\nv 0 1 3\nusemtl a\nf 1 2 3 4\nusemtl e\nf 8 7 6 5\n";
const MTL: &[(&str, &str)] =
    &[("m.mtl", "newmtl a\nKd .5 .5 .5\nnewmtl e\nKd .5 .5 .5\nKe 10 10 10\n")];
const XML: &str = "<scene version=\"3.0.0\"><shape type=\"rectangle\"><bsdf type=\"diffuse\"/></shape><shape type=\"rectangle\"><transform name=\"to_world\">\
    <translate z=\"2\"/></transform><emitter type=\"area\"/></shape>";
const PART: &[(&str, &str)] = &[
    (
        "grey.rad",
        "void plastic g\n0\n0\n5 .5 .5 .5 0 0\ng polygon p\n0\n0\n12 0 0 2  0 .1 2  .1 .1 2  .1 0 2\n",
    ),
    (
        "light.rad",
        "void light l\n0\n0\n3 10 10 10\nl polygon p\n0\n0\n12 0 0 2  0 .1 2  .1 .1 2  .1 0 2\n",
    ),
    (
        "glass.rad",
        "void glass g\n0\n0\n3 .8 .8 .8\ng polygon p\n0\n0\n12 0 0 2  0 .1 2  .1 .1 2  .1 0 2\n",
    ),
];

const fn toml(what: &'static str, unit: &'static str) -> Kind {
    Kind { name: "scene.toml", what, head: ROOM, unit, tail: "", multiplied: None, beside: &[] }
}

const fn rad(what: &'static str, unit: &'static str) -> Kind {
    Kind { name: "scene.rad", what, head: RAD, unit, tail: "", multiplied: None, beside: PART }
}

const fn obj(what: &'static str, unit: &'static str) -> Kind {
    Kind { name: "scene.obj", what, head: OBJ, unit, tail: "", multiplied: None, beside: MTL }
}

const fn xml(what: &'static str, unit: &'static str) -> Kind {
    let tail = "</scene>";
    Kind { name: "scene.xml", what, head: XML, unit, tail, multiplied: None, beside: &[] }
}

const fn times(count: usize, kind: Kind) -> Kind {
    Kind { multiplied: Some(count), ..kind }
}

/// All kinds.
pub(super) const KINDS: &[Kind] = &[
    toml(
        "luminaires at one place",
        "[[luminaire]]\nisotropic = { intensity_cd = 100 }\nposition = [1, 1, 1]\n",
    ),
    toml(
        "groups",
        "[[luminaire]]\nisotropic = { intensity_cd = 100 }\nposition = [{x}, {y}, {z}]\ngroup = \"g{i}\"\n",
    ),
    toml("suns", "[[luminaire]]\ndirectional = { illuminance_lx = 1 }\ndirection = [0, 0.1, -1]\n"),
    toml(
        "grids",
        "[[grid]]\nname = \"g{i}\"\ncorner = [1, 1, 0.8]\nu = [1, 0, 0]\nv = [0, 1, 0]\n",
    ),
    toml(
        "grids, each with a requirement for all",
        "[[grid]]\ncorner = [1, 1, 0.8]\nu = [1, 0, 0]\nv = [0, 1, 0]\n[[requirement]]\nconditions = \"Em >= 100\"\n",
    ),
    toml("cameras", "[[camera]]\nname = \"c{i}\"\nposition = [1, 1, 1]\ntarget = [2, 2, 1]\n"),
    toml("materials", "[materials.m{i}]\ndiffuse = 0.5\n"),
    toml(
        "surfaces",
        "[[geometry]]\nmaterial = \"p\"\nrectangle = { corner = [{x}, {y}, {z}], u = [1, 0, 0], v = [0, 1, 0] }\n",
    ),
    toml(
        "surfaces on each other",
        "[[geometry]]\nmaterial = \"p\"\nrectangle = { corner = [1, 1, 1], u = [1, 0, 0], v = [0, 1, 0] }\n",
    ),
    toml(
        "boxes around each other",
        "[[geometry]]\nmaterial = \"p\"\nbox = { min = [1, 1, 0.5], max = [50, 50, {z}] }\n",
    ),
    toml(
        "luminous boxes through each other",
        "[[geometry]]\nmaterial = \"g\"\nbox = { min = [1, 1, {z}], max = [2, 2, 2.5] }\n",
    ),
    toml(
        "luminous surfaces",
        "[[geometry]]\nmaterial = \"g\"\nrectangle = { corner = [{x}, {y}, {z}], u = [1, 0, 0], v = [0, 1, 0] }\n",
    ),
    toml(
        "wide luminous surfaces",
        "[[geometry]]\nmaterial = \"g\"\nrectangle = { corner = [1, 1, {z}], u = [90, 0, 0], v = [0, 90, 0] }\n",
    ),
    toml(
        "panes behind each other",
        "[[geometry]]\nmaterial = \"w\"\nrectangle = { corner = [1, 1, {z}], u = [9, 0, 0], v = [0, 9, 0] }\n",
    ),
    toml(
        "mirrors behind each other",
        "[[geometry]]\nmaterial = \"m\"\nrectangle = { corner = [1, 1, {z}], u = [9, 0, 0], v = [0, 9, 0] }\n",
    ),
    times(
        500_000,
        toml(
            "luminaires by `array`",
            "[[luminaire]]\nisotropic = { intensity_cd = 100 }\nposition = [0.1, 0.1, 2]\narray = { count = [{n}, 1, 1], step = [0.0001, 0, 0] }\n",
        ),
    ),
    times(
        500_000,
        toml(
            "luminaires on a wall",
            "[[luminaire]]\nisotropic = { intensity_cd = 100 }\nposition = [0.1, 0, 2]\narray = { count = [{n}, 1, 1], step = [0.0001, 0, 0] }\n",
        ),
    ),
    times(
        500_000,
        toml(
            "luminaires with an area",
            "[[luminaire]]\ncosine = { peak_cd = 100 }\nposition = [0.1, 1, 2]\nluminous_area = { shape = \"box\", size_m = [0.5, 0.5, 0.1] }\narray = { count = [{n}, 1, 1], step = [0.0001, 0, 0] }\n",
        ),
    ),
    rad("polygons", "g polygon p{i}\n0\n0\n9 {x} {y} {z} 0 1 {z} 1 1 {z}\n"),
    rad("lights", "l polygon p{i}\n0\n0\n9 {x} {y} {z} 0 1 {z} 1 1 {z}\n"),
    rad(
        "materials",
        "void plastic m{i}\n0\n0\n5 .5 .5 .5 0 0\nm{i} polygon p{i}\n0\n0\n9 {x} {y} {z} 0 1 {z} 1 1 {z}\n",
    ),
    rad("sources", "l source p{i}\n0\n0\n4 0 0 1 .5\n"),
    times(500_000, rad("surfaces by `xform`", "!xform -a {n} -t 0 0 .000002 grey.rad\n")),
    times(500_000, rad("panes by `xform`", "!xform -a {n} -t 0 0 .000002 glass.rad\n")),
    times(500_000, rad("lights by `xform`", "!xform -a {n} -t 0 0 .000002 light.rad\n")),
    obj("groups", "g g{i}\nusemtl a\nv {x} {y} {z}\nf 1 2 -1\n"),
    obj("luminous groups", "g g{i}\nusemtl e\nv {x} {y} {z}\nf 1 2 -1\n"),
    obj("luminous groups on each other", "g g{i}\nusemtl e\nf 1 2 5\n"),
    obj("faces at one edge", "usemtl a\nv {x} {y} {z}\nf 1 3 -1\n"),
    obj("luminous faces at one edge", "v {x} {y} {z}\nf 1 3 -1\n"),
    obj("luminous faces at one vertex", "v {x} {y} {z}\nv {x} {y} 0\nf 1 -2 -1\n"),
    xml("shapes", "<shape type=\"rectangle\"><bsdf type=\"diffuse\"/></shape>"),
    xml(
        "emitters",
        "<shape type=\"rectangle\"><transform name=\"to_world\"><translate z=\"{z}\"/></transform><emitter type=\"area\"/></shape>",
    ),
    xml(
        "materials and references",
        "<bsdf type=\"diffuse\" id=\"b{i}\"/><shape type=\"rectangle\"><ref id=\"b{i}\"/></shape>",
    ),
    xml("parameters", "<default name=\"a{i}\" value=\"1\"/>"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_filled_up_or_say_how_often_something_is_there() {
        for kind in KINDS {
            let (text, count) = kind.file();
            assert!(text.len() <= SIZE && count > 1000, "{}: {count}", kind.what);
            assert!(!text.contains("{n}") && !text.contains("{i}"), "{}", kind.what);
        }
        let (text, _) = toml("boxes", "{i}: {x} {y} {z}\n").file();
        assert!(text.contains("\n98: 2 2 1.00098\n"), "numbers differ from place to place");
    }
}
