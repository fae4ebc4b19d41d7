//! TOML text into records, entry by entry, so that one wrong key does not hide the next.

use super::context::Context;
use super::record::{LibraryRecord, SceneFile};
use super::sky_record::SkyRecord;
use super::spans::{At, Span};
use serde::de::DeserializeOwned;
use std::collections::HashSet;
use toml::de::{DeString, DeTable, DeValue, Error, ValueDeserializer};

const KEYS: &str = "use one of `name`, `up`, `units`, `libraries`, `materials`, `geometry`, `group`, \
                    `luminaire`, `sky`, `camera`, `grid`";
const LIBRARY_KEYS: &str = "use `[luminaires.NAME]`";
/// Problems reported of one entry.
const MOST_RETRIES: usize = 16;

/// Reads a scene; what is wrong goes to the findings with line and column.
pub(super) fn parse(text: &str, context: &mut Context) -> SceneFile {
    let mut file = SceneFile::default();
    for (key, value) in root(text, context) {
        let span = value.span();
        match key.get_ref().as_ref() {
            "name" => file.name = entry(value, context),
            "up" => file.up = entry(value, context),
            "units" => file.units = entry(value, context),
            "libraries" => file.libraries = entry(value, context).unwrap_or_default(),
            "materials" => {
                let materials = table("materials", value, context);
                let plain = |(name, record): (_, Option<At<_>>)| (name, record.map(At::into_inner));
                file.materials = materials.into_iter().map(plain).collect();
            }
            "geometry" => file.geometry = list("geometry", value, context),
            "group" => {
                let groups = list("group", value, context);
                file.groups = groups.into_iter().map(At::into_inner).collect();
            }
            "luminaire" => file.luminaires = list("luminaire", value, context),
            "sky" => file.sky = sky(value, context),
            "camera" => file.cameras = list("camera", value, context),
            "grid" => file.grids = list("grid", value, context),
            "requirement" => file.requirements = list("requirement", value, context),
            other => unknown(other, key.span(), span, KEYS, context),
        }
    }
    file
}

const SKY: &str = "write `[sky]` and its keys below, once";

fn sky(value: At<DeValue>, context: &mut Context) -> Option<At<SkyRecord>> {
    let span = value.span();
    is_table(&value, || SKY.to_owned(), context)
        .then(|| entry(value, context))
        .flatten()
        .map(|record| At::new(span, record))
}

/// Reads the keys of a sky at the top of a text, or in its table `[sky]`.
pub(super) fn parse_sky(text: &str, context: &mut Context) -> Option<SkyRecord> {
    let entries = root(text, context);
    if context.has_problems() {
        return None;
    }
    let is_sky = |(key, value): &(At<DeString>, At<DeValue>)| {
        key.get_ref() == "sky" && matches!(value.get_ref(), DeValue::Table(_))
    };
    if let Some(at) = entries.iter().position(is_sky) {
        return entries.into_iter().nth(at).and_then(|(_, table)| entry(table, context));
    }
    let table: DeTable = entries.into_iter().collect();
    entry(At::new(0..text.len(), DeValue::Table(table)), context)
}

/// Luminaires by name; an entry that could not be read keeps its name.
pub(super) type LibraryEntries = Vec<(At<String>, Option<At<LibraryRecord>>)>;

/// Reads a luminaire library; what is wrong goes to the findings with line and column.
pub(super) fn parse_library(text: &str, context: &mut Context) -> LibraryEntries {
    let mut entries = Vec::new();
    for (key, value) in root(text, context) {
        match key.get_ref().as_ref() {
            "luminaires" => entries = table("luminaires", value, context),
            other => unknown(other, key.span(), value.span(), LIBRARY_KEYS, context),
        }
    }
    entries
}

/// Keys and values of a file, in its order.
type Entries<'a> = Vec<(At<DeString<'a>>, At<DeValue<'a>>)>;

/// What stands at the top of a file; nothing if it is no TOML.
fn root<'a>(text: &'a str, context: &mut Context) -> Entries<'a> {
    let (root, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        // Brackets left open are reported once each, all at the end of the file.
        let mut told = HashSet::new();
        let news = errors.iter().filter(|e| told.insert((e.span().map(|s| s.start), e.message())));
        news.take(MOST_RETRIES).for_each(|error| report(error, &(0..0), context));
        return Vec::new();
    }
    let mut entries: Vec<_> = root.into_inner().into_iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    entries
}

