//! A report before it has a format: blocks that HTML and Markdown both write.

use super::graph::Graph;

/// All of it, from top to bottom.
#[derive(Clone, Debug)]
pub(super) struct Document {
    pub(super) title: String,
    /// What it is about, in a paragraph.
    pub(super) lead: String,
    pub(super) sections: Vec<Section>,
}

/// A part with a heading.
#[derive(Clone, Debug)]
pub(super) struct Section {
    /// What links lead to, and names of files begin with.
    pub(super) id: String,
    pub(super) title: String,
    pub(super) blocks: Vec<Block>,
}

/// A piece of a section.
#[derive(Clone, Debug)]
pub(super) enum Block {
    Heading(String),
    Text(String),
    Table(Table),
    /// Graphs that may stand side by side.
    Graphs(Vec<Graph>),
    Picture(Picture),
    Pictures(Pictures),
    /// Details that are shown when asked for.
    Folded(String, Vec<Block>),
    Sources(Vec<Source>),
}

/// Rows in groups beneath one head.
#[derive(Clone, Debug, Default)]
pub(super) struct Table {
    pub(super) caption: String,
    pub(super) columns: Vec<Column>,
    pub(super) groups: Vec<Group>,
}

/// A column of a table.
#[derive(Clone, Debug)]
pub(super) struct Column {
    pub(super) title: String,
    /// Whether it holds numbers.
    pub(super) is_number: bool,
}

/// Rows that belong together.
#[derive(Clone, Debug, Default)]
pub(super) struct Group {
    /// What they have in common, where a table has several groups.
    pub(super) title: Option<String>,
    pub(super) rows: Vec<Vec<String>>,
}

/// Pictures in rows and columns.
#[derive(Clone, Debug)]
pub(super) struct Pictures {
    pub(super) caption: String,
    /// What the names of its rows are.
    pub(super) first: &'static str,
    pub(super) columns: Vec<String>,
    pub(super) rows: Vec<(String, Vec<Option<Picture>>)>,
}

/// A picture and what is said of it.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    /// Name of its file.
    pub(super) file: String,
    /// What it shows.
    pub(super) shows: String,
    /// Figures, a line each.
    pub(super) figures: Vec<String>,
}

/// What is cited.
#[derive(Clone, Debug)]
pub(super) struct Source {
    pub(super) text: &'static str,
    pub(super) address: Option<&'static str>,
}

/// The name of the file of a graph.
pub(super) fn graph_file(id: &str) -> String {
    format!("graphs/{id}.svg")
}

/// A column of words.
pub(super) fn words(title: impl Into<String>) -> Column {
    Column { title: title.into(), is_number: false }
}

/// A column of numbers.
pub(super) fn numbers(title: impl Into<String>) -> Column {
    Column { title: title.into(), is_number: true }
}

impl Table {
    /// A table of one group.
    pub(super) fn plain(
        caption: impl Into<String>,
        columns: Vec<Column>,
        rows: Vec<Vec<String>>,
    ) -> Self {
        Self { caption: caption.into(), columns, groups: vec![Group { title: None, rows }] }
    }

    /// Leaves out the last column.
    pub(super) fn drop_last(&mut self) {
        self.columns.pop();
        for row in self.groups.iter_mut().flat_map(|group| &mut group.rows) {
            row.pop();
        }
    }

    /// The same without columns of which no row knows anything, and the names of those.
    pub(super) fn without_unknown(mut self, unknown: &str) -> (Self, Vec<String>) {
        let rows = || self.groups.iter().flat_map(|group| &group.rows);
        let is_known: Vec<bool> = (0..self.columns.len())
            .map(|k| rows().any(|row| row.get(k).is_some_and(|cell| cell != unknown)))
            .collect();
        let (kept, dropped): (Vec<_>, Vec<_>) =
            self.columns.drain(..).zip(&is_known).partition(|(_, known)| **known);
        self.columns = kept.into_iter().map(|(column, _)| column).collect();
        for row in self.groups.iter_mut().flat_map(|group| &mut group.rows) {
            let mut keep = is_known.iter();
            row.retain(|_| *keep.next().unwrap_or(&true));
        }
        (self, dropped.into_iter().map(|(column, _)| column.title).collect())
    }
}
