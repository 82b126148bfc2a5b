//! Rates flaking by ISO 4628-5.

use serde::{Deserialize, Serialize};

use super::{
    size::{size_class, typical_class},
    words::two_classes,
};
use crate::survey::shares::FilmShares;

/// Shares of flaked area up to which the quantities 0 to 4 go.
const LIMITS: [f64; 5] = [0.0, 0.001, 0.003, 0.01, 0.03];

/// Degree of flaking by ISO 4628-5: how much of the coating is gone, and how large the bare places are.
///
/// | class | 0 | 1 | 2 | 3 | 4 | 5 |
/// |---|---|---|---|---|---|---|
/// | quantity: flaked area, up to % | 0 | 0.1 | 0.3 | 1 | 3 | 15 and more |
/// | size: largest extent, up to mm | | 1 | 3 | 10 | 30 | more |
///
/// An area between two quantities gets the worse one. The size is that of the largest places that are typical: a tenth
/// of the flaked area is in places of this class or above. The size 0 in a wish ([`Until`](crate::survey::Until))
/// stands for any. The depth is always that of the whole coating, to the metal ("b" in the standard).
///
/// ```
/// use bevy_coating::survey::{FilmShares, FlakingGrade};
///
/// let film = FilmShares { gone: 0.02, gone_sizes: [0.0, 0.0, 0.0, 0.001, 0.019, 0.0], ..FilmShares::default() };
/// let grade = FlakingGrade::from(&film);
/// assert_eq!((grade.quantity(), grade.size(), grade.to_string().as_str()), (4, 4, "flaking 4(S4)"));
/// assert_eq!("flaking 4(S4)".parse(), Ok(grade));
/// assert_eq!("flaking 4".parse::<FlakingGrade>().ok(), FlakingGrade::new(4, 0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
#[cfg_attr(feature = "plugin", derive(bevy::reflect::Reflect), reflect(Debug, Clone, PartialEq))]
pub struct FlakingGrade {
    quantity: u8,
    size: u8,
}

impl From<&FilmShares> for FlakingGrade {
    fn from(shares: &FilmShares) -> Self {
        Self { quantity: size_class(shares.gone, &LIMITS), size: typical_class(&shares.gone_sizes) }
    }
}

two_classes!(FlakingGrade, "flaking");
