//! What a PLY file says of itself before its data.

/// Longest header that is read, bytes.
const MOST_BYTES: usize = 1 << 20;
/// More elements or properties than this nobody writes.
const MOST_NAMES: usize = 256;

/// How the data is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Text,
    LittleEndian,
    BigEndian,
}

/// What a number is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// A property of every row of an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) scalar: Scalar,
    /// What the length of a list is written as, of a list.
    pub(super) length: Option<Scalar>,
}

/// A table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
    pub(super) line: usize,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) format: Format,
    pub(super) elements: Vec<Element>,
    /// Number of its lines.
    pub(super) lines: usize,
    /// The first line that says nothing known: Blender 2.47 wrote a comment without the word.
    pub(super) odd_line: Option<(usize, String)>,
}

/// What keeps a file from being read.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Wrong {
    pub(super) place: String,
    pub(super) what: String,
}

impl Wrong {
    pub(super) fn at_line(line: usize, what: impl Into<String>) -> Self {
        Self { place: format!("line {line}"), what: what.into() }
    }
}

impl Scalar {
    fn of(word: &str) -> Option<Self> {
        Some(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes it takes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

impl Element {
    /// The place of a property among those of the element.
    pub(super) fn find(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|p| names.contains(&p.name.as_str()))
    }
}

/// The header and where the data begins.
pub(super) fn parse(bytes: &[u8]) -> Result<(Header, usize), Wrong> {
    let mut header =
        Header { format: Format::Text, elements: Vec::new(), lines: 0, odd_line: None };
    let (mut at, mut format) = (0, None);
    loop {
        let rest = &bytes[at..bytes.len().min(MOST_BYTES)];
        let number = header.lines + 1;
        if number == 1 && !rest.trim_ascii_start().starts_with(b"ply") {
            return Err(Wrong::at_line(1, "does not begin with `ply`"));
        }
        let Some(end) = rest.iter().position(|&b| b == b'\n') else {
            return Err(Wrong::at_line(number, "the header does not end with `end_header`"));
        };
        at += end + 1;
        header.lines = number;
        let line = String::from_utf8_lossy(&rest[..end]);
        let wrong = |what: String| Wrong::at_line(number, what);
        let mut words = line.split_whitespace();
        match words.next().unwrap_or_default() {
            "ply" if number == 1 => {}
            "" | "comment" | "obj_info" => {}
            "format" => format = Some(self::format(words).map_err(wrong)?),
            "element" => header.elements.push(element(words, number).map_err(wrong)?),
            "property" => {
                let element = header.elements.last_mut();
                let element =
                    element.ok_or_else(|| wrong("a property before its element".into()))?;
                element.properties.push(property(words).map_err(wrong)?);
            }
            "end_header" => break,
            other => {
                let shown = other.chars().take(40).collect();
                header.odd_line.get_or_insert((number, shown));
            }
        }
        let names = header.elements.len()
            + header.elements.iter().map(|e| e.properties.len()).sum::<usize>();
        if names > MOST_NAMES {
            return Err(wrong(format!("more than {MOST_NAMES} elements and properties")));
        }
    }
    header.format = format.ok_or_else(|| Wrong::at_line(1, "there is no `format`"))?;
    Ok((header, at))
}

fn format<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<Format, String> {
    let format = match words.next().unwrap_or_default() {
        "ascii" => Format::Text,
        "binary_little_endian" => Format::LittleEndian,
        "binary_big_endian" => Format::BigEndian,
        other => return Err(format!("there is no format `{other}`")),
    };
    match words.next() {
        Some("1.0") => Ok(format),
        other => Err(format!("version {}; 1.0 is read", other.unwrap_or("missing"))),
    }
}

fn element<'a>(mut words: impl Iterator<Item = &'a str>, line: usize) -> Result<Element, String> {
    let (name, count) = (words.next(), words.next());
    let (Some(name), Some(count)) = (name, count) else {
        return Err("an element without name and count".into());
    };
    let count = count.parse().map_err(|_| format!("`{count}` is not a count"))?;
    Ok(Element { name: name.to_owned(), count, properties: Vec::new(), line })
}

fn property<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<Property, String> {
    let scalar = |word: Option<&str>| {
        let word = word.unwrap_or_default();
        Scalar::of(word).ok_or_else(|| format!("there is no type `{word}`"))
    };
    let mut words = words.by_ref().peekable();
    let mut length = None;
    if words.next_if_eq(&"list").is_some() {
        let of = scalar(words.next())?;
        if matches!(of, Scalar::F32 | Scalar::F64) {
            return Err("the length of a list is no whole number".into());
        }
        length = Some(of);
    }
    let scalar = scalar(words.next())?;
    let name = words.next().ok_or("a property without a name")?;
    Ok(Property { name: name.to_owned(), scalar, length })
}
