//! Bytes taken one after the other, never past their end.

use super::damage::Damage;

/// What is left of a compressed stream.
pub(super) struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    pub(super) const fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    pub(super) const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn take(&mut self, count: usize) -> Result<&'a [u8], Damage> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(Damage::CutShort)?;
        self.0 = rest;
        Ok(taken)
    }

    pub(super) fn byte(&mut self) -> Result<u8, Damage> {
        self.take(1).map(|taken| taken[0])
    }

    /// Unsigned LEB128 of at most five bytes; bits beyond 32 are dropped.
    pub(super) fn varint(&mut self) -> Result<u32, Damage> {
        let mut value = 0;
        for shift in [0, 7, 14, 21, 28] {
            let byte = self.byte()?;
            value |= u32::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(value);
            }
        }
        Err(Damage::Code)
    }
}

/// Signed differences stored with their sign in the lowest bit, of 8, 16 and 32 bits alike.
pub(super) const fn unzigzag(value: u32) -> u32 {
    (value >> 1) ^ (value & 1).wrapping_neg()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_the_specification() {
        for (bytes, value) in [
            (&[0x7f][..], 0x7f),
            (&[0x81, 0x04], 0x201),
            // 0x7f + (0x20 << 7) + (5 << 14); the page says 0x1fd005, which is another number.
            (&[0xff, 0xa0, 0x05], 0x1_507f),
        ] {
            let mut reader = Reader::new(bytes);
            assert_eq!(reader.varint(), Ok(value));
            assert!(reader.is_empty());
        }
        assert_eq!(Reader::new(&[0x80, 0x80]).varint(), Err(Damage::CutShort));
        assert_eq!(Reader::new(&[0x80; 6]).varint(), Err(Damage::Code));
    }
}
