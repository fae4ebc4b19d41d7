//! Relative differences as colours.

use crate::error::ViewError;
use crate::image::Size;
use crate::picture::{Picture, UNKNOWN};
use colorous::RED_BLUE;

/// Draws relative differences, row by row from the top: red where there is more than there should be, blue where there is less, white where it is right
/// (the scheme RdBu of ColorBrewer), in full colour from `limit` on; [`UNKNOWN`] where nothing is known. Cells beyond those given are unknown, too.
pub fn differences(size: Size, shares: &[Option<f64>], limit: f64) -> Result<Picture, ViewError> {
    if !(limit > 0.0 && limit.is_finite()) {
        return Err(ViewError::Limit(limit));
    }
    let colour = |share: f64| {
        let along = 0.5 - 0.5 * (share / limit).clamp(-1.0, 1.0);
        RED_BLUE.eval_continuous(along).as_array()
    };
    let known = |pixel: usize| shares.get(pixel).copied().flatten().filter(|share| !share.is_nan());
    let rgb = (0..size.pixels()).map(|pixel| known(pixel).map_or(UNKNOWN, colour)).collect();
    Ok(Picture { width: size.width(), height: size.height(), rgb, icc: None })
}

impl Picture {
    /// The same with every pixel as a square of so many a side.
    pub fn enlarged(&self, times: u32) -> Result<Self, ViewError> {
        let over = |side: u32| side.saturating_mul(times);
        let size = Size::new(over(self.width), over(self.height))?;
        let place = |k: usize| {
            let (x, y) = (k as u32 % size.width(), k as u32 / size.width());
            self.rgb[((y / times) * self.width + x / times) as usize]
        };
        let rgb = (0..size.pixels()).map(place).collect();
        Ok(Self { width: size.width(), height: size.height(), rgb, icc: self.icc.clone() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_much_is_red_and_too_little_blue() {
        let size = Size::new(5, 1).unwrap();
        let shares = [Some(0.3), Some(0.0), Some(-0.1), None, Some(f64::NAN)];
        let drawn = differences(size, &shares, 0.1).unwrap();
        let [more, right, less, ..] = drawn.rgb.as_slice() else { panic!("five pixels") };
        assert!(more[0] > 2 * more[2] && less[2] > 2 * less[0]);
        assert!(right.iter().all(|code| *code > 235));
        assert_eq!(drawn.rgb[3..], [UNKNOWN; 2]);
        assert_eq!(drawn.enlarged(3).unwrap().pixel(4, 2), Some(*right));
        for limit in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(differences(size, &shares, limit).is_err());
        }
    }
}
