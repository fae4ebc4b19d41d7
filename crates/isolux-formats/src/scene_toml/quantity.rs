//! Numbers as written, with the range their meaning allows.

use isolux::units::Rgb;
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;

/// Defines a number type that refuses what lies outside its range.
macro_rules! number {
    ($(#[$doc:meta])* $name:ident, $range:literal, $accepts:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
        #[serde(try_from = "f64")]
        pub(super) struct $name(pub(super) f64);

        impl TryFrom<f64> for $name {
            type Error = String;

            fn try_from(value: f64) -> Result<Self, String> {
                let accepts: fn(f64) -> bool = $accepts;
                if accepts(value) {
                    Ok(Self(value))
                } else {
                    Err(format!(concat!("{} is out of range, expected ", $range), value))
                }
            }
        }
    };
}

number!(
    /// Any number but infinity and NaN.
    Number, "a finite number", f64::is_finite
);
number!(
    /// Above zero.
    Positive, "a finite number above 0", |v| v > 0.0 && v.is_finite()
);
number!(
    /// Zero or more.
    NonNegative, "a finite number of 0 or more", |v| v >= 0.0 && v.is_finite()
);
number!(
    /// A part of a whole.
    Share, "a number from 0 to 1", |v| (0.0..=1.0).contains(&v)
);

/// Three numbers.
pub(super) type Triple = [Number; 3];

/// The plain numbers of a triple.
pub(super) fn plain(triple: Triple) -> [f64; 3] {
    triple.map(|n| n.0)
}

/// A number for all channels, three numbers (linear Rec. 709), or `"#rrggbb"` (sRGB); finite and
/// not negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Colour(pub(super) Rgb);

impl<'de> Deserialize<'de> for Colour {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ColourVisitor)
    }
}

struct ColourVisitor;

impl<'de> Visitor<'de> for ColourVisitor {
    type Value = Colour;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a number, [red, green, blue], or \"#rrggbb\"")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Colour, E> {
        NonNegative::try_from(value).map(|v| Colour(Rgb::grey(v.0))).map_err(E::custom)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Colour, E> {
        self.visit_f64(value as f64)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Colour, E> {
        hex(text)
            .map(|bytes| Colour(Rgb(bytes.map(linear_from_srgb))))
            .ok_or_else(|| E::custom(format!("`{text}` is not a colour, expected \"#rrggbb\"")))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Colour, A::Error> {
        let mut channels = [0.0; 3];
        for (k, channel) in channels.iter_mut().enumerate() {
            let value: Option<NonNegative> = list.next_element()?;
            *channel = value.ok_or_else(|| A::Error::invalid_length(k, &self))?.0;
        }
        match list.next_element::<f64>()? {
            None => Ok(Colour(Rgb(channels))),
            Some(_) => Err(A::Error::invalid_length(4, &self)),
        }
    }
}

fn hex(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#').filter(|d| d.len() == 6 && d.is_ascii())?;
    let mut bytes = [0; 3];
    for (k, byte) in bytes.iter_mut().enumerate() {
        *byte = u8::from_str_radix(&digits[2 * k..2 * k + 2], 16).ok()?;
    }
    Some(bytes)
}

/// IEC 61966-2-1.
fn linear_from_srgb(code: u8) -> f64 {
    let c = f64::from(code) / 255.0;
    if c <= 0.04045 { c / 12.92 } else { libm::pow((c + 0.055) / 1.055, 2.4) }
}

/// A unit of length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub(super) enum LengthUnit {
    #[serde(rename = "m")]
    Metre,
    #[serde(rename = "cm")]
    Centimetre,
    #[serde(rename = "mm")]
    Millimetre,
    #[serde(rename = "in")]
    Inch,
    #[serde(rename = "ft")]
    Foot,
}

impl LengthUnit {
    /// Metres in one of it (inch and foot of 1959).
    pub(super) fn metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Centimetre => 0.01,
            Self::Millimetre => 0.001,
            Self::Inch => 0.0254,
            Self::Foot => 0.3048,
        }
    }
}
