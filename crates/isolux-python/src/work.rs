//! Work on a thread of its own, while the thread that calls listens: to the work, and to Ctrl-C.

use crate::held::Map;
use crate::{arrays, error};
use isolux_cli::embedded::{Caller, Failure, Told};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// How soon Ctrl-C is seen.
const LOOK: Duration = Duration::from_millis(50);

/// What is told; the work goes on when the other is dropped.
type Message = (Told, Option<Sender<()>>);

/// Has work done without the interpreter's lock. What is told goes to `tell(kind, what)`; if that is `False`, the work is to end. With
/// `waits` the work waits for that answer at every state of progress.
///
/// The first Ctrl-C asks the work to end, and what it has come to is the result. The second is a `KeyboardInterrupt` at once; the work
/// goes on to its next look, unheard.
pub(crate) fn call<T: Send + 'static>(
    py: Python<'_>,
    (tell, waits): (&Bound<'_, PyAny>, bool),
    work: impl FnOnce(Caller) -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    let wants_end = Arc::new(AtomicBool::new(false));
    let (sender, messages) = channel();
    let send = move |told: Told| {
        let waits = waits && matches!(told, Told::Progress(_));
        let (answer, answered) = channel();
        // Nobody listens any more after a second Ctrl-C.
        let _ = sender.send((told, waits.then_some(answer)));
        let _ = answered.recv();
    };
    let caller = Caller {
        given: Vec::new(),
        wants_end: Arc::clone(&wants_end),
        makes_increments: false,
        tell: Box::new(send),
    };
    let worker = std::thread::spawn(|| catch_unwind(AssertUnwindSafe(|| work(caller))));
    let raised = listen(py, messages, (tell, &wants_end))?;
    match (raised, py.detach(|| worker.join()).flatten()) {
        (_, Err(panic)) => Err(error::of_panic(py, panic.as_ref())),
        (Some(raised), _) => Err(raised),
        (None, Ok(result)) => result.map_err(|failure| error::of_failure(py, &failure)),
    }
}

/// Listens until the work is done. An exception of `tell` ends the work and is handed back; the second Ctrl-C is an error.
fn listen(
    py: Python<'_>,
    mut messages: Receiver<Message>,
    (tell, wants_end): (&Bound<'_, PyAny>, &AtomicBool),
) -> PyResult<Option<PyErr>> {
    let (mut raised, mut is_interrupted) = (None, false);
    loop {
        // A receiver may go to another thread, not be seen by two.
        let own = &mut messages;
        let goes_on = match py.detach(move || own.recv_timeout(LOOK)) {
            Err(RecvTimeoutError::Disconnected) => return Ok(raised),
            Err(RecvTimeoutError::Timeout) => py.check_signals().map(|()| true),
            Ok((told, _answered)) => {
                let goes_on = hand_over(tell, told);
                // Before it is answered.
                wants_end.fetch_or(!matches!(goes_on, Ok(true)), Ordering::Relaxed);
                goes_on
            }
        };
        let Err(exception) = goes_on else { continue };
        wants_end.store(true, Ordering::Relaxed);
        if !exception.is_instance_of::<PyKeyboardInterrupt>(py) {
            raised.get_or_insert(exception);
        } else if std::mem::replace(&mut is_interrupted, true) {
            return Err(exception);
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
