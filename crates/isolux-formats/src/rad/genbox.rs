//! `genbox`: a box, sharp, bevelled or rounded.

use super::record::Object;
use super::words::number;

/// A box as its arguments say.
struct Cuboid {
    material: String,
    name: String,
    size: [f64; 3],
    inward: bool,
    edge: Edge,
}

enum Edge {
    Sharp,
    Bevel(f64),
    Round(f64),
}

/// The objects that `genbox` writes for these words, all on one line of the file.
pub(super) fn objects(words: &[String], line: usize) -> Result<Vec<Object>, String> {
    let cuboid = parse(words)?;
    let maker = Maker { cuboid: &cuboid, line };
    let inset = match cuboid.edge {
        Edge::Sharp => 0.0,
        Edge::Bevel(by) | Edge::Round(by) => by,
    };
    let mut objects = maker.faces(inset);
    match cuboid.edge {
        Edge::Sharp => {}
        Edge::Bevel(by) => objects.extend(maker.bevels(by)),
        Edge::Round(by) => objects.extend(maker.rounds(by)),
    }
    Ok(objects)
}

fn parse(words: &[String]) -> Result<Cuboid, String> {
    let usage = "it needs a material, a name and three sizes";
    let [material, name, x, y, z, options @ ..] = words else { return Err(usage.into()) };
    let size = [number(x), number(y), number(z)].map(|s| s.filter(|&s| s > 0.0));
    let [Some(x), Some(y), Some(z)] = size else { return Err(usage.into()) };
    let mut cuboid = Cuboid {
        material: material.clone(),
        name: name.clone(),
        size: [x, y, z],
        inward: false,
        edge: Edge::Sharp,
    };
    let mut options = options.iter().map(String::as_str);
    while let Some(option) = options.next() {
        let mut value = || {
            let value = options.next().and_then(number);
            let least = x.min(y).min(z);
            value
                .filter(|&v| v > 0.0 && 2.0 * v < least)
                .ok_or_else(|| format!("{option} needs a number below half of each size"))
        };
        match option {
            "-i" => cuboid.inward = true,
            "-b" => cuboid.edge = Edge::Bevel(value()?),
            "-r" => cuboid.edge = Edge::Round(value()?),
            _ => return Err(format!("its option `{option}` is not read")),
        }
    }
    if cuboid.inward && !matches!(cuboid.edge, Edge::Sharp) {
        return Err("-i with -b or -r".into());
    }
    Ok(cuboid)
}

/// The signs of a corner, seen from the middle.
type Corner = [bool; 3];

struct Maker<'a> {
    cuboid: &'a Cuboid,
    line: usize,
}

impl Maker<'_> {
    /// A corner of the box, moved inwards along each axis.
    fn corner(&self, corner: Corner, inset: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| if corner[k] { self.cuboid.size[k] - inset[k] } else { inset[k] })
    }

    fn object(&self, type_: &str, part: &str, numbers: Vec<f64>) -> Object {
        Object {
            line: self.line,
            modifier: self.cuboid.material.clone(),
            type_: type_.to_owned(),
            name: format!("{}.{part}", self.cuboid.name),
            strings: Vec::new(),
            numbers,
        }
    }

    /// A polygon that faces away from the middle, or towards it.
    fn polygon(&self, part: &str, mut corners: Vec<[f64; 3]>) -> Object {
        let arm = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| b[k] - a[k]);
        let (u, v) = (arm(corners[0], corners[1]), arm(corners[1], corners[2]));
        let normal =
            [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
        let middle = self.cuboid.size.map(|s| 0.5 * s);
        let outwards: f64 = (0..3).map(|k| normal[k] * (corners[0][k] - middle[k])).sum();
        if (outwards < 0.0) != self.cuboid.inward {
            corners.reverse();
        }
        self.object("polygon", part, corners.concat())
    }

    fn faces(&self, inset: f64) -> Vec<Object> {
        let face = |axis: usize, high: bool| {
            let corners = [(false, false), (true, false), (true, true), (false, true)];
            let corners = corners.map(|(a, b)| {
                let mut corner = [high; 3];
                (corner[(axis + 1) % 3], corner[(axis + 2) % 3]) = (a, b);
                let mut by = [inset; 3];
                by[axis] = 0.0;
                self.corner(corner, by)
            });
            self.polygon(&format!("{}{}", ['x', 'y', 'z'][axis], u8::from(high)), corners.into())
        };
        (0..3).flat_map(|axis| [face(axis, false), face(axis, true)]).collect()
    }

    /// The two ends of every edge.
    fn edges() -> Vec<(usize, Corner, Corner)> {
        let mut edges = Vec::with_capacity(12);
        for axis in 0..3 {
            for (a, b) in [(false, false), (false, true), (true, false), (true, true)] {
                let mut low = [false; 3];
                (low[(axis + 1) % 3], low[(axis + 2) % 3]) = (a, b);
                let mut high = low;
                high[axis] = true;
                edges.push((axis, low, high));
            }
        }
        edges
    }

    fn corners() -> [Corner; 8] {
        [0, 1, 2, 3, 4, 5, 6, 7].map(|bits: u8| [0, 1, 2].map(|k| bits >> k & 1 == 1))
    }

    /// Strips along the edges and triangles at the corners.
    fn bevels(&self, by: f64) -> Vec<Object> {
        let strip = |(number, (axis, low, high)): (usize, (usize, Corner, Corner))| {
            let end = |corner: Corner, other: usize| {
                let mut inset = [by; 3];
                inset[other] = 0.0;
                self.corner(corner, inset)
            };
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let corners = vec![end(low, u), end(high, u), end(high, v), end(low, v)];
            self.polygon(&format!("e{number}"), corners)
        };
        let tip = |(number, corner): (usize, Corner)| {
            let corners = [0, 1, 2].map(|axis: usize| {
                let mut inset = [by; 3];
                inset[axis] = 0.0;
                self.corner(corner, inset)
            });
            self.polygon(&format!("c{number}"), corners.into())
        };
        let strips = Self::edges().into_iter().enumerate().map(strip);
        strips.chain(Self::corners().into_iter().enumerate().map(tip)).collect()
    }

    /// Cylinders along the edges and spheres at the corners, whole as `genbox` writes them.
    fn rounds(&self, by: f64) -> Vec<Object> {
        let along = |(number, (_, low, high)): (usize, (usize, Corner, Corner))| {
            let ends = [self.corner(low, [by; 3]), self.corner(high, [by; 3])].concat();
            self.object("cylinder", &format!("e{number}"), [ends, vec![by]].concat())
        };
        let at = |(number, corner): (usize, Corner)| {
            let [x, y, z] = self.corner(corner, [by; 3]);
            self.object("sphere", &format!("c{number}"), vec![x, y, z, by])
        };
        let cylinders = Self::edges().into_iter().enumerate().map(along);
        cylinders.chain(Self::corners().into_iter().enumerate().map(at)).collect()
    }
}
