//! Ages films until a rating, a share or an age is reached.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::{
    film_survey::FilmSurvey,
    ratings::all::{Rating, Ratings},
    shares::{FilmShares, Share},
};
use crate::{settings::CoatingSettings, sim::FilmState, stain::Environment};

/// Age at which every search ends.
const MOST_AGE: f64 = 100.0;

/// Condition to which films are to be aged.
///
/// As text it is a [`Rating`] (`Ri3`, `D610-4`, `flaking 3`, `cracking 2(S3)`), a share (`gone=20%`, `rusted=0.05`; see
/// [`Share`] for all names) or an age (`age=0.7`).
///
/// ```
/// use bevy_coating::survey::{RustGrade, Share, Until};
///
/// assert_eq!("Ri3".parse(), Ok(Until::rating(RustGrade::Ri3)));
/// assert_eq!("gone = 20 %".parse(), Ok(Until::Share(Share::Gone, 0.2)));
/// assert_eq!(Until::Share(Share::Gone, 0.2).to_string(), "gone=20%");
/// let error = "awful".parse::<Until>().expect_err("no rating");
/// assert!(error.to_string().contains("Ri0 to Ri5"), "{error}");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Until {
    /// A rating is this bad or worse.
    Rating(Rating),
    /// A share is this large or larger: from 0 to 1.
    Share(Share, f64),
    /// The films are this old.
    Age(f64),
}

/// Error of text that says no condition.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{found:?} is nothing that films are aged to: write it as a rating (Ri0 to Ri5, D610-10 to D610-0, flaking 0 to \
     flaking 5, cracking 0 to cracking 5), a share (separated, gone, rusted, stained, dusty or wet, as in gone=20%) or \
     an age (age=0.7)"
)]
pub struct UntilError {
    /// The text.
    pub found: String,
}

impl Until {
    /// Returns the condition that a rating is this bad or worse.
    pub fn rating(rating: impl Into<Rating>) -> Self {
        Self::Rating(rating.into())
    }

    /// Returns whether films of this age and with these figures have come so far.
    ///
    /// ```
    /// use bevy_coating::survey::{FilmShares, Share, Until};
    ///
    /// let film = FilmShares { gone: 0.3, ..FilmShares::default() };
    /// assert!(Until::Share(Share::Gone, 0.2).is_reached(0.5, &film));
    /// assert!(!Until::Age(0.6).is_reached(0.5, &film));
    /// ```
    pub fn is_reached(&self, age: f64, shares: &FilmShares) -> bool {
        match *self {
            Self::Rating(rating) => rating.is_reached(&Ratings::from(shares)),
            Self::Share(share, least) => shares.of(share) >= least,
            // Whole steps may fall short of an age by rounding.
            Self::Age(least) => age >= least - 1e-8,
        }
    }
}

impl fmt::Display for Until {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rating(rating) => rating.fmt(f),
            Self::Share(share, least) => {
                // A share such as 0.07 is no whole percent in binary.
                let percent = (least * 1e8).round() / 1e6;
                write!(f, "{share}={percent}%")
            }
            Self::Age(age) => write!(f, "age={age}"),
        }
    }
}

impl FromStr for Until {
    type Err = UntilError;

    fn from_str(text: &str) -> Result<Self, UntilError> {
        let error = || UntilError { found: text.into() };
        let Some((name, value)) = text.split_once('=') else {
            return text.parse().map(Self::Rating).map_err(|_| error());
        };
        let (name, value) = (name.trim().to_ascii_lowercase(), value.trim());
        let (number, whole) = match value.strip_suffix('%') {
            Some(percent) => (percent.trim_end(), 100.0),
            None => (value, 1.0),
        };
        let number = number.parse::<f64>().map_err(|_| error())? / whole;
        let share = Share::ALL.into_iter().find(|share| share.name() == name);
        match share {
            Some(share) if (0.0..=1.0).contains(&number) => Ok(Self::Share(share, number)),
            None if name == "age" && whole == 1.0 && number.is_finite() && number >= 0.0 => Ok(Self::Age(number)),
            _ => Err(error()),
        }
    }
}

