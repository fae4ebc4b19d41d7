//! A reader of containers, as the page has one.

use serde_json::Value;

pub(crate) struct Container {
    pub(crate) header: Value,
    body: Vec<u8>,
}

impl Container {
    pub(crate) fn read(bytes: &[u8]) -> Self {
        assert_eq!(&bytes[..8], b"ISOWALK1");
        let length = u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize;
        assert_eq!(length % 8, 0);
        let header = serde_json::from_slice(&bytes[16..16 + length]).unwrap();
        Self { header, body: bytes[16 + length..].to_vec() }
    }

    fn bytes(&self, section: &Value, size: usize, kind: &str) -> &[u8] {
        assert_eq!(section["type"], kind);
        let [offset, count] = ["offset", "count"].map(|k| section[k].as_u64().unwrap() as usize);
        assert_eq!(offset % 8, 0);
        &self.body[offset..offset + count * size]
    }

    pub(crate) fn u16s(&self, section: &Value) -> Vec<u16> {
        let pair = |pair: &[u8]| u16::from_le_bytes(pair.try_into().unwrap());
        self.bytes(section, 2, "u16").chunks(2).map(pair).collect()
    }

    /// Colours with a shared exponent.
    pub(crate) fn colours(&self, section: &Value) -> Vec<[f64; 3]> {
        let colour = |four: &[u8]| {
            let bits = u32::from_le_bytes(four.try_into().unwrap());
            let scale = f64::powi(2.0, (bits >> 27) as i32 - 24);
            [0, 9, 18].map(|shift| f64::from(bits >> shift & 511) * scale)
        };
        self.bytes(section, 4, "u32").chunks(4).map(colour).collect()
    }

    /// Positions of all vertices, less the origin.
    pub(crate) fn positions(&self) -> Vec<[f64; 3]> {
        let steps = self.u16s(&self.header["positions"]);
        let of_chunk = |chunk: &Value| {
            let [first, count] =
                ["first_vertex", "vertices"].map(|k| chunk[k].as_u64().unwrap() as usize);
            let number = |name: &str, k: usize| chunk[name][k].as_f64().unwrap();
            let place = |vertex: usize| {
                [0, 1, 2].map(|k| {
                    number("min", k) + number("step", k) * f64::from(steps[3 * vertex + k])
                })
            };
            (first..first + count).map(place).collect::<Vec<_>>()
        };
        self.header["chunks"].as_array().unwrap().iter().flat_map(of_chunk).collect()
    }
}
