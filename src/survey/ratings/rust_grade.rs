//! Rates rust by ISO 4628-3.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::{error::RatingError, size::size_class};
use crate::survey::shares::FilmShares;

/// Share of rusted area up to which there is none to be seen: a thousandth of a percent.
const UNSEEN: f64 = 1e-5;
/// Shares of rusted area up to which the degrees 0 to 4 go.
const LIMITS: [f64; 5] = [UNSEEN, 0.0005, 0.005, 0.01, 0.08];

/// Degree of rusting by ISO 4628-3: the rusted share of the surface.
///
/// The standard compares with pictures, of which it names the rusted areas: 0, 0.05, 0.5, 1, 8 and 40 to 50 %. Here an
/// area between two of them gets the worse degree, and up to 0.001 % counts as none. Only metal that has rusted counts,
/// on bare places and in cracks; stains of run-off rust do not.
///
/// ```
/// use bevy_coating::survey::{FilmShares, RustGrade};
///
/// let film = FilmShares { rusted: 0.007, ..FilmShares::default() };
/// assert_eq!(RustGrade::from(&film), RustGrade::Ri3);
/// assert_eq!("ri3".parse(), Ok(RustGrade::Ri3));
/// assert_eq!(RustGrade::Ri3.to_string(), "Ri3");
/// assert!("Ri7".parse::<RustGrade>().is_err());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "plugin", derive(bevy::reflect::Reflect), reflect(Debug, Clone, PartialEq))]
pub enum RustGrade {
    /// No rust.
    #[default]
    Ri0,
    /// Up to 0.05 % rusted.
    Ri1,
    /// Up to 0.5 % rusted.
    Ri2,
    /// Up to 1 % rusted.
    Ri3,
    /// Up to 8 % rusted.
    Ri4,
    /// More than 8 % rusted.
    Ri5,
}

impl RustGrade {
    /// All degrees, from the best to the worst.
    pub const ALL: [Self; 6] = [Self::Ri0, Self::Ri1, Self::Ri2, Self::Ri3, Self::Ri4, Self::Ri5];

    /// Returns the number of the degree: 0 (best) to 5 (worst).
    pub fn number(self) -> u8 {
        self as u8
    }
}

impl From<&FilmShares> for RustGrade {
    fn from(shares: &FilmShares) -> Self {
        Self::ALL.get(size_class(shares.rusted, &LIMITS) as usize).copied().unwrap_or(Self::Ri5)
    }
}

impl fmt::Display for RustGrade {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Ri{}", self.number())
    }
}

impl FromStr for RustGrade {
    type Err = RatingError;

    fn from_str(text: &str) -> Result<Self, RatingError> {
        let trimmed = text.trim();
        let number = trimmed.get(..2).filter(|begin| begin.eq_ignore_ascii_case("ri")).and_then(|_| trimmed.get(2..));
        let found = number.and_then(|number| number.trim().parse::<usize>().ok());
        found
            .and_then(|number| Self::ALL.get(number).copied())
            .ok_or_else(|| RatingError { found: text.into(), expected: "Ri0 to Ri5" })
    }
}
