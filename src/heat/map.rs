//! Defines the heat maps.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::*;

use super::range::HeatRange;

/// Quantity that a heat map shows on a film.
///
/// Where something happens next, the map is bright: there a margin has run out, or the age until an event is short.
///
/// ```
/// use bevy_coating::heat::HeatMap;
///
/// for map in HeatMap::ALL {
///     println!("{} ({}): {}", map.name(), map.unit(), map.meaning());
/// }
/// assert_eq!("strain".parse(), Ok(HeatMap::Strain));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(
    feature = "plugin",
    derive(Reflect),
    reflect(Default, Debug, Clone, PartialEq, Hash),
    type_path = "bevy_coating::heat"
)]
pub enum HeatMap {
    /// Adhesion minus bending force at each vertex that is still attached, as a force: 0 or less is about to come off
    /// (VC fig. 16).
    #[default]
    Adhesion,
    /// Binding minus pull at the weakest bound edge of each face, as a force: at 0 or less it tears as soon as it has
    /// come off the metal (VC 5.2).
    Binding,
    /// Age until each vertex that is still attached separates, if nothing tears around it and its moisture stays.
    Separation,
    /// Largest strain of a face's edges: the difference between their length now and at rest, as a share of the latter.
    Strain,
    /// Connected pieces: faces that are joined across bound edges. The value is the number of the lowest face.
    Pieces,
    /// Sources of rust: 1 where rust comes out, 0.5 where it came out once, 0 elsewhere.
    Sources,
    /// Share of the rain that reaches each vertex: 0 is sheltered, 1 exposed.
    Rain,
}

/// Reason why a text names no heat map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no heat map `{name}`; there are {}", HeatMap::ALL.map(HeatMap::name).join(", "))]
pub struct UnknownHeatMap {
    /// Name that was given.
    pub name: String,
}

impl HeatMap {
    /// Every map, in the order in which they are listed.
    pub const ALL: [Self; 7] =
        [Self::Adhesion, Self::Binding, Self::Separation, Self::Strain, Self::Pieces, Self::Sources, Self::Rain];

    /// Returns the name of the map: one word in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Adhesion => "adhesion",
            Self::Binding => "binding",
            Self::Separation => "separation",
            Self::Strain => "strain",
            Self::Pieces => "pieces",
            Self::Sources => "sources",
            Self::Rain => "rain",
        }
    }

    /// Returns what the map shows, in a few words.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Adhesion => "adhesion minus bending force: bright comes off next",
            Self::Binding => "binding minus pull at the weakest edge: bright cracks next",
            Self::Separation => "age until the film lets go of the metal",
            Self::Strain => "how far edges are stretched or squeezed",
            Self::Pieces => "connected pieces of the film",
            Self::Sources => "where rust comes out, or came out",
            Self::Rain => "share of the rain that arrives",
        }
    }

    /// Returns the unit of the map's values; empty if they are numbers without one.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Adhesion | Self::Binding => "force",
            Self::Separation => "age",
            Self::Strain | Self::Pieces | Self::Sources | Self::Rain => "",
        }
    }

    /// Returns the range over which the colours are spread unless another is asked for. It suits the default settings,
    /// and is the same at any age, so that pictures of different ages can be compared.
    pub const fn range(self) -> HeatRange {
        let max = match self {
            Self::Adhesion => 2.0,
            Self::Binding => 4.0,
            Self::Strain => 0.1,
            Self::Separation | Self::Pieces | Self::Sources | Self::Rain => 1.0,
        };
        HeatRange { min: 0.0, max }
    }

    /// Returns whether low values are the bright ones.
    pub const fn is_reversed(self) -> bool {
        matches!(self, Self::Adhesion | Self::Binding | Self::Separation)
    }

    /// Returns whether values are names of kinds rather than amounts.
    pub const fn is_of_kinds(self) -> bool {
        matches!(self, Self::Pieces)
    }
}

impl core::fmt::Display for HeatMap {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.name())
    }
}

impl core::str::FromStr for HeatMap {
    type Err = UnknownHeatMap;

    /// Returns the map with this [name](HeatMap::name).
    ///
    /// # Errors
    /// [`UnknownHeatMap`], which lists all names.
    fn from_str(name: &str) -> Result<Self, UnknownHeatMap> {
        let found = Self::ALL.into_iter().find(|map| map.name() == name);
        found.ok_or_else(|| UnknownHeatMap { name: name.to_owned() })
    }
}
