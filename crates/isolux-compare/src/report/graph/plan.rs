//! A graph before it is drawn.

/// Lines over two axes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Graph {
    /// Name of its file without extension, and of its parts.
    pub(crate) id: String,
    pub(crate) title: String,
    /// What it shows, for those who do not see it and for captions.
    pub(crate) description: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) lines: Vec<Line>,
    pub(crate) rules: Vec<Rule>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Axis {
    pub(crate) title: String,
    pub(crate) scale: Scale,
}

/// How values are laid out along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scale {
    /// Equal distances for equal differences, from zero.
    Linear,
    /// Equal distances for doubling: ticks are powers of two.
    Doubling,
    /// Equal distances for tenfold values.
    Decades,
}

/// The points of one system.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    pub(crate) title: String,
    /// Which of the looks it has: the same in all graphs of a report.
    pub(crate) look: usize,
    pub(crate) points: Vec<Dot>,
}

/// A point of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dot {
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// Where the value lies, from and to, along y.
    pub(crate) interval: Option<[f64; 2]>,
}

/// A line that is no data.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Rule {
    /// A value of y.
    Level(f64, String),
    /// Where y is x.
    Equal(String),
}

impl Scale {
    /// Where a value lies along the axis; `None` of values that have no place.
    pub(super) fn place(self, value: f64) -> Option<f64> {
        let place = match self {
            Self::Linear => value,
            Self::Doubling => libm::log2(value),
            Self::Decades => libm::log10(value),
        };
        place.is_finite().then_some(place)
    }

    /// The value at a place.
    pub(super) fn value(self, place: f64) -> f64 {
        match self {
            Self::Linear => place,
            Self::Doubling => libm::exp2(place),
            Self::Decades => libm::exp10(place),
        }
    }
}

impl Graph {
    /// Where a point lies; `None` if not on the graph.
    pub(super) fn place(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        Some((self.x.scale.place(x)?, self.y.scale.place(y)?))
    }

    /// The lines that have points on the graph, without the other points.
    pub(super) fn drawn(&self) -> Vec<Line> {
        let is_on = |dot: &Dot| self.place(dot.x, dot.y).is_some();
        let kept = |line: &Line| Line {
            points: line.points.iter().copied().filter(is_on).collect(),
            ..line.clone()
        };
        self.lines.iter().map(kept).filter(|line| !line.points.is_empty()).collect()
    }

    /// How many points have no place on it, as zero has none on a logarithmic axis.
    pub(crate) fn left_out(&self) -> usize {
        let all: usize = self.lines.iter().map(|line| line.points.len()).sum();
        all - self.drawn().iter().map(|line| line.points.len()).sum::<usize>()
    }

    /// Whether there is anything to draw.
    pub(crate) fn is_empty(&self) -> bool {
        self.drawn().is_empty()
    }
}
