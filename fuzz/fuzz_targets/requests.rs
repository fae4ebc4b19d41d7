#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| isolux_fuzz::ask(bytes));
