//! Is it right, and by how much: scenes with exact answers and measures of error.
