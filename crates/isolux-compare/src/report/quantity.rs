//! Numbers as reports show them: as many digits as mean something, and a dash for what is not known.

/// What is not known.
pub(super) const UNKNOWN: &str = "–";

/// Digits that mean something in errors, times and distances of a single run.
const DIGITS: usize = 3;

/// Digits of what was asked for, which is exact.
pub(super) const ASKED_DIGITS: usize = 6;

/// Powers of ten between which numbers are written without one.
const PLAIN: std::ops::RangeInclusive<i32> = -4..=5;

/// Digits of a group in whole numbers.
const GROUP: usize = 3;

/// A number with three digits.
pub(super) fn number(value: f64) -> String {
    significant(value, DIGITS)
}

/// A number with so many digits behind the point.
pub(super) fn fixed(value: f64, behind: usize) -> String {
    if !value.is_finite() {
        return UNKNOWN.to_owned();
    }
    let text = format!("{value:.behind$}");
    let is_zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if is_zero { text.replace('-', "") } else { text.replace('-', "−") }
}

/// A share as hundredths, without sign.
pub(super) fn percent(share: f64) -> String {
    number(100.0 * share)
}

/// A share as hundredths, with its sign.
pub(super) fn percent_sign(share: f64) -> String {
    with_unit(percent(share), "%")
}

/// A time that was asked for, s: as it was asked for.
pub(super) fn asked(time_s: f64) -> String {
    with_unit(short(time_s, ASKED_DIGITS), "s")
}

/// A time, s.
pub(super) fn seconds(time_s: f64) -> String {
    with_unit(number(time_s), "s")
}

/// A value if there is one, else a dash.
pub(super) fn known<T>(value: Option<T>, show: impl Fn(T) -> String) -> String {
    value.map_or_else(|| UNKNOWN.to_owned(), show)
}

/// A number of things, in groups of three digits.
pub(super) fn count(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(GROUP) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A number of things by their name, in one or in many.
pub(super) fn things(number: usize, one: &str, many: &str) -> String {
    format!("{} {}", count(number as u64), if number == 1 { one } else { many })
}

/// A list in a sentence.
pub(super) fn list(items: &[impl AsRef<str>]) -> String {
    let items: Vec<&str> = items.iter().map(AsRef::as_ref).collect();
    match items.as_slice() {
        [] => "none".to_owned(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// A number with so many digits; of those that are very large or small, times a power of ten.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return UNKNOWN.to_owned();
    }
    let behind = digits.saturating_sub(1);
    let rounded = format!("{value:.behind$e}");
    let Some((mantissa, power)) = rounded.split_once('e') else { return rounded };
    let power: i32 = power.parse().unwrap_or_default();
    let text = if value == 0.0 {
        "0".to_owned()
    } else if PLAIN.contains(&power) {
        let behind = usize::try_from(behind as i32 - power).unwrap_or_default();
        format!("{value:.behind$}")
    } else {
        format!("{mantissa}×10{}", raised(power))
    };
    text.replace('-', "−")
}

/// A number with at most so many digits, without zeros at its end.
pub(super) fn short(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (mantissa, power) = text.split_at(text.find('×').unwrap_or(text.len()));
    if !mantissa.contains('.') {
        return text;
    }
    format!("{}{power}", mantissa.trim_end_matches('0').trim_end_matches('.'))
}

fn raised(power: i32) -> String {
    let digit = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        other => other.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(other),
    };
    power.to_string().chars().map(digit).collect()
}

/// A number and its unit, which stay on one line; a dash has no unit.
fn with_unit(number: String, unit: &str) -> String {
    if number == UNKNOWN { number } else { format!("{number}\u{a0}{unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1.00"),
            (0.028, "0.0280"),
            (12.345, "12.3"),
            (999.96, "1000"),
            (123_456.7, "123457"),
            (-0.5, "−0.500"),
            (1.234e-7, "1.23×10⁻⁷"),
            (9.876e12, "9.88×10¹²"),
            (f64::NAN, UNKNOWN),
            (f64::INFINITY, UNKNOWN),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn what_is_not_known_is_a_dash_without_unit() {
        assert_eq!(known(None, percent), "–");
        assert_eq!(known(Some(0.028), percent), "2.80");
        assert_eq!(percent_sign(f64::NAN), "–");
        assert_eq!(asked(0.125), "0.125\u{a0}s");
        assert_eq!(percent_sign(0.028), "2.80\u{a0}%");
    }

    #[test]
    fn nothing_is_less_than_nothing() {
        let texts = [-0.004, -0.006, 1.0, f64::NAN].map(|value| fixed(value, 2));
        assert_eq!(texts, ["0.00", "−0.01", "1.00", UNKNOWN]);
    }

    #[test]
    fn counts_are_grouped() {
        assert_eq!([0, 999, 1000, 1_234_567].map(count), ["0", "999", "1,000", "1,234,567"]);
        assert_eq!(things(1, "map", "maps"), "1 map");
        assert_eq!(things(0, "map", "maps"), "0 maps");
    }

    #[test]
    fn lists_are_read_aloud() {
        assert_eq!(list(&[""; 0]), "none");
        assert_eq!(list(&["a"]), "a");
        assert_eq!(list(&["a", "b", "c"]), "a, b and c");
    }

    #[test]
    fn short_numbers_end_in_no_zero() {
        assert_eq!(short(0.5, 3), "0.5");
        assert_eq!(short(100.0, 3), "100");
        assert_eq!(short(0.1 + 0.2, 3), "0.3");
        assert_eq!(short(1e-9, 3), "1×10⁻⁹");
    }
}
