//! Mode ATTRIBUTES: differences of bytes from one element to the next, packed in groups of 16.

use super::damage::Damage;
use super::reader::{Reader, unzigzag};

/// Elements of a group.
const GROUP: usize = 16;

/// Which of the two formats a stream is written in.
#[derive(Clone, Copy, PartialEq)]
enum Version {
    Zero,
    One,
}

impl Version {
    fn of(head: u8) -> Result<Self, Damage> {
        match head {
            0xa0 => Ok(Self::Zero),
            0xa1 => Ok(Self::One),
            _ => Err(Damage::Header),
        }
    }

    /// Bytes the tail is padded to.
    const fn shortest_tail(self) -> usize {
        match self {
            Self::Zero => 32,
            Self::One => 24,
        }
    }

    /// Bytes that say something about each channel of four bytes.
    const fn channel_bytes(self, stride: usize) -> usize {
        match self {
            Self::Zero => 0,
            Self::One => stride / 4,
        }
    }
}

/// `count` elements of `stride` bytes, a multiple of four up to 256. Memory grows with what is read: at most
/// 1024 bytes come from one.
pub(super) fn decode(data: &[u8], count: usize, stride: usize) -> Result<Vec<u8>, Damage> {
    let (&head, rest) = data.split_first().ok_or(Damage::CutShort)?;
    let version = Version::of(head)?;
    let tail = stride + version.channel_bytes(stride);
    let padded = tail.max(version.shortest_tail());
    let body = rest.len().checked_sub(padded).ok_or(Damage::CutShort)?;
    let (body, padded) = rest.split_at(body);
    let (baseline, channels) = padded[padded.len() - tail..].split_at(stride);
    let channels = channels_of(version, channels, stride)?;

    let longest = ((8192 / stride) & !(GROUP - 1)).min(256);
    let mut deltas = vec![0; longest * stride];
    let mut element = baseline.to_vec();
    let mut out = Vec::new();
    let mut reader = Reader::new(body);
    let mut left = count;
    while left > 0 {
        let block = left.min(longest);
        read_block(version, &mut reader, block, stride, &mut deltas)?;
        for k in 0..block {
            for (channel, bytes) in channels.iter().zip(element.as_chunks_mut::<4>().0) {
                let first = channel.first_byte * longest + k;
                channel.advance(bytes, [0, 1, 2, 3].map(|byte| deltas[first + byte * longest]));
            }
            out.extend_from_slice(&element);
        }
        left -= block;
    }
    if reader.is_empty() { Ok(out) } else { Err(Damage::Leftover) }
}

/// How the four bytes of a channel follow from their differences.
#[derive(Clone, Copy)]
enum Difference {
    Bytes,
    Words,
    /// Exclusive or, turned right by so many bits.
    Bits(u32),
}

struct Channel {
    first_byte: usize,
    difference: Difference,
}

fn channels_of(version: Version, modes: &[u8], stride: usize) -> Result<Vec<Channel>, Damage> {
    let difference = |channel: usize| match (version, modes.get(channel)) {
        (Version::Zero, _) | (Version::One, Some(0)) => Ok(Difference::Bytes),
        (Version::One, Some(1)) => Ok(Difference::Words),
        (Version::One, Some(mode)) if mode & 15 == 2 => Ok(Difference::Bits(u32::from(mode >> 4))),
        _ => Err(Damage::Code),
    };
    (0..stride / 4)
        .map(|channel| Ok(Channel { first_byte: 4 * channel, difference: difference(channel)? }))
        .collect()
}

impl Channel {
    /// From the bytes of one element to those of the next.
    fn advance(&self, bytes: &mut [u8; 4], deltas: [u8; 4]) {
        let word = |[low, high]: [u8; 2]| u16::from_le_bytes([low, high]);
        match self.difference {
            Difference::Bytes => {
                for (byte, delta) in bytes.iter_mut().zip(deltas) {
                    *byte = byte.wrapping_add(unzigzag(u32::from(delta)) as u8);
                }
            }
            Difference::Words => {
                let [a, b, c, d] = *bytes;
                let [e, f, g, h] = deltas;
                let sum = |old: [u8; 2], delta: [u8; 2]| {
                    word(old).wrapping_add(unzigzag(u32::from(word(delta))) as u16).to_le_bytes()
                };
                let ([a, b], [c, d]) = (sum([a, b], [e, f]), sum([c, d], [g, h]));
                *bytes = [a, b, c, d];
            }
            Difference::Bits(turn) => {
                let delta = u32::from_le_bytes(deltas).rotate_right(turn);
                *bytes = (u32::from_le_bytes(*bytes) ^ delta).to_le_bytes();
            }
        }
    }
}

/// What is said of all groups of one byte of the elements.
enum Control {
    /// The bits of a difference in each kind of group.
    Groups([u32; 4]),
    Zero,
    Literal,
}

/// The differences of a block, all of the first byte of its elements first, `deltas.len() / stride`
/// places for each byte.
fn read_block(
    version: Version,
    reader: &mut Reader,
    block: usize,
    stride: usize,
    deltas: &mut [u8],
) -> Result<(), Damage> {
    let controls = reader.take(version.channel_bytes(stride))?;
    let places = deltas.len() / stride;
    for (byte, deltas) in deltas.chunks_exact_mut(places).enumerate() {
        let control = match version {
            Version::Zero => Control::Groups([0, 2, 4, 8]),
            Version::One => match controls[byte / 4] >> (2 * (byte % 4)) & 3 {
                0 => Control::Groups([0, 1, 2, 4]),
                1 => Control::Groups([1, 2, 4, 8]),
                2 => Control::Zero,
                _ => Control::Literal,
            },
        };
        match control {
            Control::Zero => deltas.fill(0),
            Control::Literal => deltas[..block].copy_from_slice(reader.take(block)?),
            Control::Groups(bits) => {
                let groups = block.div_ceil(GROUP);
                let kinds = reader.take(groups.div_ceil(4))?;
                for (group, deltas) in
                    deltas.as_chunks_mut::<GROUP>().0[..groups].iter_mut().enumerate()
                {
                    let kind = kinds[group / 4] >> (2 * (group % 4)) & 3;
                    *deltas = read_group(reader, bits[usize::from(kind)])?;
                }
            }
        }
    }
    Ok(())
}

/// Sixteen differences of so many bits each; one with all bits set is followed up by a whole byte.
fn read_group(reader: &mut Reader, bits: u32) -> Result<[u8; GROUP], Damage> {
    let mut deltas = [0; GROUP];
    if bits == 0 {
        return Ok(deltas);
    }
    let packed = reader.take(2 * bits as usize)?;
    if bits == 8 {
        deltas.copy_from_slice(packed);
        return Ok(deltas);
    }
    let per_byte = 8 / bits as usize;
    let escape = (1_u8 << bits) - 1;
    for (k, delta) in deltas.iter_mut().enumerate() {
        let place = (k % per_byte) as u32 * bits;
        // Single bits start at the lowest, the others at the highest.
        let shift = if bits == 1 { place } else { 8 - bits - place };
        let small = packed[k / per_byte] >> shift & escape;
        *delta = if small == escape { reader.byte()? } else { small };
    }
    Ok(deltas)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example of the specification, mode ATTRIBUTES.
    #[test]
    fn four_bits_with_two_escapes() {
        let bytes = [0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0x00, 0x34, 0xb5];
        let deltas = read_group(&mut Reader::new(&bytes), 4).unwrap();
        let signed = deltas.map(|delta| unzigzag(u32::from(delta)) as i8);
        assert_eq!(signed, [-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0]);
    }
}
