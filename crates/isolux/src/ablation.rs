//! Ablation: runs without one mechanism of the engines, to measure its effect.
//!
//! The feature `ablation` is for this purpose alone. With it, a run leaves out the mechanisms named in the environment
//! variable `ISOLUX_WITHOUT`, separated by commas. `cargo xtask bench ablation` builds the feature and compares the
//! runs. Without the feature, [`without`] is `false` and costs nothing.

/// Whether a mechanism is left out: never without the feature `ablation`.
#[cfg(not(feature = "ablation"))]
#[inline(always)]
pub(crate) const fn without(_mechanism: &str) -> bool {
    false
}

/// Whether a mechanism is left out: whether `ISOLUX_WITHOUT` names it.
#[cfg(feature = "ablation")]
pub(crate) fn without(mechanism: &str) -> bool {
    use std::sync::LazyLock;
    static LEFT_OUT: LazyLock<Vec<String>> = LazyLock::new(|| {
        let named = std::env::var("ISOLUX_WITHOUT").unwrap_or_default();
        named.split(',').map(str::to_owned).collect()
    });
    LEFT_OUT.iter().any(|name| name == mechanism)
}
