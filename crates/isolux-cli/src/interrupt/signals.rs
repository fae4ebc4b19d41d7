//! The signals that ask for an end: Ctrl-C, termination, and the end of the terminal.

#[cfg(not(unix))]
pub(crate) const fn write_on_at_limits() {}

#[cfg(not(unix))]
pub(crate) fn listen(handler: impl FnMut() + Send + 'static) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(handler)
}

#[cfg(unix)]
pub(crate) use unix::{listen, write_on_at_limits};

#[cfg(unix)]
mod unix {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::iterator::Signals;
    use std::io;
    use std::sync::Arc;
    use std::thread::Builder;

    /// Calls the handler at each signal, on a thread of its own. The end of the terminal is none below `nohup`, which has it ignored.
    pub(crate) fn listen(mut handler: impl FnMut() + Send + 'static) -> io::Result<()> {
        let mut all = vec![SIGINT, SIGTERM];
        all.extend((!is_ignored(SIGHUP)).then_some(SIGHUP));
        let mut signals = Signals::new(all)?;
        let wait = move || signals.forever().for_each(|_| handler());
        Builder::new().name("signals".into()).spawn(wait).map(drop)
    }

    /// A file that reaches the size which the system allows (`ulimit -f`) ends in an error of writing, not in the end of the process.
    pub(crate) fn write_on_at_limits() {
        // Where the signal cannot be caught, it ends the process as before.
        let _ = signal_hook::flag::register(SIGXFSZ, Arc::default());
    }

    /// Whether whoever started this process has it ignore a signal. Where the system does not tell, it is not.
    fn is_ignored(signal: i32) -> bool {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        mask(&status).is_some_and(|ignored| ignored & (1 << (signal - 1)) != 0)
    }

    /// The signals that are ignored, the first one in the lowest bit.
    fn mask(status: &str) -> Option<u64> {
        let line = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
        u64::from_str_radix(line.trim(), 16).ok()
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn masks_are_hexadecimal() {
            let status = "Name:\tisolux\nSigIgn:\t0000000000001001\nSigCgt:\t0000000000000002\n";
            assert_eq!(mask(status), Some(0x1001));
            assert_eq!(mask("Name:\tisolux\n"), None);
        }
    }
}
