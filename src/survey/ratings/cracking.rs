//! Rates cracking by ISO 4628-4.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::{
    error::RatingError,
    size::{size_class, typical_class},
    words::{self, MOST},
};
use crate::survey::shares::FilmShares;

/// Word before the classes.
const NAME: &str = "cracking";
/// Lengths of visible cracks in metres per square metre up to which the quantities 0 to 4 go.
const LIMITS: [f64; 5] = [0.0, 0.3, 1.0, 3.0, 10.0];

/// Degree of cracking by ISO 4628-4: how many cracks there are, and how wide they gape.
///
/// | class | 0 | 1 | 2 | 3 | 4 | 5 |
/// |---|---|---|---|---|---|---|
/// | quantity in the standard | none | very few | few | moderate | considerable | dense |
/// | here: length of cracks, up to m/m2 | 0 | 0.3 | 1 | 3 | 10 | more |
/// | size in the standard | invisible | under magnification | just visible | clearly visible | up to 1 mm | wider |
/// | here: width of cracks, up to mm | 0.01 | 0.1 | 0.2 | 0.5 | 1 | more |
///
/// The standard rates the quantity by pictures and says no lengths, and widths only for the last two sizes. The lengths
/// here rise about threefold from class to class, as the areas of ISO 4628-5 do: parallel cracks are 3.3 m, 1 m, 0.33 m
/// and 0.1 m apart at the limits. An eye sees 0.1 mm, and 0.01 mm under tenfold magnification. Cracks of size 0 count
/// for nothing. The size is the largest that is typical: a tenth of the length is of this class or above. The size 0 in
/// a wish ([`Until`](crate::survey::Until)) stands for any.
///
/// ```
/// use bevy_coating::survey::{CrackingGrade, FilmShares};
///
/// let crack_sizes = [0.5, 0.0, 0.0, 1.5, 0.0, 0.0];
/// let film = FilmShares { crack_density: 2.0, crack_sizes, ..FilmShares::default() };
/// let grade = CrackingGrade::from(&film);
/// assert_eq!((grade.quantity(), grade.size(), grade.to_string().as_str()), (3, 3, "cracking 3(S3)"));
/// assert_eq!("cracking 3(S3)".parse(), Ok(grade));
/// assert_eq!(CrackingGrade::new(6, 0), None);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
#[cfg_attr(feature = "plugin", derive(bevy::reflect::Reflect), reflect(Debug, Clone, PartialEq))]
pub struct CrackingGrade {
    quantity: u8,
    size: u8,
}

impl CrackingGrade {
    /// Returns a degree of two classes, each 0 (best) to 5 (worst), or `None` for other numbers.
    pub fn new(quantity: u8, size: u8) -> Option<Self> {
        (quantity <= MOST && size <= MOST).then_some(Self { quantity, size })
    }

    /// Returns the class of the quantity: 0 (best) to 5 (worst).
    pub fn quantity(self) -> u8 {
        self.quantity
    }

    /// Returns the class of the size: 0 (best) to 5 (worst).
    pub fn size(self) -> u8 {
        self.size
    }
}

impl From<&FilmShares> for CrackingGrade {
    fn from(shares: &FilmShares) -> Self {
        let visible: f64 = shares.crack_sizes[1..].iter().sum();
        Self { quantity: size_class(visible, &LIMITS), size: typical_class(&shares.crack_sizes) }
    }
}

impl From<CrackingGrade> for String {
    fn from(grade: CrackingGrade) -> Self {
        grade.to_string()
    }
}

impl TryFrom<String> for CrackingGrade {
    type Error = RatingError;

    fn try_from(text: String) -> Result<Self, RatingError> {
        text.parse()
    }
}

impl fmt::Display for CrackingGrade {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        words::write(f, NAME, self.quantity, self.size)
    }
}

impl FromStr for CrackingGrade {
    type Err = RatingError;

    fn from_str(text: &str) -> Result<Self, RatingError> {
        let found = words::read(text, NAME).map(|(quantity, size)| Self { quantity, size });
        found.ok_or_else(|| RatingError { found: text.into(), expected: "cracking 0 to cracking 5, or cracking 3(S4)" })
    }
}
