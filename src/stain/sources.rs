//! Decides where rust comes out: the four rules at each tear (VC 6.1, fig. 9).

use bevy_math::Vec3;

use super::{
    fields::{RustSource, StainFields},
    slope::is_steep,
};
use crate::film::{FilmMesh, TearEnd};

/// Judges both ends of a tear at the moment of tearing (VC 6.1, rules 1 to 4), and lets the torn edge drain to its
/// lower end.
///
/// - A crack end that lies below the other end becomes a source, if `gravity` pulls along the surface there.
/// - A crack end that lies above is no source.
/// - A vertex that lies below and is no crack end stays what it is.
/// - A vertex that lies above and is no crack end is no source.
///
/// Ends of equal height both count as above. Duplicates are never sources. `length` is that of the torn edge, in
/// metres.
pub(super) fn judge(stains: &mut StainFields, mesh: &FilmMesh, ends: [TearEnd; 2], gravity: Vec3, length: f32) {
    let vertex = |end: TearEnd| match end {
        TearEnd::Opened(v) | TearEnd::Split { kept: v, .. } => v,
    };
    let original = |i: usize| mesh.topology.original(vertex(ends[i]));
    let depths = [0, 1].map(|i| mesh.geometry.rest_positions[original(i).index()].dot(gravity));
    for (i, end) in ends.into_iter().enumerate() {
        let below = depths[i] > depths[1 - i];
        let source = &mut stains.sources[vertex(end).index()];
        match (end, below) {
            (TearEnd::Opened(v), true) if is_steep(mesh, v, gravity) => *source = RustSource::Present,
            (TearEnd::Split { .. }, true) => {}
            _ => end_source(source),
        }
    }
    stains.catchments.drain(mesh, [original(0), original(1)], gravity, length);
}

/// Ends a source, which becomes a past one. A vertex that was never a source stays so.
pub(super) fn end_source(source: &mut RustSource) {
    if *source == RustSource::Present {
        *source = RustSource::Past;
    }
}
