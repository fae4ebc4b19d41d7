//! Files spoilt at random, the same on every run.

/// SplitMix64 (Steele, Lea, Flood 2014).
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    /// A number below `most`.
    pub(crate) fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % most.max(1) as u64) as usize
    }
}

/// One change: a byte, a word, a stretch left out, doubled or moved, or the end cut off.
pub(crate) fn spoil(bytes: &mut Vec<u8>, dice: &mut Dice, words: &[&str]) {
    let at = dice.below(bytes.len());
    let end = (at + 1 + dice.below(80)).min(bytes.len());
    match dice.below(7) {
        0 => bytes[at] = dice.below(256) as u8,
        1 => bytes.truncate(at + 1),
        2 => drop(bytes.drain(at..end)),
        3 => {
            let copy = bytes[at..end].to_vec();
            bytes.splice(at..at, copy);
        }
        4 => {
            let copy: Vec<u8> = bytes.drain(at..end).collect();
            let to = dice.below(bytes.len());
            bytes.splice(to..to, copy);
        }
        _ => {
            let is_space = |b: &u8| b.is_ascii_whitespace();
            let start = bytes[..at].iter().rposition(is_space).map_or(0, |k| k + 1);
            let stop = bytes[at..].iter().position(is_space).map_or(bytes.len(), |k| at + k);
            let word = words[dice.below(words.len())].bytes();
            bytes.splice(start..stop.max(start), word);
        }
    }
    if bytes.is_empty() {
        bytes.push(b'0');
    }
}
