//! Defines the figures of a whole film by area.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Figures of a film by area at rest, or of several films together.
///
/// The areas that are [attached](Self::attached), [separated](Self::separated) and [gone](Self::gone) make up the
/// whole. Stains count by how strongly they show: a place that is half covered counts half. Faces that are left out of
/// a [view](super::FilmView) do not count at all.
///
/// ```
/// use bevy_coating::{
///     remesh::sample,
///     settings::{CoatingSettings, Preset},
///     sim::FilmState,
///     stain::Environment,
/// };
///
/// let settings = CoatingSettings::from(Preset::Heavy);
/// let piece = sample::plate(400, 7)?;
/// let mut film = FilmState::new(&piece.film, &settings, 7, 100).expect("a plate is a manifold");
/// assert_eq!(film.shares().attached, 1.0);
/// film.age_to(1.0, &settings, &Environment::default());
/// let old = film.shares();
/// assert!((old.attached + old.separated + old.gone - 1.0).abs() < 1e-6);
/// assert!(old.rusted > 0.0 && old.rusted <= old.gone + 0.05, "metal rusts where it is bare, and in cracks");
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "plugin", derive(bevy::reflect::Reflect), reflect(Debug, Clone, PartialEq))]
pub struct FilmShares {
    /// Area of the whole, in square metres.
    pub area: f64,
    /// Share of the area with film that holds on, from 0 to 1.
    pub attached: f64,
    /// Share with film that has come off the metal but is still there, from 0 to 1.
    pub separated: f64,
    /// Share without film, from 0 to 1.
    pub gone: f64,
    /// Share of rusted metal, from 0 to 1: on bare places and in cracks that gape, not under film.
    pub rusted: f64,
    /// Share that run-off rust covers, on film and bare metal, from 0 to 1.
    pub stained: f64,
    /// Mean dust and soot of film and bare metal, from 0 (clean) to 1 (black).
    pub dusty: f64,
    /// Mean moisture of film and bare metal, from 0 (dry) to 1 (wet).
    pub wet: f64,
    /// Length of all cracks per area, in metres per square metre. Cracks are torn edges with film on both sides.
    pub crack_density: f64,
    /// Number of cracks: torn edges that hang together.
    pub cracks: u32,
    /// Part of [`crack_density`](Self::crack_density) in each size class of ISO 4628-4, by how wide cracks gape now: up
    /// to 0.01, 0.1, 0.2, 0.5 and 1 mm, and more.
    pub crack_sizes: [f64; 6],
    /// Part of [`gone`](Self::gone) in each size class of ISO 4628-5, by the extent of the bare places: none in class
    /// 0, then up to 1, 3, 10 and 30 mm, and more.
    pub gone_sizes: [f64; 6],
}

impl FilmShares {
    /// Returns the figures of both films together.
    ///
    /// ```
    /// use bevy_coating::survey::FilmShares;
    ///
    /// let new = FilmShares { area: 1.0, attached: 1.0, ..FilmShares::default() };
    /// let old = FilmShares { area: 3.0, gone: 1.0, cracks: 4, ..FilmShares::default() };
    /// let both = new.merged(&old);
    /// assert_eq!((both.area, both.attached, both.gone, both.cracks), (4.0, 0.25, 0.75, 4));
    /// ```
    pub fn merged(&self, other: &Self) -> Self {
        let area = self.area + other.area;
        let mean = |of: fn(&Self) -> f64| share(of(self) * self.area + of(other) * other.area, area);
        let all = |of: fn(&Self) -> &[f64; 6]| {
            let (mine, others) = (of(self), of(other));
            std::array::from_fn(|i| share(mine[i] * self.area + others[i] * other.area, area))
        };
        Self {
            area,
            attached: mean(|s| s.attached),
            separated: mean(|s| s.separated),
            gone: mean(|s| s.gone),
            rusted: mean(|s| s.rusted),
            stained: mean(|s| s.stained),
            dusty: mean(|s| s.dusty),
            wet: mean(|s| s.wet),
            crack_density: mean(|s| s.crack_density),
            cracks: self.cracks.saturating_add(other.cracks),
            crack_sizes: all(|s| &s.crack_sizes),
            gone_sizes: all(|s| &s.gone_sizes),
        }
    }

    /// Returns one of the shares, from 0 to 1.
    pub fn of(&self, share: Share) -> f64 {
        match share {
            Share::Separated => self.separated,
            Share::Gone => self.gone,
            Share::Rusted => self.rusted,
            Share::Stained => self.stained,
            Share::Dusty => self.dusty,
            Share::Wet => self.wet,
        }
    }
}

/// Name of one of the [shares](FilmShares) of a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Share {
    /// [`FilmShares::separated`].
    Separated,
    /// [`FilmShares::gone`].
    Gone,
    /// [`FilmShares::rusted`].
    Rusted,
    /// [`FilmShares::stained`].
    Stained,
    /// [`FilmShares::dusty`].
    Dusty,
    /// [`FilmShares::wet`].
    Wet,
}

impl Share {
    /// All shares.
    pub const ALL: [Self; 6] = [Self::Separated, Self::Gone, Self::Rusted, Self::Stained, Self::Dusty, Self::Wet];

    /// Returns the name of the share: that of its field in [`FilmShares`].
    pub fn name(self) -> &'static str {
        match self {
            Self::Separated => "separated",
            Self::Gone => "gone",
            Self::Rusted => "rusted",
            Self::Stained => "stained",
            Self::Dusty => "dusty",
            Self::Wet => "wet",
        }
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Returns `part / whole`; 0 of nothing.
pub(super) fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
