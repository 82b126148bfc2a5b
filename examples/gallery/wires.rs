//! Lines over films: of the mesh that is simulated and of what is drawn of it (VC fig. 18), and of cracks that do not
//! open.

use crate::measure::exhibit::Beginning;
use crate::measure::figure::Panel;
use bevy::asset::RenderAssetUsages;
use bevy::light::NotShadowCaster;
use bevy::mesh::PrimitiveTopology;
use bevy::prelude::*;
use bevy_coating::appearance::{Detail, FilmAppearance};
use bevy_coating::film::{HalfEdgeId, VertexId};
use bevy_coating::remesh::build_film;
use bevy_coating::sim::FilmState;
use bevy_coating::stain::RustSource;
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

/// Half the width of a line along a crack, and the size of the mark of a source, in metres.
const HALF_WIDTH: f32 = 0.003;
const MARK: f32 = 0.012;

/// Draws the cracks of a flat film that do not open, as ribbons; and a mark at the source of rust of a lone crack.
pub fn draw_cracks(
    commands: &mut Commands,
    meshes: &mut Assets<Mesh>,
    materials: &mut Assets<StandardMaterial>,
    (panel, place, film): (&Panel, Transform, &FilmState),
) {
    let (topology, rest) = (&film.mesh.topology, &film.mesh.geometry.rest_positions);
    let is_seen = |h: HalfEdgeId| {
        let twin = topology.rest_twin(h).filter(|_| topology.is_torn(h));
        twin.is_some_and(|twin| topology.is_live(h.face()) || topology.is_live(twin.face()))
    };
    let mut ribbons = Vec::new();
    for h in topology.all_edges().filter(|&h| is_seen(h)) {
        let [a, b] = [topology.origin(h), topology.target(h)].map(|v| rest[v.index()]);
        let along = HALF_WIDTH * (b - a).normalize_or_zero();
        let aside = Vec3::Z.cross(along);
        // Longer by half their width, so that they meet.
        ribbons.extend(quad([a - along - aside, b + along - aside, b + along + aside, a - along + aside]));
    }
    let is_source = |v: &VertexId| film.stains.sources[v.index()] == RustSource::Present;
    let marks = topology.all_vertices().filter(is_source).flat_map(|v| {
        let corners = [Vec3::NEG_X, Vec3::NEG_Y, Vec3::X, Vec3::Y];
        quad(corners.map(|corner| rest[v.index()] + MARK * corner))
    });
    let is_lone = matches!(panel.exhibit.beginning, Beginning::Cracked(_));
    let marks: Vec<Vec3> = marks.filter(|_| is_lone).collect();
    for (triangles, color, ahead) in
        [(ribbons, Color::srgb(0.08, 0.09, 0.10), 0.002), (marks, Color::srgb(0.75, 0.10, 0.05), 0.003)]
    {
        let mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
            .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, vec![Vec3::Z; triangles.len()])
            .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, triangles);
        let ink = materials.add(StandardMaterial { base_color: color, unlit: true, ..default() });
        let place = place * Transform::from_xyz(0.0, 0.0, ahead);
        commands.spawn((Mesh3d(meshes.add(mesh)), MeshMaterial3d(ink), place, NotShadowCaster));
    }
}

/// The two triangles of four corners.
fn quad([a, b, c, d]: [Vec3; 4]) -> [Vec3; 6] {
    [a, b, c, a, c, d]
}
