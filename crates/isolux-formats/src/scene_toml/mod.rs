//! The native scene description.
