//! All vertices of the aged films as CSV, for plots and comparisons.

use std::fmt::Write;

use bevy_coating::{film::VertexId, sim::FilmState};
use bevy_math::Vec3;

use super::props::Prop;

/// One row a vertex, in the order of their ids. Several films share one id space: the ids of a film follow
/// those of the film before.
///
/// | column | |
/// |---|---|
/// | `id` | of the vertex |
/// | `original` | id of the vertex at rest that this one is, or is a duplicate of |
/// | `live` | 1 while a face is left at it, else 0 |
/// | `rest_x` to `rest_z` | position at rest, in scene space |
/// | `normal_x` to `normal_z` | unit normal at rest |
/// | `x` to `z` | position now, in scene space |
/// | `separated_age` | when it separated; empty while it is attached |
/// | `border` | 1 on the film's border at rest and for duplicates, else 0 |
/// | `mean_dihedral` | mean angle in radians, at rest, of the edges opposite to it (border edges left out); pi is flat, above is convex; empty without any |
pub fn dump_csv(props: &[Prop], films: &[FilmState]) -> String {
    let mut csv = String::from(
        "id,original,live,rest_x,rest_y,rest_z,normal_x,normal_y,normal_z,x,y,z,separated_age,border,mean_dihedral\n",
    );
    let mut base = 0u64;
    for (prop, film) in props.iter().zip(films) {
        let in_scene = |p: Vec3| (p.as_dvec3() + prop.origin.as_dvec3()).as_vec3();
        let (topology, geometry) = (&film.mesh.topology, &film.mesh.geometry);
        let dihedrals = mean_dihedrals(film);
        for v in topology.all_vertices() {
            let i = v.index();
            let (id, original) = (base + u64::from(v.0), topology.original(v));
            let live = u8::from(topology.has_faces(v));
            let border = u8::from(topology.is_border(v));
            // Writing to a string cannot fail.
            let _ = write!(csv, "{id},{},{live}", base + u64::from(original.0));
            let (rest, now) = (in_scene(geometry.rest_positions[i]), in_scene(geometry.positions[i]));
            for vector in [rest, geometry.rest_normals[i], now] {
                let _ = write!(csv, ",{},{},{}", vector.x, vector.y, vector.z);
            }
            let _ = match film.forces.separated_age[i] {
                age if age.is_finite() => write!(csv, ",{age},{border},"),
                _ => write!(csv, ",,{border},"),
            };
            let _ = match dihedrals[original.index()] {
                Some(angle) => writeln!(csv, "{angle}"),
                None => writeln!(csv),
            };
        }
        base += topology.vertex_count() as u64;
    }
    csv
}

/// For each original vertex the mean dihedral at rest of the inner edges opposite to it.
fn mean_dihedrals(film: &FilmState) -> Vec<Option<f32>> {
    let (topology, geometry) = (&film.mesh.topology, &film.mesh.geometry);
    let mut sums = vec![(0.0f64, 0u32); topology.original_vertex_count()];
    for h in topology.all_half_edges().filter(|&h| topology.rest_twin(h).is_some()) {
        let opposite: VertexId = topology.original(topology.apex(h));
        let (sum, edges) = &mut sums[opposite.index()];
        *sum += f64::from(geometry.rest_dihedrals[h.index()]);
        *edges += 1;
    }
    sums.into_iter().map(|(sum, edges)| (edges > 0).then(|| (sum / f64::from(edges)) as f32)).collect()
}