fn unknown(name: &str, key: Span, value: Span, keys: &str, context: &mut Context) {
    let at = if key.is_empty() { value } else { key };
    context.problem(&at, format!("unknown key `{name}`"), keys);
}

/// The entries of an array of tables that could be read.
fn list<T: DeserializeOwned>(key: &str, value: At<DeValue>, context: &mut Context) -> Vec<At<T>> {
    let span = value.span();
    let DeValue::Array(items) = value.into_inner() else {
        context.problem(
            &span,
            format!("`{key}` is not an array of tables"),
            format!("write `[[{key}]]` in double brackets, once for each"),
        );
        return Vec::new();
    };
    let mut read = Vec::new();
    for item in items {
        let span = item.span();
        if is_table(
            &item,
            || format!("write `[[{key}]]` in double brackets, once for each"),
            context,
        ) {
            read.extend(entry(item, context).map(|record| At::new(span, record)));
        }
    }
    read
}

/// The entries of a table of tables by name, in the order of the file.
fn table<T: DeserializeOwned>(
    key: &str,
    value: At<DeValue>,
    context: &mut Context,
) -> Vec<(At<String>, Option<At<T>>)> {
    let span = value.span();
    let DeValue::Table(items) = value.into_inner() else {
        let what = format!("`{key}` is not a table");
        context.problem(&span, what, format!("write `[{key}.NAME]`"));
        return Vec::new();
    };
    let mut items: Vec<_> = items.into_iter().collect();
    items.sort_by_key(|(key, _)| key.span().start);
    let mut read = Vec::new();
    for (name, item) in items {
        let name = At::new(name.span(), name.into_inner().into_owned());
        let span = item.span();
        let remedy = || format!("write `[{key}.{}]` and its keys below", name.get_ref());
        let record = is_table(&item, remedy, context).then(|| entry(item, context)).flatten();
        read.push((name, record.map(|record| At::new(span, record))));
    }
    read
}

/// Whether an entry is a table; what else it is goes to the findings.
fn is_table(item: &At<DeValue>, remedy: impl Fn() -> String, context: &mut Context) -> bool {
    let is_table = matches!(item.get_ref(), DeValue::Table(_));
    if !is_table {
        context.problem(&item.span(), "is not a table", remedy());
    }
    is_table
}

/// One entry. After a problem the key that caused it is put aside and the rest is tried, so that
/// all problems of the entry are reported; the entry then counts as unreadable.
fn entry<T: DeserializeOwned>(value: At<DeValue>, context: &mut Context) -> Option<T> {
    let mut value = value;
    let mut removed: Vec<String> = Vec::new();
    for _ in 0..MOST_RETRIES {
        let error = match T::deserialize(ValueDeserializer::from(value.clone())) {
            Ok(record) => return removed.is_empty().then_some(record),
            Err(error) => error,
        };
        let is_consequence = removed.iter().any(|key| *error.message() == missing(key));
        if !is_consequence {
            report(&error, &value.span(), context);
        }
        match error.span().and_then(|span| remove_cause(&mut value, &span)) {
            Some(key) => removed.push(key),
            None => return None,
        }
    }
    None
}

fn missing(key: &str) -> String {
    format!("missing field `{key}`")
}

/// Takes the key that a span lies in, or its value, out of a table.
fn remove_cause(value: &mut At<DeValue>, span: &Span) -> Option<String> {
    let DeValue::Table(items) = value.get_mut() else { return None };
    let holds = |outer: Span| outer.start <= span.start && span.end <= outer.end;
    let key = items
        .iter()
        .find(|(key, item)| holds(key.span()) || holds(item.span()))
        .map(|(key, _)| key.get_ref().clone().into_owned())?;
    items.remove(key.as_str());
    Some(key)
}

fn report(error: &Error, fallback: &Span, context: &mut Context) {
    let span = error.span().unwrap_or_else(|| fallback.clone());
    let message = error.message().replace("unknown field", "unknown key").replace('\n', "; ");
    let (what, remedy) = match message.split_once(", expected ") {
        Some((what, expected)) => (what.to_owned(), format!("expected {expected}")),
        None => match message.strip_prefix("missing field ") {
            Some(key) => (format!("{key} is missing"), format!("add {key}")),
            None => (message, "correct it; docs/book/scenes.md lists what can be written".into()),
        },
    };
    context.problem(&span, what, remedy);
}
