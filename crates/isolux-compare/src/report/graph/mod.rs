//! Graphs: what they show, and how they are drawn.

mod draw;
mod ink;
mod legend;
mod look;
mod plan;
mod sheet;
mod strokes;
mod svg;
mod ticks;

pub(super) use plan::{Axis, Dot, Graph, Line, Rule, Scale};
pub(super) use svg::{css, element, file};
