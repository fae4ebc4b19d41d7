//! Work on a thread of its own, while the thread that calls listens: to the work, and to Ctrl-C.

use crate::held::Map;
use crate::{arrays, error};
use isolux_cli::embedded::{Caller, Failure, Stop, Told};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// How soon Ctrl-C is seen.
const LOOK: Duration = Duration::from_millis(50);

/// What is told; the work goes on when the other is dropped.
type Message = (Told, Option<Sender<()>>);

/// Has work done without the interpreter's lock. What is told goes to `tell(kind, what)`; if that is `False`, the work is to end. With
/// `waits` the work waits for that answer at every state of progress.
///
/// Ctrl-C is a `KeyboardInterrupt` at once, and the work ends at its next look, unheard. Where the work has something to keep, the first
/// one asks it to end instead, and what it has come to is the result.
pub(crate) fn call<T: Send + 'static>(
    py: Python<'_>,
    (tell, waits): (&Bound<'_, PyAny>, bool),
    work: impl FnOnce(Caller) -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    let stop = Arc::new(Stop::default());
    let (sender, messages) = channel();
    let send = move |told: Told| {
        let waits = waits && matches!(told, Told::Progress(_));
        let (answer, answered) = channel();
        // Nobody listens any more after a Ctrl-C that did not wait.
        let _ = sender.send((told, waits.then_some(answer)));
        let _ = answered.recv();
    };
    let caller = Caller {
        given: Vec::new(),
        stop: Arc::clone(&stop),
        makes_increments: false,
        tell: Box::new(send),
    };
    let worker = std::thread::spawn(|| catch_unwind(AssertUnwindSafe(|| work(caller))));
    let Heard { raised, interrupted } = listen(py, messages, (tell, &stop))?;
    match (raised, py.detach(|| worker.join()).flatten()) {
        (_, Err(panic)) => Err(error::of_panic(py, panic.as_ref())),
        (Some(raised), _) => Err(raised),
        (None, Ok(Ok(result))) => Ok(result),
        // It was ended before it came to anything.
        (None, Ok(Err(failure))) => {
            Err(interrupted.unwrap_or_else(|| error::of_failure(py, &failure)))
        }
    }
}

/// What else was heard while the work went on.
#[derive(Default)]
struct Heard {
    /// An exception of `tell`, which has ended the work.
    raised: Option<PyErr>,
    /// The first Ctrl-C, if the work was to keep what it had.
    interrupted: Option<PyErr>,
}

/// Listens until the work is done. A Ctrl-C that does not wait for that is an error.
fn listen(
    py: Python<'_>,
    mut messages: Receiver<Message>,
    (tell, stop): (&Bound<'_, PyAny>, &Stop),
) -> PyResult<Heard> {
    let mut heard = Heard::default();
    loop {
        // A receiver may go to another thread, not be seen by two.
        let own = &mut messages;
        let goes_on = match py.detach(move || own.recv_timeout(LOOK)) {
            Err(RecvTimeoutError::Disconnected) => return Ok(heard),
            Err(RecvTimeoutError::Timeout) => py.check_signals().map(|()| true),
            Ok((told, _answered)) => {
                let goes_on = hand_over(tell, told);
                // Before it is answered.
                if !matches!(goes_on, Ok(true)) {
                    stop.ask();
                }
                goes_on
            }
        };
        let Err(exception) = goes_on else { continue };
        stop.ask();
        if !exception.is_instance_of::<PyKeyboardInterrupt>(py) {
            heard.raised.get_or_insert(exception);
        } else if heard.interrupted.is_some() || !stop.keeps() {
            stop.leave();
            return Err(exception);
        } else {
            heard.interrupted = Some(exception);
        }
    }
}

/// Whether the work goes on.
fn hand_over(tell: &Bound<'_, PyAny>, told: Told) -> PyResult<bool> {
    let py = tell.py();
    let answer = match told {
        Told::Note(kind, text) => tell.call1((kind, text)),
        Told::Progress(json) => tell.call1(("progress", json)),
        Told::Json(json) => tell.call1(("json", json)),
        Told::Text(text) => tell.call1(("text", text)),
        Told::Map(path, held) => {
            let map = Bound::new(py, Map { held: Arc::from(held) })?;
            tell.call1(("map", (path, map)))
        }
        Told::Wanted(wanted) => {
            let bytes = |of: Option<Vec<u8>>| of.map(|of| PyBytes::new(py, &of));
            let (scene, pilot) = (bytes(wanted.scene), bytes(wanted.pilot));
            let what = (scene, pilot, wanted.stage, wanted.increment);
            let part: Option<Vec<u8>> = tell.call1(("increment", what))?.extract()?;
            // Without an answer the run ends.
            let _ = part.map(|part| wanted.answer.send(part));
            return Ok(true);
        }
        Told::Picture(picture) => {
            let size = [picture.height, picture.width];
            tell.call1(("picture", arrays::image(py, size, picture.rgb)?))
        }
        Told::Luminances { width, height, rgb_cd_m2 } => {
            tell.call1(("luminances", arrays::image(py, [height, width], rgb_cd_m2)?))
        }
    };
    Ok(!answer?.is(pyo3::types::PyBool::new(py, false)))
}
