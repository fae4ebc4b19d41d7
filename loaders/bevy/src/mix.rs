//! Groups that are dimmed: light adds up.

use crate::map::{NO_ESTIMATE, Surface, UNKNOWN};
use bevy_ecs::component::Component;
use std::collections::BTreeMap;
use std::f32::consts::PI;

/// What the groups of a map are dimmed to, and how it is exposed. Changes act in the same frame.
#[derive(Component, Clone, Debug, Default)]
pub struct Levels {
    of_groups: BTreeMap<String, f32>,
    /// What luminances are multiplied by, m2/cd; `None` leaves it to the map.
    pub exposure_m2_cd: Option<f32>,
}

impl Levels {
    /// Dims a group: 0 is off, 1 its light as in the file. Levels below 0, and those that are no number, turn it off.
    pub fn set(&mut self, group: impl Into<String>, level: f32) {
        self.of_groups.insert(group.into(), level.max(0.0));
    }

    /// What a group is dimmed to.
    pub fn get(&self, group: &str) -> f32 {
        self.of_groups.get(group).copied().unwrap_or(1.0)
    }

    /// In the order of the groups of a map.
    pub(crate) fn of(&self, groups: &[String]) -> Vec<f32> {
        groups.iter().map(|group| self.get(group)).collect()
    }

    /// Groups that are set and that a map does not have.
    pub(crate) fn strange<'a>(&'a self, groups: &'a [String]) -> impl Iterator<Item = &'a str> {
        self.of_groups.keys().map(String::as_str).filter(|name| !groups.iter().any(|g| g == name))
    }
}

impl Surface {
    /// Light at a vertex, lx.
    pub(crate) fn lit(&self, levels: &[f32], vertex: usize) -> [f32; 3] {
        if self.groups.is_empty() {
            return self.whole.rgb_lx[vertex];
        }
        let parts = self.groups.iter().zip(levels);
        let add = |sum: [f32; 3], rgb: [f32; 3], level: f32| {
            std::array::from_fn(|channel| sum[channel] + level * rgb[channel])
        };
        parts.fold([0.0; 3], |sum, (part, level)| add(sum, part.rgb_lx[vertex], *level))
    }

    /// Its standard error, lx: that of groups is independent and adds in squares. Below 0 as in the file.
    pub(crate) fn error(&self, levels: &[f32], vertex: usize) -> f32 {
        let whole = self.whole.errors_lx[vertex];
        if self.groups.is_empty() || whole == UNKNOWN {
            return whole;
        }
        let parts = || self.groups.iter().map(|part| part.errors_lx[vertex]).zip(levels);
        if parts().any(|(error, level)| error < 0.0 && *level > 0.0) {
            return NO_ESTIMATE;
        }
        parts().map(|(error, level)| (error.max(0.0) * level).powi(2)).sum::<f32>().sqrt()
    }

    /// The exposed luminance of a vertex, without its texture, in linear Rec. 709.
    pub(crate) fn colour(&self, levels: &[f32], exposure_m2_cd: f32, vertex: usize) -> [f32; 4] {
        let Some([reflectance, luminance_cd_m2]) = self.reflection else {
            return self.colours.get(vertex).copied().unwrap_or([0.0, 0.0, 0.0, 1.0]);
        };
        let lx = self.lit(levels, vertex);
        let channel =
            |k: usize| exposure_m2_cd * (reflectance[k] * lx[k] / PI + luminance_cd_m2[k]);
        [channel(0), channel(1), channel(2), 1.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_found_by_name() {
        let groups = ["spots".to_owned(), "lamps".to_owned()];
        let mut levels = Levels::default();
        levels.set("lamps", 0.25);
        levels.set("attic", 2.0);
        assert_eq!(levels.of(&groups), [1.0, 0.25]);
        assert_eq!(levels.strange(&groups).collect::<Vec<_>>(), ["attic"]);
        for bad in [-1.0, f32::NAN] {
            levels.set("spots", bad);
            assert_eq!(levels.get("spots"), 0.0);
        }
    }
}
