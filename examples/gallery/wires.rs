//! Lines of two meshes over each other (VC fig. 18): of the film that is simulated, and of what is drawn of it.

use crate::measure::figure::Panel;
use bevy::asset::RenderAssetUsages;
use bevy::light::NotShadowCaster;
use bevy::mesh::PrimitiveTopology;
use bevy::prelude::*;
use bevy_coating::appearance::{Detail, FilmAppearance};
use bevy_coating::remesh::build_film;
use bevy_coating::sim::FilmState;
use std::collections::BTreeSet;

/// Draws the lines of a film that is shown at `place`.
pub fn draw(
    commands: &mut Commands,
    meshes: &mut Assets<Mesh>,
    materials: &mut Assets<StandardMaterial>,
    (panel, place, film): (&Panel, Transform, &FilmState),
) {
    let topology = &film.mesh.topology;
    let corners = topology.live_faces().map(|f| topology.corners(f).map(|v| v.0));
    let coarse = lines(corners, |v| film.mesh.geometry.positions[v as usize]);
    let exhibit = &panel.exhibit;
    let fine = exhibit.shape.surface(exhibit.seed).ok().and_then(|surface| {
        let built = build_film(&surface, exhibit.shape.target(), exhibit.seed).ok()?;
        let detail = Detail { level: panel.level, ..Detail::default() };
        let (mesh, forces, stains) = (&film.mesh, &film.forces, &film.stains);
        let shown = FilmAppearance::with_detail(&built, &surface, mesh, forces, stains, detail).ok()?;
        let front = shown.front(0)?;
        Some(lines(front.triangles(), |v| Vec3::from(front.positions[v as usize])))
    });
    // Towards the camera, so that they lie over the paint, and the coarse ones over the fine ones.
    let all = [
        (fine.unwrap_or_default(), Color::srgb(0.30, 0.30, 0.32), 0.002),
        (coarse, Color::srgb(0.0, 0.55, 0.1), 0.004),
    ];
    for (lines, color, ahead) in all {
        let mesh = Mesh::new(PrimitiveTopology::LineList, RenderAssetUsages::default())
            .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, lines);
        let ink = materials.add(StandardMaterial { base_color: color, unlit: true, ..default() });
        let place = place * Transform::from_xyz(0.0, 0.0, ahead);
        commands.spawn((Mesh3d(meshes.add(mesh)), MeshMaterial3d(ink), place, NotShadowCaster));
    }
}

/// Returns the ends of the edges of triangles, each edge once.
fn lines(triangles: impl Iterator<Item = [u32; 3]>, place: impl Fn(u32) -> Vec3) -> Vec<Vec3> {
    let edges: BTreeSet<[u32; 2]> =
        triangles.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.into_iter().flatten().map(place).collect()
}
