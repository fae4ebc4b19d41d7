//! A report before it has a format: a cover and sections of blocks.

use crate::report::Image;
use crate::words::Words;
use isolux::map::Verdict;

/// All of it, from top to bottom.
#[derive(Clone, Debug)]
pub(crate) struct Document {
    pub(crate) words: &'static Words,
    pub(crate) cover: Cover,
    pub(crate) sections: Vec<Section>,
    /// What stands at the foot of every page.
    pub(crate) foot: String,
}

/// The first page.
#[derive(Clone, Debug)]
pub(crate) struct Cover {
    pub(crate) title: String,
    pub(crate) subtitle: String,
    pub(crate) facts: Vec<(String, String)>,
    pub(crate) picture: Option<Picture>,
    pub(crate) remarks: Option<String>,
    /// The figures that most readers look for.
    pub(crate) keys: Vec<Key>,
}

/// A figure of the cover.
#[derive(Clone, Debug)]
pub(crate) struct Key {
    pub(crate) title: String,
    pub(crate) value: String,
    pub(crate) about: String,
    pub(crate) verdict: Option<Verdict>,
}

/// A part with a heading.
#[derive(Clone, Debug)]
pub(crate) struct Section {
    /// What links lead to.
    pub(crate) id: &'static str,
    pub(crate) title: String,
    pub(crate) blocks: Vec<Block>,
}

/// A piece of a section.
#[derive(Clone, Debug)]
pub(crate) enum Block {
    Heading(String),
    Text(String),
    /// Names and what they are.
    Facts(Vec<(String, String)>),
    Table(Table),
    Picture(Picture),
    /// Pictures that may stand side by side.
    Pictures(Vec<Picture>),
    List(Vec<String>),
}

/// Rows beneath a head.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    pub(crate) caption: String,
    pub(crate) columns: Vec<Column>,
    pub(crate) rows: Vec<Vec<Cell>>,
    /// Whether it has many narrow columns.
    pub(crate) is_dense: bool,
}

/// A column of a table.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    pub(crate) title: String,
    /// Whether it holds numbers.
    pub(crate) is_number: bool,
}

/// A cell of a table.
#[derive(Clone, Debug)]
pub(crate) enum Cell {
    Text(String),
    Verdict(Verdict, String),
}

/// A picture and what it shows.
#[derive(Clone, Debug)]
pub(crate) struct Picture {
    pub(crate) image: Image,
    /// What those hear who do not see it.
    pub(crate) alternative: String,
    pub(crate) caption: String,
}

/// A column of words.
pub(crate) fn words(title: &str) -> Column {
    Column { title: title.to_owned(), is_number: false }
}

/// A column of numbers.
pub(crate) fn numbers(title: &str) -> Column {
    Column { title: title.to_owned(), is_number: true }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

/// A row of cells without verdicts.
pub(crate) fn row(cells: impl IntoIterator<Item = String>) -> Vec<Cell> {
    cells.into_iter().map(Cell::Text).collect()
}
