//! The last words of the command.

use crate::failure::{Failure, Outcome, exit_code};
use crate::{console, notes, trouble};

/// Says why there is no result, where there is none, and tells the exit code.
pub(crate) fn tell(end: &Result<Outcome, Failure>, json: bool) -> u8 {
    let code = exit_code(end);
    if let Err(failure) = end {
        failure.lines().iter().for_each(|(kind, line)| notes::note(*kind, line));
        if json && !matches!(failure, Failure::ReaderGone) {
            // Nobody may be there to read it.
            let _ = console::print_json(&trouble::json(&failure.troubles(), code));
        }
    }
    code
}
