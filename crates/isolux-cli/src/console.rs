//! What is printed on standard output: results.

use crate::caller::{self, Told};
use crate::failure::Failure;
use crate::shown::{cut, json_text, lines, plain};
use comfy_table::{CellAlignment, LineStyle, Table, TableStyle, presets};
use serde::Serialize;
use std::io::Write;

/// Prints lines to standard output, each of them plain: they may hold names from files.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    print_raw(&lines(text))
}

/// Prints text of our own to standard output, as it is.
pub(crate) fn print_raw(text: &str) -> Result<(), Failure> {
    if caller::here().is_some() {
        // It has asked for JSON, or for nothing.
        return Ok(());
    }
    let mut out = std::io::stdout().lock();
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    written.map_err(unprintable)
}

fn unprintable(error: std::io::Error) -> Failure {
    match error.kind() {
        std::io::ErrorKind::BrokenPipe => Failure::ReaderGone,
        _ => Failure::Refused(format!("cannot write to standard output: {error}")),
    }
}

/// Prints one JSON value and a line end to standard output, as it is made: there may be millions
/// of readings.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    if let Some(call) = caller::here() {
        let made = serde_json::to_string(value).map_err(std::io::Error::from);
        return made.map(|json| call.tell(Told::Json(json))).map_err(unprintable);
    }
    let mut out = Plainly(std::io::BufWriter::new(std::io::stdout().lock()));
    let made = serde_json::to_writer_pretty(&mut out, value).map_err(std::io::Error::from);
    made.and_then(|()| writeln!(out)).and_then(|()| out.flush()).map_err(unprintable)
}

/// A sink of JSON, of which nothing acts on a terminal.
struct Plainly<W>(W);

impl<W: Write> Write for Plainly<W> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        // A serializer writes no part of a character alone.
        match std::str::from_utf8(bytes) {
            Ok(text) => self.0.write_all(json_text(text).as_bytes())?,
            Err(_) => self.0.write_all(bytes)?,
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.0.flush()
    }
}

/// One line, under the header.
const RULED: TableStyle =
    TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

/// Columns of the narrowest usual terminal: tables are no wider, so that their text is the same everywhere.
const WIDTH: usize = 80;
/// Between two columns, and beside all of them together.
const GAP: usize = 3;
const MARGIN: usize = 2;
/// A first column, which names what a row is about, is cut to no less; other text is broken to no less.
const LEAST_NAME: usize = 16;
const LEAST_TEXT: usize = 10;

/// Lines of two columns: what, and how much. Values too long for a line go on below.
pub(crate) fn facts(rows: &[(&str, String)]) -> String {
    let names = rows.iter().map(|(name, _)| letters(name)).max().unwrap_or(0);
    let room = WIDTH.saturating_sub(MARGIN + names + GAP - 1).max(LEAST_TEXT);
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    for (name, value) in rows {
        table.add_row([(*name).to_owned(), broken(&plain(value), room)]);
    }
    finished(&table)
}

/// A table with a header; columns of numbers are flush right. One too wide for a terminal is narrowed: text is broken, then names
/// in the first column are cut. What still is too wide becomes several tables of the same rows.
pub(crate) fn table(header: &[&str], rows: &[Vec<String>]) -> String {
    let rows: Vec<Vec<String>> =
        rows.iter().map(|row| row.iter().map(|cell| plain(cell).into_owned()).collect()).collect();
    let columns: Vec<Column> = (0..header.len()).map(|k| Column::of(header[k], k, &rows)).collect();
    let mut parts = parts(&columns);
    parts.iter_mut().for_each(|part| narrow(part, &columns));
    let drawn: Vec<String> =
        parts.iter().map(|part| part_table(header, &rows, part, &columns)).collect();
    drawn.join("\n")
}

/// What is known of a column before it is drawn.
struct Column {
    is_number: bool,
    /// Letters of its longest cell, and those that it may be narrowed to.
    width: usize,
    least: usize,
}

impl Column {
    fn of(header: &str, index: usize, rows: &[Vec<String>]) -> Self {
        let cells = || rows.iter().filter_map(|row| row.get(index)).map(String::as_str);
        let width = cells().chain([header]).map(letters).max().unwrap_or(0);
        let is_number = cells().all(starts_as_number);
        let words = || cells().flat_map(str::split_whitespace).map(letters);
        let least = match (is_number, index) {
            (false, 0) => LEAST_NAME,
            (true, _) => width,
            _ => words().max().unwrap_or(0).max(LEAST_TEXT),
        };
        Self { is_number, width, least: least.max(letters(header)).min(width) }
    }
}

/// Columns that are drawn together, with their widths.
type Part = Vec<(usize, usize)>;

fn total(part: &[(usize, usize)]) -> usize {
    MARGIN + part.iter().map(|(_, width)| width + GAP).sum::<usize>().saturating_sub(GAP)
}

/// As few parts as there can be; each begins with the first column.
fn parts(columns: &[Column]) -> Vec<Part> {
    let mut parts: Vec<Part> = vec![Vec::new()];
    let least = |index: usize| (index, columns[index].least);
    for (index, column) in columns.iter().enumerate() {
        let Some(part) = parts.last_mut() else { break };
        let is_full = part.len() > 1 && total(part) + GAP + column.least > WIDTH;
        if is_full {
            parts.push(vec![least(0), least(index)]);
        } else {
            part.push(least(index));
        }
    }
    parts
}

