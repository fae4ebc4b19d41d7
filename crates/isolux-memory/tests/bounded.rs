//! Memory of a program that has the allocator. The test is a program of its own: it is run a second time to be ended.
#![expect(clippy::print_stderr, reason = "the second program speaks")]

use isolux_memory::{Counted, Lack, allow, end_by, peak_bytes};
use std::process::Command;

#[global_allocator]
static MEMORY: Counted = Counted;

/// Says to the second program what it is to do.
const TOO_MUCH: &str = "ISOLUX_MEMORY_TEST";
const MIB: usize = 1 << 20;

fn end(lack: Lack) -> ! {
    // Takes memory, too.
    let text = format!("{lack:?}");
    eprintln!("{text}");
    std::process::exit(4)
}

#[test]
fn what_is_taken_is_counted_and_what_is_too_much_ends_the_program_in_words() {
    if let Ok(what) = std::env::var(TOO_MUCH) {
        end_by(end);
        take(&what);
    }
    let before = peak_bytes();
    let mut many: Vec<Vec<u8>> = (0..64).map(|_| vec![1; MIB]).collect();
    let rise = peak_bytes() - before;
    assert!((64..=65).contains(&(rise / MIB as u64)), "{rise} bytes");
    many.clear();
    drop(vec![1u8; 60 * MIB]);
    assert_eq!(peak_bytes() - before, rise, "what was given back can be taken again");
    let said = |what: &str| {
        let test = std::env::current_exe().unwrap();
        let ran = Command::new(test).arg("--nocapture").env(TOO_MUCH, what).output().unwrap();
        (ran.status.code(), String::from_utf8(ran.stderr).unwrap())
    };
    for what in ["one", "growing", "threads"] {
        let (code, err) = said(what);
        assert_eq!(code, Some(4), "{what}: {err}");
        assert!(err.contains("allowed: Some(104857600)"), "{what}: {err}");
        assert_eq!(err.matches("Lack").count(), 1, "{what}: {err}");
    }
    let (code, err) = said("machine");
    assert_eq!(code, Some(4), "{err}");
    assert!(err.contains("allowed: None"), "{err}");
}

/// More than is allowed, in several ways.
fn take(what: &str) {
    if what != "machine" {
        allow(100 * MIB as u64);
    }
    match what {
        "one" => drop(vec![1u8; 200 * MIB]),
        "growing" => {
            let mut all = Vec::new();
            (0..64 * MIB as u64).for_each(|k| all.push(k));
        }
        "threads" => std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    let all: Vec<Vec<u8>> = (0..100).map(|_| vec![1; MIB]).collect();
                    // All of them are kept until the end.
                    std::thread::sleep(std::time::Duration::from_secs(60));
                    drop(all);
                });
            }
        }),
        // Half of what can be addressed: no machine has it.
        _ => drop(Vec::<u8>::with_capacity(isize::MAX as usize / 2)),
    }
}
