//! A plan of a calculation grid, as it is handed over with a report: the room cut at the height of the grid, luminaires, the
//! values at its points, lines of equal value, a legend, metres along both sides.

mod axes;
mod field;
mod frame;
mod isolines;
mod lamps;
mod legend;
mod levels;
mod room;
mod section;
mod symbols;
mod words;

pub use words::PlanWords;

use crate::drawing::{Anchor, At, Drawing, Ink, Lettering, Letters, Mark, PAPER, extent};
use crate::error::ViewError;
use field::Field;
use frame::{Frame, Plane, Window};
use isolines::Isolines;
use isolux::scene::{CalculationGrid, Scene};
use lamps::Lamp;
use legend::Shown;
use levels::Levels;
use room::Room;
use section::Section;

/// The most of the height of what is drawn of a plane, as a share of its longest side.
const HIGHEST: f64 = 0.75;
/// Of a corridor the shorter side is drawn at least so long, while the longer one stays below that.
const NARROWEST: f64 = 260.0;
const LONGEST_NARROW: f64 = 2400.0;
/// Walls are drawn that lie at most so far beyond the grid, m, or this share of its shorter side.
const REACH_M: f64 = 0.75;
const REACH: f64 = 0.15;
/// What is shorter than so many distances of points does not keep values apart.
const BARRIER: f64 = 0.8;
/// Space around the plan: on all sides of it, for numbers on the left, and below.
const MARGIN: f64 = 26.0;
const GUTTER: f64 = 62.0;
const BELOW: f64 = 60.0;
/// Heights of lines of the heading, pixels.
const TITLE: f64 = 34.0;
const ROW: f64 = 22.0;
/// Free space within the frame, pixels.
const INNER: f64 = 14.0;
const INK: Ink = [20; 3];
/// Luminaires take at most this share of their distance.
const CROWDED: f64 = 0.15;
/// With more luminaires than that none is named.
const MOST_NAMED: usize = 60;
/// Where the value of a point is written, below or above it, pixels.
const VALUE_AT: [f64; 2] = [18.0, -18.0];
/// Free space between values, pixels: lines and their labels are read there.
const AIR: f64 = 40.0;
/// Points closer than this have a cross only where their value is written, pixels.
const CROSSES: f64 = 14.0;
/// Letters of a name at most.
const LONGEST_NAME: usize = 24;

/// What a plan shows.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a> {
    /// What is cut.
    pub scene: &'a Scene,
    /// Where.
    pub grid: &'a CalculationGrid,
    /// At the points of the grid, along `u` first.
    pub points: &'a [PlanPoint],
    /// The title.
    pub title: &'a str,
    /// Lines below it.
    pub lines: &'a [String],
    /// Length of the longer side of what is drawn, pixels: the shorter it is, the larger are letters beside it.
    pub longest: f64,
    /// The language of the rest.
    pub words: &'a PlanWords,
}

/// What a plan shows at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanPoint {
    /// The value, lx, or a ratio of such; `None` where it is not known, and outside of the room.
    pub illuminance_lx: Option<f64>,
    /// Its standard error, lx.
    pub standard_error_lx: f64,
    /// The value as it is written.
    pub label: String,
}

