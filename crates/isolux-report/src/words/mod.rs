//! The words of a report, one file a language.

mod english;
mod german;
mod phrases;

use isolux_view::PlanWords;
pub(crate) use phrases::Words;

/// The languages of reports.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// German.
    German,
}

impl Language {
    /// The words of plans of illuminance.
    pub const fn plan(self) -> &'static PlanWords {
        &self.words().plan
    }

    /// The words of plans of daylight factors.
    pub const fn daylight_plan(self) -> PlanWords {
        PlanWords { values: self.words().daylight.factor, ..self.words().plan }
    }

    pub(crate) const fn words(self) -> &'static Words {
        match self {
            Self::English => &english::WORDS,
            Self::German => &german::WORDS,
        }
    }
}

/// A sentence with its places filled.
pub(crate) fn fill(pattern: &str, places: &[(&str, &str)]) -> String {
    places
        .iter()
        .fold(pattern.to_owned(), |text, (name, value)| text.replace(&format!("{{{name}}}"), value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::map::Figure;

    #[test]
    fn numbers_are_those_of_the_language() {
        let figure = Figure { value: 1.234, low: 1.21, high: 1.26 };
        assert_eq!(Language::English.words().figure(figure, 0.0), "1.23 (1.21 to 1.26)");
        assert_eq!(Language::German.words().figure(figure, 0.0), "1,23 (1,21 bis 1,26)");
        assert_eq!(Language::German.words().fixed(-0.0, 2), "0,00");
        assert_eq!(Language::English.words().figure(Figure::exact(0.4), 0.02), "0.40");
    }

    #[test]
    fn places_are_filled() {
        assert_eq!(fill("{a} of {b}", &[("a", "1"), ("b", "2")]), "1 of 2");
    }

    /// Every place of an English pattern is in the German one, too.
    #[test]
    fn languages_have_the_same_places() {
        let [english, german] = [Language::English, Language::German].map(|language| {
            let text = format!("{:?}", language.words());
            let mut places: Vec<String> = text
                .split('{')
                .skip(1)
                .filter_map(|rest| rest.split_once('}'))
                .map(|(name, _)| name.to_owned())
                .filter(|name| name.chars().all(|c| c.is_ascii_lowercase() || c == '_'))
                .collect();
            places.sort();
            places
        });
        assert!(english.len() > 10, "{english:?}");
        assert_eq!(english, german);
    }
}
