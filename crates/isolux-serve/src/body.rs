//! Bodies of requests.

use crate::answer::Refusal;
use axum::body::{Body, HttpBody};
use axum::http::StatusCode;
use futures_util::StreamExt;
use serde::de::DeserializeOwned;
use std::time::Duration;
use tokio::time::timeout;

/// No request needs more: the rays of the largest fill a third of it.
const MAX_BYTES: usize = 64 * 1024;

const TOO_LARGE: Refusal =
    Refusal::new(StatusCode::PAYLOAD_TOO_LARGE, "the body is longer than 64 KiB");
const TOO_SLOW: Refusal =
    Refusal::new(StatusCode::REQUEST_TIMEOUT, "the body did not come in time");
const BROKEN: Refusal = Refusal::new(StatusCode::BAD_REQUEST, "the body broke off");

/// A value sent as JSON, in time.
pub(crate) async fn json<T: DeserializeOwned>(
    body: Body,
    patience: Duration,
) -> Result<T, Refusal> {
    let bytes = timeout(patience, whole(body)).await.unwrap_or(Err(TOO_SLOW))?;
    serde_json::from_slice(&bytes)
        .map_err(|e| Refusal::bad(format!("the body is no such JSON: {e}")))
}

async fn whole(body: Body) -> Result<Vec<u8>, Refusal> {
    if body.size_hint().lower() > MAX_BYTES as u64 {
        return Err(TOO_LARGE);
    }
    let mut chunks = body.into_data_stream();
    let mut bytes = Vec::new();
    while let Some(chunk) = chunks.next().await {
        bytes.extend_from_slice(&chunk.map_err(|_| BROKEN)?);
        if bytes.len() > MAX_BYTES {
            return Err(TOO_LARGE);
        }
    }
    Ok(bytes)
}