impl From<Until> for String {
    fn from(until: Until) -> Self {
        until.to_string()
    }
}

impl TryFrom<String> for Until {
    type Error = UntilError;

    fn try_from(text: String) -> Result<Self, UntilError> {
        text.parse()
    }
}

/// Watch over films that are aged until a condition is met, all of them together.
#[derive(Clone, Debug)]
pub struct UntilWatch {
    until: Until,
    surveys: Vec<FilmSurvey>,
}

impl UntilWatch {
    /// Returns a watch for `until`.
    pub fn new(until: Until) -> Self {
        Self { until, surveys: Vec::new() }
    }

    /// Returns whether the films together have come so far. Their age is that of the first. Films are told apart by
    /// their order, which has to stay.
    ///
    /// ```
    /// use bevy_coating::{
    ///     remesh::sample,
    ///     settings::CoatingSettings,
    ///     sim::FilmState,
    ///     survey::{Share, Until, UntilWatch},
    /// };
    ///
    /// let piece = sample::plate(100, 7)?;
    /// let film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 100).expect("a plate is a manifold");
    /// let mut watch = UntilWatch::new(Until::Share(Share::Gone, 0.1));
    /// assert!(!watch.is_reached(&[film]), "all paint is there");
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn is_reached(&mut self, films: &[FilmState]) -> bool {
        self.surveys.resize(films.len(), FilmSurvey::default());
        let mut all = FilmShares::default();
        // An age is met whatever the films look like.
        if !matches!(self.until, Until::Age(_)) {
            for (film, survey) in films.iter().zip(&mut self.surveys) {
                survey.look(film.view());
                all = all.merged(survey.shares());
            }
        }
        self.until.is_reached(films.first().map_or(0.0, |film| film.clock.age()), &all)
    }
}

impl FilmState {
    /// Takes steps until the film has come to `until`, and returns its age then. Returns `None` if it has not when it
    /// is `limit` old, where it stays. `limit` is 0 to 100; NaN counts as 0.
    ///
    /// The film is looked at now and at every hundredth of its age ([`TICKS_PER_AGE`](crate::stain::TICKS_PER_AGE)), at
    /// which stains advance; for an age, it takes exactly as many steps as that needs.
    ///
    /// ```
    /// use bevy_coating::{
    ///     remesh::sample,
    ///     settings::{CoatingSettings, Preset},
    ///     sim::FilmState,
    ///     stain::Environment,
    ///     survey::{RustGrade, Share, Until},
    /// };
    ///
    /// let (settings, environment) = (CoatingSettings::from(Preset::Heavy), Environment::default());
    /// let piece = sample::plate(400, 7)?;
    /// let mut film = FilmState::new(&piece.film, &settings, 7, 200).expect("a plate is a manifold");
    /// let age = film.age_until(&Until::Share(Share::Gone, 0.05), 10.0, &settings, &environment).expect("it flakes");
    /// assert_eq!(film.clock.age(), age);
    /// assert!((0.05..0.2).contains(&film.shares().gone));
    ///
    /// let rusty = film.age_until(&Until::rating(RustGrade::Ri3), 10.0, &settings, &environment).expect("it rusts");
    /// assert!(rusty >= age);
    /// assert_eq!(film.age_until(&Until::Age(9.0), rusty, &settings, &environment), None, "that is the limit");
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn age_until(
        &mut self,
        until: &Until,
        limit: f64,
        settings: &CoatingSettings,
        environment: &Environment,
    ) -> Option<f64> {
        let mut watch = UntilWatch::new(*until);
        let last = self.clock.step_at(limit.clamp(0.0, MOST_AGE));
        loop {
            if watch.is_reached(std::slice::from_ref(self)) {
                return Some(self.clock.age());
            }
            if self.clock.steps >= last {
                return None;
            }
            let next = match until {
                Until::Age(age) => self.clock.step_at(*age).max(self.clock.steps + 1),
                _ => self.clock.next_tick(),
            };
            while self.clock.steps < next.min(last) {
                self.step(settings, environment);
            }
        }
    }
}
