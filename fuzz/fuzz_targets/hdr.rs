#![no_main]
isolux_fuzz::target!("hdr");
