//! Draws where the rim of a touch lies on a film.

use bevy_math::Vec3;

use super::{
    reach::{Reach, originals_of},
    site::Site,
};
use crate::film::FilmMesh;

/// Returns the rim of a touch of this `radius` (metres) at `site`, as segments that lie on the film as it is now, and
/// on the metal where film is gone. It is empty if the film has no such face.
///
/// ```
/// use bevy_coating::{film::FaceId, remesh::sample, settings::CoatingSettings, sim::FilmState, touch::{Site, outline}};
/// use bevy_math::Vec3;
///
/// let piece = sample::plate(1_000, 7)?;
/// let film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 100).expect("a plate is a manifold");
/// let site = Site::new(FaceId(500), Vec3::ONE);
/// let at = site.position(&film.mesh).expect("the face is there");
/// let rim = outline(&film.mesh, site, 0.1);
/// assert!(rim.len() > 8);
/// assert!(rim.iter().flatten().all(|p| (p.distance(at) - 0.1).abs() < 0.01));
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
pub fn outline(mesh: &FilmMesh, site: Site, radius: f32) -> Vec<[Vec3; 2]> {
    let topology = &mesh.topology;
    if site.face.index() >= topology.face_count() {
        return Vec::new();
    }
    // Far enough for the outer corners of faces that the rim crosses.
    let reach = Reach::new(mesh, site, radius + 4.0 * mesh.geometry.mean_edge);
    let mut segments = Vec::new();
    for &f in &reach.faces {
        let originals = originals_of(topology, f);
        let places = if topology.is_live(f) {
            topology.corners(f).map(|v| mesh.geometry.positions[v.index()])
        } else {
            originals.map(|v| mesh.geometry.rest_positions[v.index()])
        };
        let distances = originals.map(|v| reach.distances[v.index()]);
        let mut ends = (0..3).filter_map(|i| {
            let j = (i + 1) % 3;
            let (from, to) = (distances[i], distances[j]);
            let crosses = (from < radius) != (to < radius) && from.max(to) < f32::INFINITY;
            crosses.then(|| places[i].lerp(places[j], (radius - from) / (to - from)))
        });
        if let (Some(a), Some(b)) = (ends.next(), ends.next()) {
            segments.push([a, b]);
        }
    }
    segments
}
