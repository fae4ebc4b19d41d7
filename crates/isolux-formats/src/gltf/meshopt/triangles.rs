//! Modes TRIANGLES and INDICES: corners told by recent edges and corners.

use super::damage::Damage;
use super::reader::{Reader, unzigzag};

/// The last sixteen of something, the latest at 0.
struct Recent<T> {
    ring: [T; 16],
    written: usize,
}

impl<T: Copy + Default> Recent<T> {
    fn new() -> Self {
        Self { ring: [T::default(); 16], written: 0 }
    }

    fn push(&mut self, value: T) {
        self.ring[self.written % 16] = value;
        self.written += 1;
    }

    /// What was never written cannot be read.
    fn get(&self, back: u8) -> Result<T, Damage> {
        let at = self.written.checked_sub(1 + usize::from(back)).ok_or(Damage::Code)?;
        Ok(self.ring[at % 16])
    }
}

struct Triangles<'a> {
    data: Reader<'a>,
    /// The corner expected next if it is a new one.
    next: u32,
    /// The corner that was last told by a difference.
    last: u32,
    edges: Recent<[u32; 2]>,
    corners: Recent<u32>,
}

/// `count` corners of triangles.
pub(super) fn decode(data: &[u8], count: usize) -> Result<Vec<u32>, Damage> {
    let mut reader = Reader::new(data);
    if reader.byte()? != 0xe1 {
        return Err(Damage::Header);
    }
    let codes = reader.take(count / 3)?;
    let rest = data.len() - 1 - codes.len();
    let data = reader.take(rest.checked_sub(16).ok_or(Damage::CutShort)?)?;
    let table = reader.take(16)?;
    let mut state = Triangles {
        data: Reader::new(data),
        next: 0,
        last: 0,
        edges: Recent::new(),
        corners: Recent::new(),
    };
    let mut out = Vec::with_capacity(3 * codes.len());
    for &code in codes {
        let triangle = match (code >> 4, code & 15) {
            (0xf, low @ 0..=0xd) => state.new_corner(table[usize::from(low)])?,
            (0xf, low) => state.free(low == 0xe)?,
            (edge, corner) => state.on_edge(edge, corner)?,
        };
        out.extend(triangle);
    }
    if state.data.is_empty() { Ok(out) } else { Err(Damage::Leftover) }
}

impl Triangles<'_> {
    fn unseen(&mut self) -> u32 {
        let corner = self.next;
        self.next = self.next.wrapping_add(1);
        corner
    }

    fn told(&mut self) -> Result<u32, Damage> {
        self.last = self.last.wrapping_add(unzigzag(self.data.varint()?));
        Ok(self.last)
    }

    fn push_edges<const N: usize>(&mut self, edges: [[u32; 2]; N]) {
        for edge in edges {
            self.edges.push(edge);
        }
    }

    /// A triangle beside an earlier one.
    fn on_edge(&mut self, edge: u8, corner: u8) -> Result<[u32; 3], Damage> {
        let [a, b] = self.edges.get(edge)?;
        let is_recent = (1..0xd).contains(&corner);
        let c = match corner {
            0 => self.unseen(),
            0xd => {
                self.last = self.last.wrapping_sub(1);
                self.last
            }
            0xe => {
                self.last = self.last.wrapping_add(1);
                self.last
            }
            0xf => self.told()?,
            recent => self.corners.get(recent)?,
        };
        if !is_recent {
            self.corners.push(c);
        }
        self.push_edges([[c, b], [a, c]]);
        Ok([a, b, c])
    }

    /// A triangle with a new first corner, the others new or recent as a table says.
    fn new_corner(&mut self, others: u8) -> Result<[u32; 3], Damage> {
        let (second, third) = (others >> 4, others & 15);
        let a = self.unseen();
        let b = self.new_or_recent(second)?;
        let c = self.new_or_recent(third)?;
        Ok(self.keep([a, b, c], [true, second == 0, third == 0]))
    }

    fn new_or_recent(&mut self, code: u8) -> Result<u32, Damage> {
        match code {
            0 => Ok(self.unseen()),
            recent => self.corners.get(recent - 1),
        }
    }

    /// A triangle whose corners may all be told.
    fn free(&mut self, starts_new: bool) -> Result<[u32; 3], Damage> {
        let others = self.data.byte()?;
        if others == 0 {
            self.next = 0;
        }
        let (second, third) = (others >> 4, others & 15);
        let a = if starts_new { self.unseen() } else { self.told()? };
        let b = self.new_recent_or_told(second)?;
        let c = self.new_recent_or_told(third)?;
        let is_kept = |code: u8| code == 0 || code == 15;
        Ok(self.keep([a, b, c], [true, is_kept(second), is_kept(third)]))
    }

    fn new_recent_or_told(&mut self, code: u8) -> Result<u32, Damage> {
        if code == 15 { self.told() } else { self.new_or_recent(code) }
    }

    fn keep(&mut self, [a, b, c]: [u32; 3], as_recent: [bool; 3]) -> [u32; 3] {
        self.push_edges([[b, a], [c, b], [a, c]]);
        for (corner, is_kept) in [a, b, c].into_iter().zip(as_recent) {
            if is_kept {
                self.corners.push(corner);
            }
        }
        [a, b, c]
    }
}

/// `count` indices, each told by its difference to one of two earlier ones (mode INDICES).
pub(super) fn decode_sequence(data: &[u8], count: usize) -> Result<Vec<u32>, Damage> {
    let (&head, rest) = data.split_first().ok_or(Damage::CutShort)?;
    if head != 0xd1 {
        return Err(Damage::Header);
    }
    let (body, _padding) = rest.split_last_chunk::<4>().ok_or(Damage::CutShort)?;
    // Each index takes a byte at least.
    if count > body.len() {
        return Err(Damage::CutShort);
    }
    let mut reader = Reader::new(body);
    let mut last = [0_u32; 2];
    let mut out = Vec::with_capacity(count);
    for _ in 0..count {
        let code = reader.varint()?;
        let last = &mut last[(code & 1) as usize];
        *last = last.wrapping_add(unzigzag(code >> 1));
        out.push(*last);
    }
    if reader.is_empty() { Ok(out) } else { Err(Damage::Leftover) }
}
