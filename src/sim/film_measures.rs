//! Defines the figures that are measured on films.

use serde::{Deserialize, Serialize};

/// Figures of one film, or of several together, at one age.
///
/// Shares are relative to the film at rest and lie between 0 and 1. A figure is `None` if there is nothing to average.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FilmMeasures {
    /// Age of the film, or of the first of several.
    pub age: f64,
    /// Share of the original vertices that have separated.
    pub separated: Option<f64>,
    /// Share of the edges between two faces at rest that have torn.
    pub torn: Option<f64>,
    /// Share of the faces that were stripped so far: removed because all their edges had torn (VC 5.3).
    pub stripped: Option<f64>,
    /// Share of the faces that fell so far, as loose pieces.
    pub fallen: Option<f64>,
    /// Number of vertices that have faces, duplicates included.
    pub vertices: u64,
    /// Number of crack tips.
    pub crack_tips: u64,
    /// Number of original inner vertices with three or more torn edges.
    pub junctions: u64,
    /// Mean cosine of the angle by which cracks turn, over the original inner vertices with exactly two torn edges, at
    /// rest: 1 is straight, -1 would be a turn back.
    pub straightness: Option<f64>,
    /// Total rest length of all torn edges divided by the square root of the rest area.
    pub crack_length: Option<f64>,
    /// Mean distance between cracks along random straight lines on the surface, in units of the film's space: the rest
    /// area times pi, divided by twice the length of all torn edges (the Cauchy-Crofton formula). `None` before the
    /// first crack.
    pub crack_spacing: Option<f64>,
    /// Number of connected pieces: live faces joined across bound edges.
    pub pieces: u64,
    /// Number of connected pieces without an attached vertex.
    pub loose_pieces: u64,
    /// Root mean square of the length strain |l - l0| / l0 over all length constraints; l0 is the rest length.
    pub strain_rms: Option<f64>,
    /// Largest length strain |l - l0| / l0 of any length constraint.
    pub strain_max: Option<f64>,
    /// 90th percentile (nearest rank) of the lift of separated vertices that have faces: the height over the plane of
    /// their rest position, in mean rest edges. The coarser a film is, the larger a share of its vertices lies at torn
    /// edges, which lift most: use the percentiles by area to compare films.
    pub lift_p90: Option<f64>,
    /// Median by area of the lift of the film that has separated and is left, in metres: at least half of its area is
    /// lifted by no more. Each vertex stands for a third of the rest area of its faces, at its height over the plane of
    /// its rest position.
    pub lift_area_p50_m: Option<f64>,
    /// 90th percentile by area of the same lift, in metres.
    pub lift_area_p90_m: Option<f64>,
    /// 99th percentile by area of the same lift, in metres.
    pub lift_area_p99_m: Option<f64>,
    /// Rust that sources have given off so far, in layers times square metres. It is the sum of the wet, the stained
    /// and the dripped rust.
    pub rust_emitted: f64,
    /// Wet rust on film and metal, which is running off, in layers times square metres.
    pub rust_wet: f64,
    /// Rust that has stained film and metal for good, in layers times square metres.
    pub rust_stained: f64,
    /// Rust that has left the prop, in layers times square metres: it dripped off, or it fell with the pieces that it
    /// was on.
    pub rust_dripped: f64,
    /// Number of film vertices at which rust comes out.
    pub sources: u64,
    /// Mean dust of the film vertices that have faces: from 0 (clean) to 1 (black).
    pub dust_mean: Option<f64>,
    /// Mean moisture of the film vertices that have faces: from 0 (dry) to 1 (wet).
    pub moisture_mean: Option<f64>,
}
