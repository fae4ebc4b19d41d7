//! What is printed on standard output: results.

use crate::failure::Failure;
use crate::shown::plain;
use comfy_table::{CellAlignment, LineStyle, Table, TableStyle, presets};
use serde::Serialize;
use std::io::Write;

/// Prints text to standard output.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
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
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    let made = serde_json::to_writer_pretty(&mut out, value).map_err(std::io::Error::from);
    made.and_then(|()| writeln!(out)).and_then(|()| out.flush()).map_err(unprintable)
}

/// One line, under the header.
const RULED: TableStyle =
    TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

/// Lines of two columns: what, and how much.
pub(crate) fn facts(rows: &[(&str, String)]) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    for (name, value) in rows {
        table.add_row([(*name).to_owned(), plain(value).into_owned()]);
    }
    finished(&table)
}

/// A table with a header; columns of numbers are flush right.
pub(crate) fn table(header: &[&str], rows: &[Vec<String>]) -> String {
    let mut table = Table::new();
    table.load_style(RULED);
    table.set_header(header.iter().copied());
    table.add_rows(rows.iter().map(|row| row.iter().map(|cell| plain(cell).into_owned())));
    for (index, column) in table.column_iter_mut().enumerate() {
        let is_number =
            |row: &Vec<String>| row.get(index).is_none_or(|cell| starts_as_number(cell));
        if rows.iter().all(is_number) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    finished(&table)
}

fn starts_as_number(cell: &str) -> bool {
    cell.trim_start_matches(['-', '+']).starts_with(|c: char| c.is_ascii_digit())
        || matches!(cell, "" | "-")
}

fn finished(table: &Table) -> String {
    let lines: Vec<String> = table.lines().map(|l| l.trim_end().to_owned()).collect();
    lines.join("\n") + "\n"
}
