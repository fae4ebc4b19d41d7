//! Planar mirrors, and chains of them that light follows.

pub(super) mod chains;
mod in_view;
pub(super) mod met;
pub(super) mod planar;
mod seams;
pub(super) mod twins;
