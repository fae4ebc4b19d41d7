//! One connection: requests one after another, each past the guard.

use crate::answer::protected;
use crate::guard::Guard;
use crate::patient::Patient;
use crate::stopping::Stopping;
use axum::Router;
use axum::body::Body;
use axum::http::Request;
use axum::response::{IntoResponse, Response};
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::{Service, service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::convert::Infallible;
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::TcpStream;

/// Bytes of the head of a request, and of small responses that wait to be sent.
const MAX_HEAD_BYTES: usize = 16 * 1024;
const MAX_HEADERS: usize = 64;

/// Answers requests.
pub(crate) struct Door {
    pub(crate) guard: Guard,
    pub(crate) router: TowerToHyperService<Router>,
    pub(crate) patience: Duration,
}

impl Door {
    async fn answer(&self, request: Request<Incoming>) -> Result<Response, Infallible> {
        let (parts, body) = request.into_parts();
        let response = match self.guard.admit(&parts) {
            Ok(()) => self.router.call(Request::from_parts(parts, Body::new(body))).await?,
            Err(refusal) => refusal.into_response(),
        };
        Ok(protected(response))
    }
}

/// Answers what comes through a connection, until one side closes it or the server stops.
/// A client who breaks off is nobody's error.
pub(crate) async fn talk(stream: TcpStream, door: Arc<Door>, mut stopping: Stopping) {
    // Events are small and must not wait for more; where this cannot be set they come later.
    let _ = stream.set_nodelay(true);
    let stream = TokioIo::new(Patient::new(stream, door.patience));
    let answer = service_fn(|request| {
        let door = Arc::clone(&door);
        async move { door.answer(request).await }
    });
    let mut connection = pin!(protocol(door.patience).serve_connection(stream, answer));
    tokio::select! {
        _ = connection.as_mut() => return,
        () = stopping.told() => connection.as_mut().graceful_shutdown(),
    }
    let _ = connection.await;
}

fn protocol(patience: Duration) -> http1::Builder {
    let mut protocol = http1::Builder::new();
    protocol
        .timer(TokioTimer::new())
        .header_read_timeout(patience)
        .max_headers(MAX_HEADERS)
        .max_buf_size(MAX_HEAD_BYTES);
    protocol
}
