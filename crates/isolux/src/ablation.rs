//! What every mechanism of the engines is worth: runs without one of them.
//!
//! Built with the feature `ablation`, and with that alone, a run leaves out the mechanisms that the environment variable
//! `ISOLUX_WITHOUT` names, with commas between. `cargo xtask bench ablation` builds so and compares. Built without the feature,
//! [`without`] is `false` and costs nothing.

/// Whether a mechanism is left out.
#[cfg(not(feature = "ablation"))]
#[inline(always)]
pub(crate) const fn without(_mechanism: &str) -> bool {
    false
}

/// Whether a mechanism is left out.
#[cfg(feature = "ablation")]
pub(crate) fn without(mechanism: &str) -> bool {
    use std::sync::LazyLock;
    static LEFT_OUT: LazyLock<Vec<String>> = LazyLock::new(|| {
        let named = std::env::var("ISOLUX_WITHOUT").unwrap_or_default();
        named.split(',').map(str::to_owned).collect()
    });
    LEFT_OUT.iter().any(|name| name == mechanism)
}
