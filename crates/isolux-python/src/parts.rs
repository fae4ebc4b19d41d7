//! Parts of runs: one thread a maker, which holds what all increments share and makes those that it is asked for.

use crate::error;
use crate::held::Scene;
use isolux_cli::embedded::{self, Failure};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// How soon Ctrl-C is seen.
const LOOK: Duration = Duration::from_millis(50);

/// A range of increments, and where their part goes.
type Request = (std::ops::Range<u64>, Sender<Vec<u8>>);

/// The thread of a maker, with how its work has ended.
type Thread = JoinHandle<std::thread::Result<Result<(), Failure>>>;

/// Makes parts of a run.
#[pyclass(frozen, module = "isolux._native")]
pub(crate) struct PartMaker {
    requests: Mutex<Sender<Request>>,
    stops: Arc<AtomicBool>,
    thread: Mutex<Option<Thread>>,
}

#[pymethods]
impl PartMaker {
    /// Begins with the bytes of a pilot.
    #[new]
    fn new(
        py: Python<'_>,
        scene: &Scene,
        name: PathBuf,
        pilot: Vec<u8>,
        threads: Option<u16>,
    ) -> PyResult<Self> {
        let (requests, asked) = channel::<Request>();
        let (begin, begun) = channel();
        let stops = Arc::new(AtomicBool::new(false));
        let (held, its_stops) = (Arc::clone(&scene.held), Arc::clone(&stops));
        let work = move || {
            let how = (threads, &*its_stops);
            embedded::make_parts((&held, &name), &pilot, how, |make| {
                // Nobody waits any more after Ctrl-C.
                let _ = begin.send(());
                for (range, answer) in asked {
                    its_stops.store(false, Ordering::Relaxed);
                    let _ = answer.send(make(range));
                }
            })
        };
        let thread = std::thread::spawn(|| catch_unwind(AssertUnwindSafe(work)));
        let maker =
            Self { requests: Mutex::new(requests), stops, thread: Mutex::new(Some(thread)) };
        match maker.wait(py, begun)? {
            Some(()) => Ok(maker),
            None => Err(maker.end(py)),
        }
    }

    /// The part with the increments of the numbers `first` to `end` - 1.
    fn make<'py>(&self, py: Python<'py>, first: u64, end: u64) -> PyResult<Bound<'py, PyBytes>> {
        let (answer, answered) = channel();
        let requests = self.requests.lock().unwrap_or_else(PoisonError::into_inner).clone();
        // A thread that has ended drops the answer.
        let _ = requests.send((first..end, answer));
        match self.wait(py, answered)? {
            Some(bytes) => Ok(PyBytes::new(py, &bytes)),
            None => Err(self.end(py)),
        }
    }
}

impl PartMaker {
    /// What is answered, or nothing if the thread has ended. Ctrl-C is an error; what is being made ends soon.
    fn wait<T: Send>(&self, py: Python<'_>, mut answered: Receiver<T>) -> PyResult<Option<T>> {
        loop {
            let own = &mut answered;
            match py.detach(move || own.recv_timeout(LOOK)) {
                Ok(answer) => return Ok(Some(answer)),
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
                Err(RecvTimeoutError::Timeout) => py.check_signals().inspect_err(|_| {
                    self.stops.store(true, Ordering::Relaxed);
                })?,
            }
        }
    }

    /// Why the thread has ended.
    fn end(&self, py: Python<'_>) -> PyErr {
        let thread = self.thread.lock().unwrap_or_else(PoisonError::into_inner).take();
        let ended = thread.map(|thread| py.detach(|| thread.join()).flatten());
        match ended {
            Some(Ok(Err(failure))) => error::of_failure(py, &failure),
            Some(Err(panic)) => error::of_panic(py, panic.as_ref()),
            _ => error::of_panic(py, &"the maker of parts has ended before"),
        }
    }
}

impl Drop for PartMaker {
    fn drop(&mut self) {
        self.stops.store(true, Ordering::Relaxed);
    }
}
