//! A clear coat over a finish: two glossy parts, of which the lower gets and gives back what the upper lets through.

use super::{Coat, Finish};
use crate::units::Rgb;

impl Coat {
    /// Reflectance at normal incidence of an index of 1.5.
    pub const F0: f64 = 0.04;

    /// What facets reflect at an angle, cosine, the share that they cover taken into account.
    fn reflectance(&self, cos: f64) -> f64 {
        let m = (1.0 - cos).clamp(0.0, 1.0);
        let m5 = m * m * m * m * m;
        self.cover * (Self::F0 + (1.0 - Self::F0) * m5)
    }
}

impl Finish {
    /// Reflectance of all that is glossy at normal incidence.
    pub fn glossy_f0(&self) -> Rgb {
        let below = self.gloss.map_or(Rgb::BLACK, |gloss| gloss.f0);
        match &self.coat {
            None => below,
            Some(coat) => {
                let through = 1.0 - coat.reflectance(1.0);
                below * (through * through) + Rgb::grey(coat.reflectance(1.0))
            }
        }
    }

    /// What facets of the coat reflect at an angle, cosine: no more than diffuse and mirror reflectance leave.
    pub fn coat_reflectance(&self, cos: f64) -> Rgb {
        match &self.coat {
            None => Rgb::BLACK,
            Some(coat) => Rgb::grey(coat.reflectance(cos)).min(self.room_for_gloss()),
        }
    }

    /// The share of light that passes the coat twice, on its way in and out; 1 without a coat.
    pub fn through_coat(&self, cosines: [f64; 2]) -> f64 {
        let [a, b] = cosines.map(|cos| self.coat.map_or(1.0, |coat| 1.0 - coat.reflectance(cos)));
        a * b
    }

    /// What gloss below the coat may reflect at most between two directions: what all other parts leave.
    pub fn gloss_limit(&self, cosines: [f64; 2]) -> Rgb {
        let room = self.room_for_gloss();
        if self.coat.is_none() {
            return room;
        }
        let [a, b] = cosines.map(|cos| self.coat_reflectance(cos));
        Rgb([0, 1, 2].map(|k| (room.0[k] - a.0[k].max(b.0[k])).max(0.0)))
    }

    /// What diffuse and mirror reflectance leave for gloss. (The diffuse texture only lowers the
    /// diffuse part.)
    fn room_for_gloss(&self) -> Rgb {
        (Rgb::WHITE - self.diffuse.colour - self.mirror).map(|c| c.max(0.0))
    }
}
