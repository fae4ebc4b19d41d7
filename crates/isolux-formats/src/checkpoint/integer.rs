//! The integers of checkpoints.

use std::io::{self, Write};

/// An integer of fixed size.
pub trait Integer: Copy + sealed::Sealed {
    /// Its size.
    const BYTES: usize;
    #[doc(hidden)]
    fn write_to(self, to: &mut dyn Write) -> io::Result<()>;
    #[doc(hidden)]
    fn from_chunk(chunk: &[u8]) -> Self;
}

mod sealed {
    pub trait Sealed {}
}

macro_rules! integer {
    ($($kind:ty)*) => {$(
        impl sealed::Sealed for $kind {}

        impl Integer for $kind {
            const BYTES: usize = size_of::<Self>();

            fn write_to(self, to: &mut dyn Write) -> io::Result<()> {
                to.write_all(&self.to_le_bytes())
            }

            fn from_chunk(chunk: &[u8]) -> Self {
                let mut bytes = [0; size_of::<Self>()];
                bytes.copy_from_slice(chunk);
                Self::from_le_bytes(bytes)
            }
        }
    )*};
}

integer!(u32 u64 i64 i128);
