//! What cannot be done is said.
