//! Sixty scenes like those that people have: nothing of them is known in closed form, and nothing is tuned to them.
//!
//! Each is drawn from a seed. The even ones are for tuning, the odd ones, other draws of the same kinds, for judging
//! alone.

mod colours;
mod daylight;
mod draw;
mod furniture;
mod lamps;
mod luminous;
mod meshes;
pub mod places;
mod plans;
mod rooms;
mod specular;
mod stage;
#[cfg(test)]
mod tests;

use isolux::scene::SceneParts;
use stage::Stage;

/// The seed of scenes whose name gives none.
const SEED: u64 = 1;

/// A family of scenes and what draws one of them.
type Kind = (&'static str, fn(&mut Stage));

/// Every kind has a scene for tuning and one for judging.
const KINDS: [Kind; 30] = [
    ("furnished room", rooms::furnished),
    ("blocks that touch and cut", rooms::blocks),
    ("rugs and pictures", rooms::rugs_and_pictures),
    ("shelves and kitchen", rooms::shelves),
    ("low pendant", rooms::low_pendant),
    ("lamps on surfaces", lamps::on_surfaces),
    ("lamps in recesses", lamps::recessed),
    ("lamps through ceilings", lamps::through_ceilings),
    ("many lamps below a ceiling", lamps::many_below_ceiling),
    ("lamps in housings", lamps::housings),
    ("lamps in shades", lamps::shades),
    ("uplights and a cove", lamps::uplights),
    ("spots and photometric files", lamps::spots_and_files),
    ("luminous panels", luminous::panels),
    ("luminous strips and globes", luminous::strips_and_globes),
    ("opposite mirrors", specular::opposite_mirrors),
    ("mirrors in a corner", specular::mirror_corner),
    ("panes of glass", specular::panes),
    ("glass and gloss", specular::glass_and_gloss),
    ("white room", colours::white),
    ("saturated colours", colours::saturated),
    ("screens", colours::screens),
    ("L-shaped room", plans::l_shaped),
    ("nested rooms", plans::nested),
    ("corridor", plans::corridor),
    ("dim beside bright", plans::dim_beside_bright),
    ("slivers and doubled faces", meshes::slivers_and_doubles),
    ("far from the origin", meshes::far_off),
    ("millimetres and kilometres", meshes::scaled),
    ("window", daylight::window),
];

/// How many scenes there are.
pub const COUNT: u32 = 2 * KINDS.len() as u32;

/// What a scene may be used for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Half {
    /// Whatever helps.
    Tuning,
    /// Judging what is finished.
    Judging,
}

/// One of the scenes, written `truth-07` or `truth-07,seed=3`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TruthScene {
    index: u32,
    seed: u64,
}

impl TruthScene {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..COUNT).map(|index| Self { index, seed: SEED })
    }

    /// By its name.
    pub fn parse(name: &str) -> Option<Self> {
        let (number, settings) = name.strip_prefix("truth-")?.split_at_checked(2)?;
        let index = number.parse().ok().filter(|&index| index < COUNT)?;
        let seed = match settings {
            "" => SEED,
            _ => settings.strip_prefix(",seed=")?.parse().ok()?,
        };
        let scene = Self { index, seed };
        // One way to write each.
        (scene.name() == name || settings == ",seed=1").then_some(scene)
    }

    /// Its name.
    pub fn name(self) -> String {
        let Self { index, seed } = self;
        if seed == SEED {
            format!("truth-{index:02}")
        } else {
            format!("truth-{index:02},seed={seed}")
        }
    }

    /// What kind of scene it is.
    pub fn kind(self) -> &'static str {
        KINDS[self.index as usize / 2].0
    }

    /// What it may be used for.
    pub fn half(self) -> Half {
        if self.index.is_multiple_of(2) { Half::Tuning } else { Half::Judging }
    }

    /// The scene itself.
    pub fn parts(self) -> SceneParts {
        let mut stage = Stage::new(self.name(), self.seed, self.index);
        KINDS[self.index as usize / 2].1(&mut stage);
        stage.into_parts()
    }
}
