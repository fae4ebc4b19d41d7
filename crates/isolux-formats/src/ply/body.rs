//! Rows of the data, written as text or binary.

use super::header::{Element, Format, Scalar, Wrong};

/// The numbers of one row.
#[derive(Default)]
pub(super) struct Row {
    values: Vec<f64>,
    /// Where each property begins in them.
    starts: Vec<usize>,
}

impl Row {
    /// A property that is one number.
    pub(super) fn number(&self, property: usize) -> Option<f64> {
        self.list(property).first().copied()
    }

    /// A property that is a list.
    pub(super) fn list(&self, property: usize) -> &[f64] {
        let Some(&start) = self.starts.get(property) else { return &[] };
        let end = self.starts.get(property + 1).copied().unwrap_or(self.values.len());
        &self.values[start..end]
    }

    fn clear(&mut self) {
        self.values.clear();
        self.starts.clear();
    }
}

/// What is left of the data.
pub(super) struct Body<'a> {
    format: Format,
    rest: &'a [u8],
    /// Number of the last line read.
    line: usize,
    /// The row that is read, for messages: `vertex 3`.
    element: String,
    number: u64,
}

impl<'a> Body<'a> {
    pub(super) fn new(format: Format, rest: &'a [u8], header_lines: usize) -> Self {
        Self { format, rest, line: header_lines, element: String::new(), number: 0 }
    }

    /// Bytes that are not read yet.
    pub(super) fn bytes_left(&self) -> usize {
        self.rest.len()
    }

    /// Whether the data can hold the rows of an element, of which each takes some bytes at least.
    pub(super) fn begin(&mut self, element: &Element) -> Result<(), Wrong> {
        self.element.clone_from(&element.name);
        self.number = 0;
        let least: usize = match self.format {
            // A digit and what separates it from the next.
            Format::Text => 2 * element.properties.len(),
            _ => element.properties.iter().map(|p| p.length.unwrap_or(p.scalar).size()).sum(),
        };
        if least == 0 && element.count > 0 {
            let what = format!("element `{}` has no properties", element.name);
            return Err(Wrong::at_line(element.line, what));
        }
        // The last line of a text may go without its end.
        let room = (self.rest.len() as u64 + 1) / least.max(1) as u64;
        if element.count > room {
            let what = format!(
                "{} rows of `{}`, where the file has room for {room} at most",
                element.count, element.name
            );
            return Err(Wrong::at_line(element.line, what));
        }
        Ok(())
    }

    /// Where the last row stands.
    pub(super) fn place(&self) -> String {
        match self.format {
            Format::Text => format!("line {}", self.line),
            _ => format!("{} {}", self.element, self.number),
        }
    }

    /// Reads the next row of an element.
    pub(super) fn row(&mut self, element: &Element, into: &mut Row) -> Result<(), Wrong> {
        into.clear();
        self.number += 1;
        let read = match self.format {
            Format::Text => self.text_row(element, into),
            Format::LittleEndian => self.binary_row::<false>(element, into),
            Format::BigEndian => self.binary_row::<true>(element, into),
        };
        read.map_err(|what| Wrong { place: self.place(), what })
    }

    fn text_row(&mut self, element: &Element, into: &mut Row) -> Result<(), String> {
        let line = self.text_line()?;
        let line = std::str::from_utf8(line).map_err(|_| "is no text".to_owned())?;
        let mut words = line.split_ascii_whitespace();
        let mut next = || -> Result<f64, String> {
            let word = words.next().ok_or("too few numbers")?;
            let shown = || word.chars().take(40).collect::<String>();
            word.parse().map_err(|_| format!("`{}` is not a number", shown()))
        };
        for property in &element.properties {
            into.starts.push(into.values.len());
            let count = if property.length.is_some() { length(next()?)? } else { 1 };
            for _ in 0..count {
                into.values.push(next()?);
            }
        }
        match words.next() {
            None => Ok(()),
            Some(_) => Err("more numbers than the header says".into()),
        }
    }

    /// The next line that is not blank.
    fn text_line(&mut self) -> Result<&'a [u8], String> {
        loop {
            if self.rest.is_empty() {
                return Err("the file ends here: it is cut off".into());
            }
            self.line += 1;
            let end = self.rest.iter().position(|&b| b == b'\n').unwrap_or(self.rest.len());
            let line = self.rest[..end].trim_ascii();
            self.rest = &self.rest[(end + 1).min(self.rest.len())..];
            if !line.is_empty() {
                return Ok(line);
            }
        }
    }

    fn binary_row<const BIG: bool>(
        &mut self,
        element: &Element,
        into: &mut Row,
    ) -> Result<(), String> {
        for property in &element.properties {
            into.starts.push(into.values.len());
            let count = match property.length {
                Some(scalar) => length(self.number::<BIG>(scalar)?)?,
                None => 1,
            };
            if count > self.rest.len() / property.scalar.size() {
                return Err("the file ends here: it is cut off".into());
            }
            for _ in 0..count {
                into.values.push(self.number::<BIG>(property.scalar)?);
            }
        }
        Ok(())
    }

    fn number<const BIG: bool>(&mut self, scalar: Scalar) -> Result<f64, String> {
        Ok(match scalar {
            Scalar::I8 => f64::from(i8::from_le_bytes(self.take::<1, BIG>()?)),
            Scalar::U8 => f64::from(u8::from_le_bytes(self.take::<1, BIG>()?)),
            Scalar::I16 => f64::from(i16::from_le_bytes(self.take::<2, BIG>()?)),
            Scalar::U16 => f64::from(u16::from_le_bytes(self.take::<2, BIG>()?)),
            Scalar::I32 => f64::from(i32::from_le_bytes(self.take::<4, BIG>()?)),
            Scalar::U32 => f64::from(u32::from_le_bytes(self.take::<4, BIG>()?)),
            Scalar::F32 => f64::from(f32::from_le_bytes(self.take::<4, BIG>()?)),
            Scalar::F64 => f64::from_le_bytes(self.take::<8, BIG>()?),
        })
    }

    /// The next bytes, the least significant first.
    fn take<const N: usize, const BIG: bool>(&mut self) -> Result<[u8; N], String> {
        let (bytes, rest) =
            self.rest.split_first_chunk::<N>().ok_or("the file ends here: it is cut off")?;
        self.rest = rest;
        let mut bytes = *bytes;
        if BIG {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

fn length(value: f64) -> Result<usize, String> {
    // Whole numbers of this size are exact.
    let is_length = value >= 0.0 && value <= f64::from(u32::MAX) && value.fract() == 0.0;
    is_length
        .then_some(value as usize)
        .ok_or_else(|| format!("{value} is not the length of a list"))
}