impl Plan<'_> {
    /// The longer side of a sheet of its own, pixels.
    pub const SHEET: f64 = 1200.0;
    /// The same of a plan on a page with text.
    pub const PAGE: f64 = 720.0;

    /// Draws it.
    pub fn drawing(&self) -> Result<Drawing, ViewError> {
        let plane = Plane::of(self.grid).ok_or(ViewError::NothingKnown)?;
        let values: Vec<Option<f64>> =
            self.points.iter().map(|point| point.illuminance_lx).collect();
        let section = Section::of(self.scene, &plane);
        let barriers = section.barriers(BARRIER * plane.cells_m().into_iter().fold(0.0, f64::max));
        let levels = self.levels();
        let field = Field::new(&plane, (&values, levels.scale()), &barriers);
        let window = window(&plane, &section, self.longest);
        let frame = self.frame(window);
        let mut sheet = self.sheet(&frame, &levels)?;
        self.draw_heading(&mut sheet);
        let lamps = lamps::lamps(self.scene, &plane, &window);
        let lines = field.map(|field| {
            sheet.add(isolines::bands(&field, &frame, &levels));
            Isolines::of(&field, &frame, &levels)
        });
        lines.iter().for_each(|lines| lines.draw(&mut sheet));
        let (cut, behind) = draw_section(&mut sheet, &section, &frame);
        draw_border(&mut sheet, &plane, &frame);
        let [width, height] = frame.size();
        let mut room = Room::new(frame.corner, [frame.corner[0] + width, frame.corner[1] + height]);
        take_walls(&mut room, &section, &frame);
        draw_lamps(&mut sheet, &mut room, &lamps, &frame);
        self.draw_points((&mut sheet, &mut room), (&plane, &frame), &levels);
        lines.iter().for_each(|lines| lines.label(&mut sheet, &mut room, (&levels, self.words)));
        name_lamps(&mut sheet, &mut room, &lamps, &frame);
        axes::draw(&mut sheet, &plane, &frame, self.words);
        let has = |is_opening: bool| lamps.iter().any(|lamp| lamp.opening.is_some() == is_opening);
        let shown = Shown {
            cut,
            behind,
            openings: has(true),
            points: has(false),
            is_crowded: radius(&lamps, &frame) < symbols::CROSSED,
            is_level: plane.facing(self.scene.up().direction().to_vector()).abs() > 0.999,
        };
        let beside = [frame.corner[0] + width + MARGIN, frame.corner[1]];
        legend::draw(&mut sheet, (beside, height), &levels, (shown, self.words));
        Ok(sheet)
    }

    fn levels(&self) -> Levels {
        let known: Vec<f64> = self.points.iter().filter_map(|point| point.illuminance_lx).collect();
        let mut errors: Vec<f64> =
            self.points.iter().map(|point| point.standard_error_lx).collect();
        errors.sort_by(f64::total_cmp);
        Levels::of(&known, errors.get(errors.len() / 2).copied().unwrap_or(0.0))
    }

    fn heading_height(&self) -> f64 {
        let title = if self.title.is_empty() { 0.0 } else { TITLE };
        MARGIN + title + self.lines.len() as f64 * ROW + 36.0
    }

    /// As large as fits.
    fn frame(&self, window: Window) -> Frame {
        let scale = scale(window.sides_m(), self.longest);
        Frame { window, scale, corner: [GUTTER, self.heading_height()] }
    }

    fn sheet(&self, frame: &Frame, levels: &Levels) -> Result<Drawing, ViewError> {
        let [width, height] = frame.size();
        let heading = self.lines.iter().map(|line| extent(Letters::Small, line)[0]);
        let heading = heading.fold(extent(Letters::Large, self.title)[0], f64::max);
        let width =
            (GUTTER + width + MARGIN + legend::width(self.words)).max(2.0 * MARGIN + heading);
        let height = (height + BELOW).max(legend::least_height(levels) + MARGIN);
        Drawing::new(width.ceil() as u32, (self.heading_height() + height).ceil() as u32)
    }

    fn draw_heading(&self, sheet: &mut Drawing) {
        let mut y = MARGIN + 0.4 * TITLE;
        let mut write = |letters, step: f64, text: &str| {
            let at = [MARGIN, y];
            let (anchor, text) = (Anchor::Left, text.to_owned());
            sheet.text(Lettering { at, anchor, letters, ink: INK, halo: None, text });
            y += step;
        };
        write(Letters::Large, TITLE, self.title);
        self.lines.iter().for_each(|line| write(Letters::Small, ROW, line));
    }

    /// Crosses at all points, and the values of as many as can be read.
    fn draw_points(
        &self,
        (sheet, room): (&mut Drawing, &mut Room),
        (plane, frame): (&Plane, &Frame),
        levels: &Levels,
    ) {
        let inks = levels.inks();
        let widest = self.points.iter().map(|point| extent(Letters::Small, &point.label)[0]);
        let apart =
            [widest.fold(0.0, f64::max), extent(Letters::Small, "0")[1]].map(|size| size + AIR);
        let across = plane.counts[0] as usize;
        let cells = plane.cells_m().map(|cell_m| cell_m * frame.scale);
        let every = [0, 1].map(|k| (apart[k] / cells[k]).ceil().max(1.0) as usize);
        let first = [0, 1].map(|k| (plane.counts[k] as usize - 1) % every[k] / 2);
        let is_crowded = cells.iter().any(|cell| *cell < CROSSES);
        for (index, point) in self.points.iter().enumerate() {
            let Some(lx) = point.illuminance_lx else { continue };
            let of = [index % across, index / across];
            let at = frame.at(plane.at_index(of.map(|k| k as f64)));
            let is_written = (0..2).all(|k| of[k] % every[k] == first[k]);
            if is_written || !is_crowded {
                symbols::point(sheet, at);
            }
            if is_written {
                room.take(at.map(|c| c - 4.0), at.map(|c| c + 4.0));
                let inks = ([0; 3], Some(inks[levels.band(lx)]));
                let mut places = VALUE_AT.iter().map(|dy| [at[0], at[1] + dy]);
                places.find(|place| room.write(sheet, *place, &point.label, inks));
            }
        }
    }
}

