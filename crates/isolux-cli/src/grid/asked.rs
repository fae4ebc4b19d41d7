//! What is read at the points of a grid.

use crate::failure::Failure;
use crate::flags::{GridFlags, QuantityName};
use crate::quantity::significant;
use isolux::engine::{MapReader, ProbePoint, Sensor};
use isolux::geometry::{Direction, Normal, Vector};
use isolux::map::Illuminance;
use isolux::scene::{Scene, UpAxis};

/// What is read, as resolved.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    pub(super) name: QuantityName,
    sensor: Option<Sensor>,
    /// The way up, which a plane faces that horizontal illuminance is of.
    up: Direction,
    pub(super) facing_deg: Option<f64>,
}

impl Asked {
    /// Illuminance, as most ask for.
    pub(crate) fn illuminance(scene: &Scene) -> Self {
        let up = scene.up().direction();
        Self { name: QuantityName::Illuminance, sensor: None, up, facing_deg: None }
    }

    /// What flags ask for.
    pub(super) fn of(flags: &GridFlags, scene: &Scene) -> Result<Self, Failure> {
        let (name, facing_deg) = (flags.quantity, flags.facing);
        let up = scene.up().direction();
        let is_facing = name == QuantityName::SemiCylindrical;
        if !is_facing && facing_deg.is_some() {
            return Err(Failure::bad_input(
                "--facing: only --quantity semi-cylindrical has a way that it faces; leave it out",
            ));
        }
        if name != QuantityName::Illuminance {
            refuse_tasks(flags)?;
        }
        let sensor = match (name, facing_deg) {
            (QuantityName::Illuminance | QuantityName::Luminance, _) => None,
            (QuantityName::Cylindrical | QuantityName::Modelling, _) => Some(Sensor::cylinder(up)),
            (QuantityName::Hemispherical, _) => Some(Sensor::hemisphere(up)),
            (QuantityName::SemiCylindrical, Some(deg)) => {
                Sensor::half_cylinder(up, level_way(scene.up(), deg))
            }
            (QuantityName::SemiCylindrical, None) => {
                return Err(Failure::bad_input(format!(
                    "--quantity semi-cylindrical: needs the way that it faces; add --facing DEG, {}",
                    axes(scene.up())
                )));
            }
        };
        Ok(Self { name, sensor, up, facing_deg })
    }

    /// Reads a point.
    pub(super) fn read(&self, reader: &MapReader<'_>, at: ProbePoint) -> Option<Illuminance> {
        match &self.sensor {
            None => reader.measure(at),
            Some(sensor) => reader.on_sensor(at.position, sensor),
        }
    }

    /// The horizontal illuminance at a point.
    pub(super) fn horizontal(&self, reader: &MapReader<'_>, at: ProbePoint) -> Option<Illuminance> {
        reader.measure(ProbePoint { normal: self.up.to_normal(), ..at })
    }

    /// Whether a plane with this normal is level and faces up.
    pub(super) fn is_up(&self, normal: Normal) -> bool {
        self.up.cos(normal) > 1.0 - 1e-9
    }

    pub(super) fn is_modelling(&self) -> bool {
        self.name == QuantityName::Modelling
    }

    /// Whether it is that of planes that face the way of the grid.
    pub(super) fn is_planar(&self) -> bool {
        self.name == QuantityName::Illuminance
    }

    /// Its name among others, as in flags.
    pub(super) const fn word(&self) -> &'static str {
        match self.name {
            QuantityName::Illuminance => "illuminance",
            QuantityName::Cylindrical => "cylindrical",
            QuantityName::SemiCylindrical => "semi-cylindrical",
            QuantityName::Hemispherical => "hemispherical",
            QuantityName::Modelling => "modelling",
            QuantityName::Luminance => "luminance",
        }
    }

    /// What the values in lux are, for people.
    pub(super) fn title(&self) -> String {
        match (self.name, self.facing_deg) {
            (QuantityName::Illuminance, _) => "Illuminance".to_owned(),
            (QuantityName::Luminance, _) => "Luminance".to_owned(),
            (QuantityName::Cylindrical | QuantityName::Modelling, _) => {
                "Cylindrical illuminance".to_owned()
            }
            (QuantityName::Hemispherical, _) => "Hemispherical illuminance".to_owned(),
            (QuantityName::SemiCylindrical, deg) => {
                let deg = significant(deg.unwrap_or_default(), 3);
                format!("Semi-cylindrical illuminance facing {deg} degrees")
            }
        }
    }
}

/// Tasks of EN 12464-1 are of the illuminance of the task area.
fn refuse_tasks(flags: &GridFlags) -> Result<(), Failure> {
    let of_task = flags.required.require.iter().find(|text| text.contains("EN 12464-1"));
    of_task.map_or(Ok(()), |text| {
        Err(Failure::bad_input(format!(
            "--require: `{text}` is of the illuminance of the task area; leave --quantity out, or give conditions, as \
             \"Em >= 50, U0 >= 0.1\""
        )))
    })
}

/// A level way by its angle in plan, from x by the left turn as seen from above.
fn level_way(up: UpAxis, deg: f64) -> Vector {
    let (sin, cos) = libm::sincos(deg.to_radians());
    match up {
        UpAxis::Z => Vector::new(cos, sin, 0.0),
        UpAxis::Y => Vector::new(cos, 0.0, -sin),
    }
}

fn axes(up: UpAxis) -> &'static str {
    match up {
        UpAxis::Z => "0 for +x and 90 for +y",
        UpAxis::Y => "0 for +x and 90 for -z",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_turn_left_as_seen_from_above() {
        for up in [UpAxis::Y, UpAxis::Z] {
            let [x, left] = [0.0, 90.0].map(|deg| level_way(up, deg));
            assert!((x.cross(left) - up.direction().to_vector()).length() < 1e-15, "{up:?}");
        }
    }
}
