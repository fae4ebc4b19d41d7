//! Files to values and values to files: scenes, photometry, maps.
