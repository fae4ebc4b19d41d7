//! Good files made hostile, the same on every run.

use crate::spoil::{Dice, spoil};

/// Numbers at the edges of what is meant.
pub(crate) const NUMBERS: [&str; 20] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "1e308",
    "-1e308",
    "1e-308",
    "1e39",
    "nan",
    "inf",
    "255",
    "65536",
    "1048577",
    "2147483647",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "1e15",
];

/// The same as bytes of binary files.
const WORDS: [[u8; 4]; 8] = [
    [0; 4],
    [0xff; 4],
    [0, 0, 0x80, 0x7f],
    [0, 0, 0xc0, 0x7f],
    [0xff, 0xff, 0x7f, 0x7f],
    [0xff, 0xff, 0xff, 0x7f],
    [0, 0, 0, 0x80],
    [1, 0, 0, 0],
];

/// What opens something, in one format or the other.
const OPENINGS: [&str; 8] =
    ["[", "{", "(", "<a>", "{\"a\":[", "a.", "<bsdf type=\"twosided\">", "\""];

/// So often something is opened: far deeper than any stack allows.
const DEEP: usize = 50_000;

/// One change; `other` is a file of the same kind.
pub(crate) fn bend(bytes: &mut Vec<u8>, other: &[u8], dice: &mut Dice) {
    if bytes.is_empty() {
        bytes.push(b'0');
    }
    let at = dice.below(bytes.len());
    match dice.below(16) {
        0..=1 => bytes[at] ^= 1 << dice.below(8),
        2..=6 => replace_number(bytes, at, NUMBERS[dice.below(NUMBERS.len())]),
        7..=9 => {
            let word = WORDS[dice.below(WORDS.len())];
            let at = at & !3;
            bytes.iter_mut().skip(at).zip(word).for_each(|(byte, new)| *byte = new);
        }
        10 => splice(bytes, at, other, dice),
        11 if dice.below(8) == 0 => {
            let opening = OPENINGS[dice.below(OPENINGS.len())];
            bytes.splice(at..at, opening.repeat(DEEP).into_bytes());
        }
        _ => spoil(bytes, dice, &NUMBERS),
    }
}

/// Puts a number in place of the first one from a place on.
fn replace_number(bytes: &mut Vec<u8>, at: usize, number: &str) {
    let is_part = |byte: &u8| byte.is_ascii_digit() || b".+-eE".contains(byte);
    let Some(from) = bytes[at..].iter().position(u8::is_ascii_digit) else { return };
    let start = bytes[..at + from].iter().rposition(|b| !is_part(b)).map_or(0, |k| k + 1);
    let stop = bytes[at + from..].iter().position(|b| !is_part(b));
    let stop = stop.map_or(bytes.len(), |length| at + from + length);
    bytes.splice(start..stop, number.bytes());
}

/// Goes on from a place with a part of another file.
fn splice(bytes: &mut Vec<u8>, at: usize, other: &[u8], dice: &mut Dice) {
    let from = dice.below(other.len());
    let to = (from + 1 + dice.below(400)).min(other.len());
    bytes.splice(at..at, other[from..to].iter().copied());
}
