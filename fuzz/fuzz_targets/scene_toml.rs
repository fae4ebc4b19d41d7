#![no_main]
isolux_fuzz::target!("scene_toml");
