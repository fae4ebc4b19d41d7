//! What stays, stays as it is.
