//! `xform -f`: arguments from the lines of a file, each of which is an `xform` of its own.

use super::limits;
use super::words::stages;

/// The text of a file that a command names, or why there is none.
pub(super) type Lookup<'a> = &'a mut dyn FnMut(&str) -> Result<String, String>;

/// A command as the words of its stages.
type Stages = Vec<Vec<String>>;

/// The commands that a command stands for, one for each line of the files that its stages name by `-f`.
pub(super) fn expand(command: Stages, lookup: Lookup) -> Result<Vec<Stages>, String> {
    let mut made: Vec<Stages> = vec![Vec::new()];
    for stage in command {
        let ways = ways(stage, lookup, 0)?;
        if made.len().saturating_mul(ways.len()) > limits::COPIES {
            return Err(format!("it makes more than {} copies", limits::COPIES));
        }
        let with = |before: &Stages, way: &Vec<String>| {
            [before.as_slice(), std::slice::from_ref(way)].concat()
        };
        made = made.iter().flat_map(|m| ways.iter().map(move |way| with(m, way))).collect();
    }
    Ok(made)
}

/// The words of a stage with the words of each line in the place of `-f FILE`.
fn ways(stage: Vec<String>, lookup: Lookup, depth: usize) -> Result<Vec<Vec<String>>, String> {
    let named = stage.iter().position(|word| word == "-f");
    let at = match (stage.first().map(String::as_str), named) {
        (Some("xform"), Some(at)) => at,
        _ => return Ok(vec![stage]),
    };
    if depth >= limits::DEPTH {
        return Err(format!("files of arguments are nested more than {} deep", limits::DEPTH));
    }
    let name = stage.get(at + 1).ok_or("-f without a file")?;
    if name == "-" {
        return Err("its arguments would come from standard input".into());
    }
    let mut made = Vec::new();
    for line in lookup(name)?.lines().map(arguments).filter(|line| !line.is_empty()) {
        let mut words = stage[..at].to_vec();
        words.extend(self::words(line)?);
        words.extend_from_slice(&stage[at + 2..]);
        made.extend(ways(words, lookup, depth + 1)?);
        if made.len() > limits::COPIES {
            return Err(format!("it makes more than {} copies", limits::COPIES));
        }
    }
    Ok(made)
}

/// A line without the name of the command that may begin it; nothing of a comment.
fn arguments(line: &str) -> &str {
    let line = line.trim();
    if line.starts_with('#') {
        return "";
    }
    let name = line.strip_prefix('!').unwrap_or(line);
    match name.strip_prefix("xform") {
        Some(rest) if rest.is_empty() || rest.starts_with(char::is_whitespace) => rest.trim(),
        _ => line,
    }
}

fn words(line: &str) -> Result<Vec<String>, String> {
    let mut all = stages(line)?;
    match all.len() {
        1 => Ok(all.remove(0)),
        _ => Err("a pipe in a file of arguments".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expanded(command: &str) -> Result<Vec<String>, String> {
        let mut files = |name: &str| match name {
            "two" => Ok("# first\n-t 0 0 2\n\n!xform -n b -rz 90\n".to_owned()),
            "nested" => Ok("-s 2 -f two\nxform -mx\n".to_owned()),
            "itself" => Ok("-f itself".to_owned()),
            _ => Err("no such file".to_owned()),
        };
        let made = expand(stages(command)?, &mut files)?;
        let shown = |stages: &Stages| stages.iter().map(|w| w.join(" ")).collect::<Vec<_>>();
        Ok(made.iter().map(|stages| shown(stages).join(" | ")).collect())
    }

    #[test]
    fn every_line_is_a_command() {
        let plain = expanded("xform -t 1 0 0 a.rad | xform -mx").unwrap();
        assert_eq!(plain, ["xform -t 1 0 0 a.rad | xform -mx"]);
        let two = expanded("xform -f two -mz a.rad").unwrap();
        assert_eq!(two, ["xform -t 0 0 2 -mz a.rad", "xform -n b -rz 90 -mz a.rad"]);
        let nested = expanded("cat a.rad | xform -f nested").unwrap();
        assert_eq!(
            nested,
            [
                "cat a.rad | xform -s 2 -t 0 0 2",
                "cat a.rad | xform -s 2 -n b -rz 90",
                "cat a.rad | xform -mx"
            ]
        );
        assert_eq!(expanded("cat -f two").unwrap(), ["cat -f two"]);
        for bad in ["xform -f none a.rad", "xform -f itself a.rad", "xform -f - a.rad", "xform -f"]
        {
            assert!(expanded(bad).is_err(), "{bad}");
        }
    }
}
