//! Tells which vertices and triangles of a part changed.

use std::ops::Range;

/// Vertices and triangles of a [`MeshPart`](super::MeshPart) that the last
/// [`update`](super::FilmAppearance::update) changed, so that a copy of the part can be brought up to date without
/// being made again.
///
/// ```
/// use bevy_coating::{
///     appearance::{DisplayChanges, FilmAppearance}, remesh::sample, settings::CoatingSettings, sim::FilmState,
///     stain::Environment,
/// };
///
/// let (piece, settings) = (sample::plate(200, 1)?, CoatingSettings::default());
/// let mut film = FilmState::new(&piece.film, &settings, 0, 100).ok_or("an empty film")?;
/// let mut shown = FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
/// assert!(shown.front_changes(0).is_some_and(|changes| changes.whole), "it is new");
///
/// let mut copy = shown.front(0).ok_or("no slot")?.positions.clone();
/// let mut changes = DisplayChanges::default();
/// for _ in 0..60 {
///     film.step(&settings, &Environment::default());
///     changes.record(&film.changes, &film.stains);
///     shown.update(&film.mesh, &film.forces, &film.stains, changes.take());
///     let (front, changed) = (shown.front(0).ok_or("no slot")?, shown.front_changes(0).ok_or("no slot")?);
///     copy.resize(front.positions.len(), [0.0; 3]);
///     for range in changed.moved.ranges() {
///         copy[range.clone()].copy_from_slice(&front.positions[range]);
///     }
///     assert_eq!(copy, front.positions);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PartChanges {
    /// Whether the part was made again, so that the lists say nothing.
    pub whole: bool,
    /// Vertices that are new, or stand for another place of the film: all of their attributes may be others.
    pub renewed: IndexRanges,
    /// Vertices with another position, normal or tangent; also those that are new.
    pub moved: IndexRanges,
    /// Vertices with other stains; also those that are new.
    pub stained: IndexRanges,
    /// Entries of [`MeshPart::indices`](super::MeshPart::indices) that changed.
    pub indices: IndexRanges,
}

impl PartChanges {
    /// Begins with no changes, or with all.
    pub(super) fn begin(&mut self, whole: bool) {
        self.whole = whole;
        self.renewed.clear();
        self.moved.clear();
        self.stained.clear();
        self.indices.clear();
    }

    /// Forgets the lists, and their memory, if they say nothing.
    pub(super) fn finish(&mut self) {
        if self.whole {
            *self = Self { whole: true, ..Self::default() };
        }
    }

    /// Returns whether nothing changed.
    pub fn is_empty(&self) -> bool {
        self.stained.is_empty() && self.is_stained_only()
    }

    /// Returns whether nothing but stains changed.
    pub fn is_stained_only(&self) -> bool {
        !self.whole && [&self.renewed, &self.moved, &self.indices].iter().all(|list| list.is_empty())
    }
}

/// Indices as a list of ranges, in the order in which they were added. Ranges may overlap.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct IndexRanges(Vec<Range<u32>>);

impl IndexRanges {
    /// Returns the ranges.
    pub fn ranges(&self) -> impl ExactSizeIterator<Item = Range<usize>> + '_ {
        self.0.iter().map(|range| range.start as usize..range.end as usize)
    }

    /// Returns whether there is no index.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Removes all.
    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds `i`.
    #[inline]
    pub(crate) fn push(&mut self, i: usize) {
        self.add(i..i + 1);
    }

    /// Adds a range.
    #[inline]
    pub(crate) fn add(&mut self, range: Range<usize>) {
        if range.is_empty() {
            return;
        }
        let range = range.start as u32..range.end as u32;
        match self.0.last_mut() {
            Some(last) if last.end == range.start => last.end = range.end,
            _ => self.0.push(range),
        }
    }
}
