//! Where luminaires are aimed.

use super::context::Context;
use super::quantity::{Triple, plain};
use super::record::LuminaireRecord;
use super::spans::{At, Span};
use isolux::geometry::{Direction, Point, Vector};

pub(super) fn direction_of(triple: &At<Triple>, context: &mut Context) -> Option<Direction> {
    let direction = Vector::from(plain(*triple.get_ref())).direction();
    if direction.is_none() {
        context.problem(&triple.span(), "a direction of length zero", "give where it points");
    }
    direction
}

/// A point of the file, in metres.
pub(super) fn point_m(triple: Triple, context: &Context) -> Point {
    Point::from(plain(triple).map(|c| c * context.unit_m))
}

/// What a luminaire aims at.
pub(super) enum Aim {
    Along(Direction),
    At(Point, Span),
}

impl Aim {
    pub(super) fn new(record: &LuminaireRecord, context: &mut Context) -> Option<Self> {
        match (&record.target, &record.direction) {
            (None, None) => Some(Self::Along(-context.up.direction())),
            (None, Some(direction)) => direction_of(direction, context).map(Self::Along),
            (Some(target), None) => {
                Some(Self::At(point_m(*target.get_ref(), context), target.span()))
            }
            (Some(target), Some(_)) => {
                context.problem(&target.span(), "`target` and `direction`", "give one of them");
                None
            }
        }
    }

    pub(super) fn from(&self, position: Point, context: &mut Context) -> Option<Direction> {
        match self {
            Self::Along(direction) => Some(*direction),
            Self::At(target, span) => {
                let aim = (*target - position).direction();
                if aim.is_none() {
                    context.problem(span, "the target is where the luminaire is", "move one");
                }
                aim
            }
        }
    }
}
