//! Rates cracking by ISO 4628-4.

use serde::{Deserialize, Serialize};

use super::{
    size::{size_class, typical_class},
    words::two_classes,
};
use crate::survey::shares::FilmShares;

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

impl From<&FilmShares> for CrackingGrade {
    fn from(shares: &FilmShares) -> Self {
        let visible: f64 = shares.crack_sizes[1..].iter().sum();
        Self { quantity: size_class(visible, &LIMITS), size: typical_class(&shares.crack_sizes) }
    }
}

two_classes!(CrackingGrade, "cracking");
