//! Counts in sentences.

use std::fmt::Display;

/// A count and what is counted: `1 point`, `2 points`.
pub fn counted<N: Display + PartialEq + From<u8>>(count: N, one: &str, many: &str) -> String {
    let name = if count == N::from(1) { one } else { many };
    format!("{count} {name}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_singular() {
        let points = [0_u64, 1, 2].map(|count| counted(count, "point", "points"));
        assert_eq!(points, ["0 points", "1 point", "2 points"]);
    }
}