/// Pixels a metre of a window with such sides.
fn scale([width_m, height_m]: [f64; 2], longest: f64) -> f64 {
    let usual = (longest / width_m).min(HIGHEST * longest / height_m);
    let narrow = (NARROWEST / width_m.min(height_m)).min(LONGEST_NARROW / width_m.max(height_m));
    usual.max(narrow)
}

/// What is cut near the grid, and some space around it.
fn window(plane: &Plane, section: &Section, longest: f64) -> Window {
    let reach_m = (REACH * plane.lengths_m[0].min(plane.lengths_m[1])).max(REACH_M);
    let mut window = Window::around(plane, reach_m, &section.pieces);
    let scale = scale(window.sides_m(), longest);
    for k in 0..2 {
        window.low[k] -= INNER / scale;
        window.high[k] += INNER / scale;
    }
    window
}

/// Whether something is cut, and whether something lies closely behind.
fn draw_section(sheet: &mut Drawing, section: &Section, frame: &Frame) -> (bool, bool) {
    for rings in section.solids() {
        let clipped = rings.iter().map(|ring| frame.window.clipped_ring(ring));
        let rings: Vec<Vec<At>> =
            clipped.map(|ring| ring.into_iter().map(|place| frame.at(place)).collect()).collect();
        sheet.add(Mark::Area { rings, ink: symbols::SOLID });
    }
    let mut draw = |pieces: &[section::Piece], symbol: fn(&mut Drawing, [At; 2])| {
        let inside = pieces.iter().filter_map(|piece| frame.window.clipped(*piece));
        inside.map(|piece| symbol(sheet, piece.map(|place| frame.at(place)))).count() > 0
    };
    let behind = draw(&section.behind, symbols::behind);
    (draw(&section.pieces, symbols::cut), behind)
}

