//! Files of up to a megabyte that hold as many of one thing as they can: `check` has to end in seconds.

use super::made::{KINDS, Kind};
use super::runs::Bench;
use super::told::Told;
use serde_json::{Value, json};
use std::fs;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// The time that an audit may take, file read and all. Scenes that a small file multiplies may take it, others two seconds.
const PATIENCE: Duration = Duration::from_secs(30);
/// How often the memory of a command is looked at.
const STEP: Duration = Duration::from_millis(5);

/// Checks a file of every kind.
pub(super) fn run(bench: &Bench, told: &mut Told) -> Result<Value, String> {
    let mut rows = Vec::new();
    for kind in KINDS {
        bench.clear()?;
        let (text, count) = kind.file();
        bench.write(kind.name, text.as_bytes())?;
        for (name, text) in kind.beside {
            bench.write(name, text.as_bytes())?;
        }
        let begun = Instant::now();
        let (code, peak_mb) = checked(bench, kind)?;
        let seconds = begun.elapsed().as_secs_f64();
        told.expect(matches!(code, Some(0 | 2)), || {
            format!("{count} {}: ends with {code:?} after {seconds:.0} s", kind.what)
        });
        told.step(&format!("{count} {}: {seconds:.1} s, {peak_mb} MB", kind.what));
        rows.push(json!({
            "what": format!("{}, {}", kind.name, kind.what),
            "count": count,
            "kilobytes": text.len().div_ceil(1000),
            "seconds": format!("{seconds:.1}"),
            "peak_mb": peak_mb,
            "ended": if code == Some(2) { "refused" } else { "read" },
        }));
    }
    Ok(Value::Array(rows))
}

/// The exit code of `isolux check`, none if it was killed for its time, and the most memory seen, MB.
fn checked(bench: &Bench, kind: &Kind) -> Result<(Option<i32>, u64), String> {
    let mut command = Command::new(&bench.isolux);
    command.args(["check", kind.name]).current_dir(&bench.folder);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().map_err(|e| format!("isolux does not start: {e}"))?;
    let (begun, mut peak_mb) = (Instant::now(), 0);
    loop {
        peak_mb = peak_mb.max(peak_of(&child).unwrap_or(0));
        if let Some(status) = child.try_wait().map_err(|e| format!("isolux is lost: {e}"))? {
            return Ok((status.code(), peak_mb));
        }
        if begun.elapsed() > PATIENCE {
            let ended = child.kill().and_then(|()| child.wait());
            ended.map_err(|e| format!("isolux cannot be ended: {e}"))?;
            return Ok((None, peak_mb));
        }
        std::thread::sleep(STEP);
    }
}

/// The most memory that a process has had, MB, where the system tells.
fn peak_of(child: &Child) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kb: u64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kb / 1000)
}
