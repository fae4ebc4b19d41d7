//! How far a scene lies from its origin, and whether single precision tells its surfaces apart there.
//!
//! Most files keep coordinates in single precision, whose numbers lie the farther apart the larger they are: at
//! 10 km they are known to 1 mm, at 100 km to 8 mm. The error that is reported is that of light among surfaces so
//! displaced: it tells nothing of that. The ray kernel counts coordinates from an origin near the scene and adds
//! nothing. The limits are those of a room of 4 x 3 x 5 m, traced in coordinates of the world: it reads right up to
//! 9 km from the origin, and wrong by a seventh at 10 km.

use crate::quantity::significant;
use isolux::geometry::Point;
use isolux::scene::Scene;
use isolux_formats::Problem;
use std::path::Path;

/// Coordinates resolve a millimetre up to here: 2^-23 of it is 1.2 mm.
const FAR_M: f64 = 10_000.0;

/// The coarsest step of coordinates, in largest sides of the scene, with which there are results: that of the room
/// above up to 8 km. The next, twice as coarse, is that of 10 km.
const COARSEST: f64 = 1.0 / 8000.0;

/// The box around all surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extent {
    low_m: [f64; 3],
    high_m: [f64; 3],
}

/// What is to be said of a scene before light is computed in it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Remoteness {
    /// Nothing.
    Near,
    /// Details may be lost.
    Far(Problem),
    /// Results would be wrong.
    TooFar(Problem),
}

impl Extent {
    /// Of a scene; a point at the origin where it has no surface.
    pub(crate) fn of(scene: &Scene) -> Self {
        let bounds = scene.bvh().mesh().bounds();
        let (low_m, high_m) =
            bounds.map_or_else(Default::default, |(low, high)| (low.into(), high.into()));
        Self { low_m, high_m }
    }

    /// Whether a point lies in it.
    pub(crate) fn holds(&self, point: Point) -> bool {
        let at_m = <[f64; 3]>::from(point);
        (0..3).all(|k| (self.low_m[k]..=self.high_m[k]).contains(&at_m[k]))
    }

    /// Its sides.
    pub(crate) fn size_m(&self) -> [f64; 3] {
        std::array::from_fn(|k| self.high_m[k] - self.low_m[k])
    }

    /// Its largest side.
    pub(crate) fn largest_m(&self) -> f64 {
        self.size_m().into_iter().fold(0.0, f64::max)
    }

    fn farthest_m(&self) -> f64 {
        self.low_m.iter().chain(&self.high_m).fold(0.0_f64, |far, c| far.max(c.abs()))
    }

    /// Whether it lies so far off that single precision leaves too little of it. What is merely large
    /// is resolved no better elsewhere.
    pub(crate) fn remoteness(&self, source: &Path) -> Remoteness {
        let (farthest_m, largest_m) = (self.farthest_m(), self.largest_m());
        let step_m = step_m(farthest_m);
        let is_too_far = step_m > COARSEST * largest_m;
        if largest_m <= 0.0 || farthest_m <= largest_m || !(farthest_m > FAR_M || is_too_far) {
            return Remoteness::Near;
        }
        let [far, side] = [farthest_m, largest_m].map(|m| significant(m, 3));
        let step = match step_m {
            m if m < 0.1 => format!("{} mm", significant(1e3 * m, 2)),
            m => format!("{} m", significant(m, 2)),
        };
        let [x, y, z] = self.nearer_m().map(|c| c.to_string());
        let found = |consequence: &str| {
            let what = format!(
                "it reaches {far} m from its origin, where single precision resolves {step}: {consequence} a scene \
                 of {side} m"
            );
            let remedy = format!("move it near the origin, by ({x}, {y}, {z}) m");
            Problem::new(source, "", what, remedy)
        };
        match is_too_far {
            true => Remoteness::TooFar(found("too little for right results in")),
            false => Remoteness::Far(found("details may be lost in")),
        }
    }

    /// A translation to the neighbourhood of the origin, in round numbers.
    fn nearer_m(&self) -> [f64; 3] {
        let step_m = 10.0_f64.powf(self.largest_m().log10().ceil());
        // Without the minus of zero.
        std::array::from_fn(|k| {
            let centre_m = 0.5 * (self.low_m[k] + self.high_m[k]);
            0.0 - (centre_m / step_m).round() * step_m
        })
    }
}

/// How far numbers of single precision lie apart at a coordinate.
fn step_m(coordinate_m: f64) -> f64 {
    let coordinate = coordinate_m as f32;
    f64::from(coordinate.next_up()) - f64::from(coordinate)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(low_m: [f64; 3], size_m: [f64; 3], expected: &str) {
        let high_m = std::array::from_fn(|k| low_m[k] + size_m[k]);
        let told = match (Extent { low_m, high_m }).remoteness(Path::new("a.glb")) {
            Remoteness::Near => "near".to_owned(),
            Remoteness::Far(problem) => format!("far: {problem}"),
            Remoteness::TooFar(problem) => format!("too far: {problem}"),
        };
        assert!(told.contains(expected), "{low_m:?}, {size_m:?}: {told}");
    }

    /// The places of the room whose readings are above, and scenes of other sizes.
    #[test]
    fn what_is_resolved_decides() {
        let room = [4.0, 3.0, 5.0];
        check([0.0; 3], room, "near");
        check([9000.0, 0.0, 0.0], room, "near");
        check([10_000.0, 0.0, 0.0], room, "too far: a.glb: it reaches 10004 m");
        check([20_000.0, 0.0, 0.0], room, "too far");
        check([0.0, -100_000.0, 0.0], room, "resolves 7.8 mm: too little");
        check([500_000.0, 0.0, 4e6], room, "by (-500000, 0, -4000000) m");
        // A site; a model of a lamp; a country, and one without a size.
        check([500_000.0, 0.0, 5e6], [900.0, 50.0, 900.0], "too far");
        check([30_000.0, 0.0, 0.0], [900.0, 50.0, 900.0], "far: ");
        check([3000.0, 0.0, 0.0], [0.3, 0.3, 0.3], "too far");
        check([0.0; 3], [5e5, 1e3, 5e5], "near");
        check([1e5; 3], [0.0; 3], "near");
    }
}