/// Nothing is written over walls: along each there are boxes as wide as its line.
fn take_walls(room: &mut Room, section: &Section, frame: &Frame) {
    const HALF: f64 = 2.0;
    for [a, b] in section.pieces.iter().filter_map(|piece| frame.window.clipped(*piece)) {
        let ([ax, ay], [bx, by]) = (frame.at(a), frame.at(b));
        // A wall along a side of the sheet takes one box.
        let boxes = ((bx - ax).abs().min((by - ay).abs()) / (2.0 * HALF)).ceil().max(1.0);
        for k in 0..boxes as usize {
            let [from, to] = [k, k + 1].map(|k| k as f64 / boxes);
            let end = |share: f64| [ax + share * (bx - ax), ay + share * (by - ay)];
            let ([fx, fy], [tx, ty]) = (end(from), end(to));
            room.take(
                [fx.min(tx) - HALF, fy.min(ty) - HALF],
                [fx.max(tx) + HALF, fy.max(ty) + HALF],
            );
        }
    }
}

/// The rectangle that the points fill.
fn draw_border(sheet: &mut Drawing, plane: &Plane, frame: &Frame) {
    let low = [plane.border_m; 2];
    let high = [0, 1].map(|k| plane.lengths_m[k] - plane.border_m);
    let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
    symbols::border(sheet, corners.iter().map(|place| frame.at(*place)).collect());
}

fn draw_lamps(sheet: &mut Drawing, room: &mut Room, lamps: &[Lamp], frame: &Frame) {
    let radius = radius(lamps, frame);
    for lamp in lamps {
        match &lamp.opening {
            Some(ring) => {
                let ring: Vec<At> = frame
                    .window
                    .clipped_ring(ring)
                    .into_iter()
                    .map(|place| frame.at(place))
                    .collect();
                symbols::opening(sheet, &ring);
            }
            None => {
                let at = frame.at(lamp.middle);
                symbols::round(sheet, at, radius);
                if radius == symbols::RADIUS {
                    room.take(at.map(|c| c - radius), at.map(|c| c + radius));
                }
            }
        }
    }
}

/// The radius of luminaires that are points: smaller where they are crowded.
fn radius(lamps: &[Lamp], frame: &Frame) -> f64 {
    let points: Vec<At> = lamps
        .iter()
        .filter(|lamp| lamp.opening.is_none())
        .map(|lamp| frame.at(lamp.middle))
        .collect();
    let nearest = |k: usize| {
        let others = points.iter().enumerate().filter(|(other, _)| *other != k);
        let far = |at: &At| (at[0] - points[k][0]).hypot(at[1] - points[k][1]);
        // Those before each other are drawn as one.
        let apart = others.map(|(_, at)| far(at)).filter(|apart| *apart > 1.0);
        apart.fold(f64::INFINITY, f64::min)
    };
    let mut apart: Vec<f64> = (0..points.len()).map(nearest).collect();
    apart.sort_by(f64::total_cmp);
    let apart = apart.get(apart.len() / 2).copied().unwrap_or(f64::INFINITY);
    (CROWDED * apart).clamp(symbols::LEAST_RADIUS, symbols::RADIUS)
}

/// Above or below each, where there is room.
fn name_lamps(sheet: &mut Drawing, room: &mut Room, lamps: &[Lamp], frame: &Frame) {
    if lamps.len() > MOST_NAMED {
        return;
    }
    for lamp in lamps {
        let middle = frame.at(lamp.middle);
        let reach = lamp.opening.as_ref().map_or(symbols::RADIUS, |ring| {
            ring.iter().map(|place| (frame.at(*place)[1] - middle[1]).abs()).fold(0.0, f64::max)
        });
        // One of an array is named after the array.
        let name = lamp.name.split('[').next().unwrap_or_default();
        let name: String = name.chars().take(LONGEST_NAME).collect();
        let inks = (symbols::LAMP, Some(PAPER));
        let heights = [-reach - 14.0, reach + 14.0, 0.0, 0.5 * reach, -0.5 * reach];
        let aside = 0.5 * extent(Letters::Small, &name)[0];
        let mut places = [0.0, aside, -aside]
            .into_iter()
            .flat_map(|dx| heights.map(|dy| [middle[0] + dx, middle[1] + dy]));
        places.find(|place| room.write(sheet, *place, &name, inks));
    }
}
