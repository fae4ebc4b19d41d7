//! Writes the files with which fuzzing begins into `corpus/`.

fn main() -> std::io::Result<()> {
    isolux_fuzz::write_seeds(std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/corpus")))
}
