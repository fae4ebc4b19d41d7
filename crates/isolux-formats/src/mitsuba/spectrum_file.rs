//! Spectra in files of their own (`.spd`): a wavelength in nm and a value in each line.

/// How to mend one.
pub(super) const REMEDY: &str = "give a wavelength in nm and a value in each line";

/// The values by wavelength as a `spectrum` writes them, `400:0.5,500:0.7`; comments begin with `#`. Or the line that is wrong, and why.
pub(super) fn pairs(text: &str) -> Result<String, (usize, String)> {
    let mut pairs = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.split('#').next().unwrap_or_default();
        let words: Vec<&str> = line
            .split(|c: char| c.is_whitespace() || matches!(c, ',' | ';' | ':'))
            .filter(|word| !word.is_empty())
            .collect();
        match words.as_slice() {
            [] => {}
            [nm, value] => pairs.push(format!("{nm}:{value}")),
            _ => {
                let shown: String = line.trim().chars().take(40).collect();
                return Err((number, format!("`{shown}` is not two numbers")));
            }
        }
    }
    match pairs.is_empty() {
        true => Err((1, "there are no values".to_owned())),
        false => Ok(pairs.join(",")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_pairs() {
        assert_eq!(pairs("# nm\n400 0.1 # low\n\n\t500,2e-1\r\n").unwrap(), "400:0.1,500:2e-1");
        assert_eq!(pairs("400 0.1\n500\n"), Err((2, "`500` is not two numbers".to_owned())));
        assert_eq!(pairs("# nothing\n"), Err((1, "there are no values".to_owned())));
    }
}
