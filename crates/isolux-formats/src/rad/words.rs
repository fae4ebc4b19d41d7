//! Words of Radiance files.

/// A text while its words are taken from it.
pub(super) struct Words<'a> {
    rest: &'a str,
    /// Line on which the rest begins, from 1.
    line: usize,
}

impl<'a> Words<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text, line: 1 }
    }

    /// Line of what comes next.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// The first character of what comes next.
    pub(super) fn peek(&mut self) -> Option<char> {
        let blank = self.rest.len() - self.rest.trim_start().len();
        self.skip(blank);
        self.rest.chars().next()
    }

    /// The next word; a quoted one may hold blanks.
    pub(super) fn word(&mut self) -> Option<&'a str> {
        let first = self.peek()?;
        if matches!(first, '"' | '\'') {
            self.skip(1);
            let end = self.rest.find(first).unwrap_or(self.rest.len());
            let word = self.skip(end);
            self.skip(usize::from(!self.rest.is_empty()));
            return Some(word);
        }
        let end = self.rest.find(char::is_whitespace).unwrap_or(self.rest.len());
        Some(self.skip(end))
    }

    /// The rest of the line.
    pub(super) fn rest_of_line(&mut self) -> &'a str {
        let end = self.rest.find('\n').map_or(self.rest.len(), |end| end + 1);
        self.skip(end).trim_end_matches(['\r', '\n'])
    }

    fn skip(&mut self, bytes: usize) -> &'a str {
        let (skipped, rest) = self.rest.split_at(bytes);
        self.line += skipped.bytes().filter(|&b| b == b'\n').count();
        self.rest = rest;
        skipped
    }
}

/// A finite number.
pub(super) fn number(word: &str) -> Option<f64> {
    word.parse().ok().filter(|value: &f64| value.is_finite())
}

/// The stages of a command, between its pipes; what only a shell could do is an error.
pub(super) fn stages(text: &str) -> Result<Vec<Vec<String>>, String> {
    let mut stages = vec![Vec::new()];
    let mut chars = text.chars().peekable();
    while let Some(&first) = chars.peek() {
        if first.is_whitespace() {
            chars.next();
        } else if first == '|' {
            chars.next();
            stages.push(Vec::new());
        } else if first == '#' {
            break;
        } else if let Some(stage) = stages.last_mut() {
            stage.push(shell_word(&mut chars)?);
        }
    }
    Ok(stages)
}

fn shell_word(chars: &mut std::iter::Peekable<std::str::Chars>) -> Result<String, String> {
    let mut word = String::new();
    let mut quote = None;
    while let Some(&c) = chars.peek() {
        match quote {
            Some(open) if c == open => quote = None,
            Some('"') if matches!(c, '$' | '`') => return Err(format!("shell syntax `{c}`")),
            Some(_) => word.push(c),
            None if c.is_whitespace() || c == '|' => break,
            None if matches!(c, '"' | '\'') => quote = Some(c),
            None if c == '\\' => {
                chars.next();
                word.extend(chars.peek());
            }
            None if ";&<>$`(){}*?".contains(c) => return Err(format!("shell syntax `{c}`")),
            None => word.push(c),
        }
        chars.next();
    }
    match quote {
        Some(open) => Err(format!("a quote {open} that is not closed")),
        None => Ok(word),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_keep_their_lines() {
        let mut words = Words::new("a\r\n 'b c'\n\"\" d\n");
        let mut found = Vec::new();
        while words.peek().is_some() {
            let line = words.line();
            found.push((line, words.word().unwrap()));
        }
        assert_eq!(found, [(1, "a"), (2, "b c"), (3, ""), (3, "d")]);
        assert_eq!(Words::new("'open").word(), Some("open"));
    }

    #[test]
    fn commands_without_a_shell() {
        let split = |text| stages(text).map_err(|e| e.to_string());
        assert_eq!(
            split("xform -n 'a b' c.rad|xform -t\t1").unwrap(),
            [vec!["xform", "-n", "a b", "c.rad"], vec!["xform", "-t", "1"]]
        );
        assert_eq!(split("a \\\\ # b").unwrap(), [["a", "\\"]]);
        for bad in ["rm -rf /; x", "cat `x`", "a $(b)", "a > b", "\"$HOME\"", "a && b", "a 'b"] {
            assert!(split(bad).is_err(), "{bad}");
        }
    }
}