/// Gives columns what they need, as far as there is room.
fn narrow(part: &mut Part, columns: &[Column]) {
    let mut room = WIDTH.saturating_sub(total(part));
    // Names first, then what lacks least.
    let mut order: Vec<usize> = (0..part.len()).collect();
    order.sort_by_key(|&k| (k > 0, columns[part[k].0].width - part[k].1));
    for k in order {
        let (index, width) = part[k];
        let more = (columns[index].width - width).min(room);
        part[k].1 += more;
        room -= more;
    }
}

fn part_table(
    header: &[&str],
    rows: &[Vec<String>],
    part: &[(usize, usize)],
    columns: &[Column],
) -> String {
    let mut table = Table::new();
    table.load_style(RULED);
    table.set_header(part.iter().map(|(index, _)| header[*index]));
    for row in rows {
        let cell = |&(index, width): &(usize, usize)| {
            let cell = row.get(index).map_or("", String::as_str);
            if index == 0 { cut(cell, width) } else { broken(cell, width) }
        };
        table.add_row(part.iter().map(cell));
    }
    for (column, (index, _)) in table.column_iter_mut().zip(part) {
        if columns[*index].is_number {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    finished(&table)
}

/// A sentence as lines of a terminal.
pub(crate) fn wrapped(text: &str) -> String {
    broken(&plain(text), WIDTH) + "\n"
}

fn letters(text: &str) -> usize {
    text.chars().count()
}

/// Lines of so many letters, between words; a longer word has a line of its own.
fn broken(text: &str, width: usize) -> String {
    if letters(text) <= width {
        return text.to_owned();
    }
    let mut lines: Vec<String> = vec![String::new()];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if letters(line) + 1 + letters(word) <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.join("\n")
}

fn starts_as_number(cell: &str) -> bool {
    cell.trim_start_matches(['-', '+']).starts_with(|c: char| c.is_ascii_digit())
        || matches!(cell, "" | "-")
}

fn finished(table: &Table) -> String {
    let lines: Vec<String> = table.lines().map(|l| l.trim_end().to_owned()).collect();
    lines.join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn widest(text: &str) -> usize {
        text.lines().map(letters).max().unwrap_or(0)
    }

    fn cells(row: &[&str]) -> Vec<String> {
        row.iter().map(|cell| (*cell).to_owned()).collect()
    }

    #[test]
    fn narrow_tables_are_left_alone() {
        let text = table(&["surface", "lx"], &[cells(&["floor", "512"]), cells(&["wall", "90"])]);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            [lines[0], lines[2], lines[3]],
            [" surface    lx", " floor     512", " wall       90"]
        );
    }

    #[test]
    fn names_are_cut_and_text_is_broken_to_fit() {
        let name = "a cupboard of a name that goes on and on, as those of exporters do";
        let rows = [cells(&[name, "12.5", "not beyond 1.5 without doubt", "passed"])];
        let text = table(&["surface", "value", "asked", "result"], &rows);
        assert!(widest(&text) <= WIDTH, "{text}");
        assert!(text.contains('…') && text.contains("a cupboard of a"), "{text}");
        assert_eq!(text.lines().filter(|line| line.contains("value")).count(), 1, "{text}");
    }

    #[test]
    fn columns_that_do_not_fit_make_another_table_of_the_same_rows() {
        let many = ["499 (491 to 507)"; 6];
        let header = ["grid", "a", "b", "c", "d", "e", "f"];
        let rows = [cells(&["desk"]).into_iter().chain(cells(&many)).collect::<Vec<String>>()];
        let text = table(&header, &rows);
        assert!(widest(&text) <= WIDTH, "{text}");
        assert_eq!(text.matches("desk").count(), 2, "{text}");
        assert_eq!(text.matches("(491 to 507)").count(), 6, "{text}");
    }

    #[test]
    fn long_facts_go_on_below() {
        let value =
            "16 % (0 % to 25 %), by 44 places; 32 % would have been found, and more of the like";
        let text = facts(&[("error audited", value.to_owned()), ("rays", "475 k".to_owned())]);
        assert!(widest(&text) <= WIDTH, "{text}");
        assert_eq!(text.lines().count(), 3, "{text}");
        let whole: Vec<&str> = text.split_whitespace().collect();
        assert!(whole.join(" ").contains(value), "{text}");
    }

    #[test]
    fn json_is_the_same_and_acts_on_no_terminal() {
        let name = "a\u{1b}\u{202e}\u{9b}\u{7f} \u{fc}\n";
        let mut out = Plainly(Vec::new());
        serde_json::to_writer_pretty(&mut out, &[name]).unwrap();
        let text = String::from_utf8(out.0).unwrap();
        assert_eq!(text, "[\n  \"a\\u001b\\u202e\\u009b\\u007f \u{fc}\\n\"\n]");
        assert_eq!(serde_json::from_str::<Vec<String>>(&text).unwrap(), [name]);
    }

    #[test]
    fn a_table_of_nothing_is_a_header() {
        assert_eq!(table(&["surface", "lx"], &[]).lines().count(), 2);
    }
}
