//! Holds all ratings of a film, and any one of them.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::{
    astm_rust::AstmRust, cracking::CrackingGrade, error::RatingError, flaking::FlakingGrade, rust_grade::RustGrade,
};
use crate::survey::shares::FilmShares;

/// All ratings of a film.
///
/// ```
/// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState, survey::Ratings};
///
/// let piece = sample::plate(100, 7)?;
/// let film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 100).expect("a plate is a manifold");
/// let fresh = Ratings::from(&film.shares());
/// assert_eq!(fresh, Ratings::default());
/// assert_eq!(fresh.to_string(), "Ri0, D610-10, flaking 0, cracking 0");
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "plugin", derive(bevy::reflect::Reflect), reflect(Debug, Clone, PartialEq))]
pub struct Ratings {
    /// Degree of rusting by ISO 4628-3.
    pub rust: RustGrade,
    /// Rust grade by ASTM D610.
    pub astm: AstmRust,
    /// Degree of flaking by ISO 4628-5.
    pub flaking: FlakingGrade,
    /// Degree of cracking by ISO 4628-4.
    pub cracking: CrackingGrade,
}

impl Ratings {
    /// Returns the ratings that are worse than `before`, by the degree of rust or the quantity of flakes or cracks.
    ///
    /// ```
    /// use bevy_coating::survey::{FilmShares, Rating, Ratings, RustGrade};
    ///
    /// let now = Ratings { rust: RustGrade::Ri2, ..Ratings::default() };
    /// assert_eq!(now.worse_than(&Ratings::default()).collect::<Vec<_>>(), [Rating::Rust(RustGrade::Ri2)]);
    /// ```
    pub fn worse_than(self, before: &Self) -> impl Iterator<Item = Rating> + use<> {
        let worse = [
            (self.rust > before.rust).then_some(Rating::Rust(self.rust)),
            (self.astm > before.astm).then_some(Rating::Astm(self.astm)),
            (self.flaking.quantity() > before.flaking.quantity()).then_some(Rating::Flaking(self.flaking)),
            (self.cracking.quantity() > before.cracking.quantity()).then_some(Rating::Cracking(self.cracking)),
        ];
        worse.into_iter().flatten()
    }

    /// Returns the worse of both in each rating.
    pub fn worst(self, other: Self) -> Self {
        Self {
            rust: self.rust.max(other.rust),
            astm: self.astm.max(other.astm),
            flaking: self.flaking.max(other.flaking),
            cracking: self.cracking.max(other.cracking),
        }
    }
}

impl From<&FilmShares> for Ratings {
    fn from(shares: &FilmShares) -> Self {
        Self { rust: shares.into(), astm: shares.into(), flaking: shares.into(), cracking: shares.into() }
    }
}

impl fmt::Display for Ratings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rust, astm, flaking, cracking } = self;
        write!(f, "{rust}, {astm}, {flaking}, {cracking}")
    }
}

/// Any one rating.
///
/// ```
/// use bevy_coating::survey::{FlakingGrade, Rating, RustGrade};
///
/// assert_eq!("Ri3".parse(), Ok(Rating::Rust(RustGrade::Ri3)));
/// let flaking: Rating = "flaking 3".parse()?;
/// assert_eq!(flaking, Rating::Flaking(FlakingGrade::new(3, 0).expect("two classes")));
/// # Ok::<(), bevy_coating::survey::RatingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
#[cfg_attr(feature = "plugin", derive(bevy::reflect::Reflect), reflect(Debug, Clone, PartialEq))]
pub enum Rating {
    /// Degree of rusting by ISO 4628-3.
    Rust(RustGrade),
    /// Rust grade by ASTM D610.
    Astm(AstmRust),
    /// Degree of flaking by ISO 4628-5.
    Flaking(FlakingGrade),
    /// Degree of cracking by ISO 4628-4.
    Cracking(CrackingGrade),
}

impl Rating {
    /// Returns whether a film with these ratings has come to this one: it is as bad or worse, where there are two
    /// classes in both.
    ///
    /// ```
    /// use bevy_coating::survey::{Rating, Ratings, RustGrade};
    ///
    /// let film = Ratings { rust: RustGrade::Ri3, ..Ratings::default() };
    /// assert!(Rating::Rust(RustGrade::Ri2).is_reached(&film));
    /// assert!(!Rating::Rust(RustGrade::Ri4).is_reached(&film));
    /// ```
    pub fn is_reached(self, by: &Ratings) -> bool {
        match self {
            Self::Rust(grade) => by.rust >= grade,
            Self::Astm(grade) => by.astm >= grade,
            Self::Flaking(grade) => by.flaking.quantity() >= grade.quantity() && by.flaking.size() >= grade.size(),
            Self::Cracking(grade) => by.cracking.quantity() >= grade.quantity() && by.cracking.size() >= grade.size(),
        }
    }

    /// Returns the rating of the same kind among those of a film.
    pub fn same_of(self, of: &Ratings) -> Self {
        match self {
            Self::Rust(_) => Self::Rust(of.rust),
            Self::Astm(_) => Self::Astm(of.astm),
            Self::Flaking(_) => Self::Flaking(of.flaking),
            Self::Cracking(_) => Self::Cracking(of.cracking),
        }
    }
}

impl From<RustGrade> for Rating {
    fn from(grade: RustGrade) -> Self {
        Self::Rust(grade)
    }
}

impl From<AstmRust> for Rating {
    fn from(grade: AstmRust) -> Self {
        Self::Astm(grade)
    }
}

impl From<FlakingGrade> for Rating {
    fn from(grade: FlakingGrade) -> Self {
        Self::Flaking(grade)
    }
}

impl From<CrackingGrade> for Rating {
    fn from(grade: CrackingGrade) -> Self {
        Self::Cracking(grade)
    }
}

impl From<Rating> for String {
    fn from(rating: Rating) -> Self {
        rating.to_string()
    }
}

impl TryFrom<String> for Rating {
    type Error = RatingError;

    fn try_from(text: String) -> Result<Self, RatingError> {
        text.parse()
    }
}

impl fmt::Display for Rating {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rust(grade) => grade.fmt(f),
            Self::Astm(grade) => grade.fmt(f),
            Self::Flaking(grade) => grade.fmt(f),
            Self::Cracking(grade) => grade.fmt(f),
        }
    }
}

impl FromStr for Rating {
    type Err = RatingError;

    fn from_str(text: &str) -> Result<Self, RatingError> {
        // A bare 3(S4) could be either of two.
        let is_named = text.trim().starts_with(|first: char| first.is_ascii_alphabetic());
        let named = |found: Option<Self>| found.filter(|_| is_named);
        let rust = text.parse().ok().map(Self::Rust);
        let found = rust
            .or_else(|| text.parse().ok().map(Self::Astm))
            .or_else(|| named(text.parse().ok().map(Self::Flaking)))
            .or_else(|| named(text.parse().ok().map(Self::Cracking)));
        let expected = "Ri0 to Ri5, D610-10 to D610-0, flaking 0 to flaking 5 or cracking 0 to cracking 5";
        found.ok_or_else(|| RatingError { found: text.into(), expected })
    }
}
