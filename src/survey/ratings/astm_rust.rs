//! Rates rust by ASTM D610.

use std::{cmp::Ordering, fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::{error::RatingError, size::size_class};
use crate::survey::shares::FilmShares;

/// Grade of a surface without rust.
const BEST: u8 = 10;
/// Shares of rusted area up to which the grades 10 to 1 go.
const LIMITS: [f64; 10] = [0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.16, 0.33, 0.5];

/// Rust grade by ASTM D610 (table 1): 10 is the best, 0 the worst.
///
/// | grade | 10 | 9 | 8 | 7 | 6 | 5 | 4 | 3 | 2 | 1 | 0 |
/// |---|---|---|---|---|---|---|---|---|---|---|---|
/// | rusted, up to % | 0.01 | 0.03 | 0.1 | 0.3 | 1 | 3 | 10 | 16 | 33 | 50 | 100 |
///
/// Stains of rust are not rust (section 4.2.1): only metal that has rusted counts, on bare places and in cracks. The
/// letter for how the rust is spread (S, G, P, H) is left out. A *worse* grade is the greater one in comparisons.
///
/// ```
/// use bevy_coating::survey::{AstmRust, FilmShares};
///
/// let film = FilmShares { rusted: 0.007, ..FilmShares::default() };
/// assert_eq!(AstmRust::from(&film).grade(), 6);
/// let good = AstmRust::new(9).expect("a grade");
/// assert!(AstmRust::from(&film) > good, "worse");
/// assert_eq!((good.to_string().as_str(), "D610-9".parse()), ("D610-9", Ok(good)));
/// assert_eq!(AstmRust::new(11), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
#[cfg_attr(feature = "plugin", derive(bevy::reflect::Reflect), reflect(Debug, Clone, PartialEq))]
pub struct AstmRust(u8);

impl AstmRust {
    /// Returns a grade, which is 0 (worst) to 10 (best), or `None` for other numbers.
    pub fn new(grade: u8) -> Option<Self> {
        (grade <= BEST).then_some(Self(grade))
    }

    /// Returns the grade: 0 (worst) to 10 (best).
    pub fn grade(self) -> u8 {
        self.0
    }
}

impl Default for AstmRust {
    /// Returns the best grade, 10.
    fn default() -> Self {
        Self(BEST)
    }
}

impl Ord for AstmRust {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.cmp(&self.0)
    }
}

impl PartialOrd for AstmRust {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl From<&FilmShares> for AstmRust {
    fn from(shares: &FilmShares) -> Self {
        Self(BEST - size_class(shares.rusted, &LIMITS))
    }
}

impl From<AstmRust> for String {
    fn from(grade: AstmRust) -> Self {
        grade.to_string()
    }
}

impl TryFrom<String> for AstmRust {
    type Error = RatingError;

    fn try_from(text: String) -> Result<Self, RatingError> {
        text.parse()
    }
}

impl fmt::Display for AstmRust {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "D610-{}", self.0)
    }
}

impl FromStr for AstmRust {
    type Err = RatingError;

    fn from_str(text: &str) -> Result<Self, RatingError> {
        let lower = text.trim().to_ascii_lowercase();
        let number = lower.strip_prefix("d610").or_else(|| lower.strip_prefix("astm"));
        let number = number.map(|number| number.trim_start_matches(['-', ' ']));
        let found = number.and_then(|number| number.parse().ok()).and_then(Self::new);
        found.ok_or_else(|| RatingError { found: text.into(), expected: "D610-0 to D610-10" })
    }
}
