//! What the commands around a statement make of it.

use super::limits;
use super::xform::Xform;
use isolux::geometry::Transform;
use std::rc::Rc;

/// All `xform`s around a statement together.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) world_from_file: Transform,
    /// Whether surfaces are turned inside out.
    pub(super) invert: bool,
    /// What surfaces are made of instead of what they say.
    pub(super) modifier: Option<Rc<str>>,
    /// What names of surfaces get in front.
    prefix: String,
}

impl Frame {
    /// No command around.
    pub(super) fn world() -> Self {
        Self {
            world_from_file: Transform::IDENTITY,
            invert: false,
            modifier: None,
            prefix: String::new(),
        }
    }

    /// The name of a surface.
    pub(super) fn name(&self, own: &str) -> String {
        format!("{}{own}", self.prefix)
    }

    /// Each copy that these `xform`s make, the first the innermost.
    pub(super) fn within(&self, stages: &[Xform]) -> Result<Vec<Self>, String> {
        let total = stages.iter().try_fold(1_usize, |n, stage| n.checked_mul(stage.copies.len()));
        if total.is_none_or(|n| n > limits::COPIES) {
            return Err(format!("it makes more than {} copies", limits::COPIES));
        }
        let mut frames = vec![self.clone()];
        for stage in stages.iter().rev() {
            frames = frames.iter().flat_map(|outer| outer.copies(stage)).collect();
        }
        Ok(frames)
    }

    fn copies(&self, stage: &Xform) -> Vec<Self> {
        let modifier = self.modifier.clone().or_else(|| stage.modifier.as_deref().map(Rc::from));
        let copy = |copy: &super::xform::Copy| Self {
            world_from_file: self.world_from_file.then_from(&copy.map),
            invert: self.invert != stage.invert,
            modifier: modifier.clone(),
            prefix: match copy.prefix.as_str() {
                "" => self.prefix.clone(),
                own => format!("{}{own}.", self.prefix),
            },
        };
        stage.copies.iter().map(copy).collect()
    }
}
