//! What an export for engines has written.

use crate::failure::Failure;
use serde::Serialize;

/// What was written.
pub(crate) struct Exported {
    /// For programs.
    pub facts: serde_json::Value,
    /// For people.
    pub text: String,
}

impl Exported {
    /// By a report and its text.
    pub(crate) fn new(report: &impl Serialize, text: String) -> Result<Self, Failure> {
        let facts = serde_json::to_value(report).map_err(|e| Failure::Refused(e.to_string()))?;
        Ok(Self { facts, text })
    }
}
