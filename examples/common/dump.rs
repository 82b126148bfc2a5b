//! All vertices of the aged films as CSV, for plots and comparisons.

use std::fmt::Write;

use bevy_coating::{
    film::VertexId,
    sim::FilmState,
    stain::{RustSource, StainLayer},
};
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
/// | `rust_wet`, `rust_stained` | rust on the film that runs off, and that has stained it for good: layers |
/// | `source` | 1 while rust comes out at it, else 0 |
/// | `past_source` | 1 if rust has ever come out at it, also now, else 0 |
/// | `dust`, `moisture` | on the film: 0 to 1 |
/// | `area` | film that it stands for: a third of each of its faces at rest, in square metres; 0 once it has none |
/// | `metal_wet`, `metal_stained` | rust that came to lie on the metal below: layers; this and all that follows is empty for duplicates, which have no metal of their own |
/// | `metal_dust`, `metal_moisture` | on the metal: 0 to 1 |
/// | `metal_area` | metal that can be stained: what no film covers, in square metres |
/// | `corrosion` | how far the metal itself has rusted: 0 bright to 1 rusted through |
pub fn dump_csv(props: &[Prop], films: &[FilmState]) -> String {
    let mut csv = String::from(
        "id,original,live,rest_x,rest_y,rest_z,normal_x,normal_y,normal_z,x,y,z,separated_age,border,mean_dihedral,\
         rust_wet,rust_stained,source,past_source,dust,moisture,area,\
         metal_wet,metal_stained,metal_dust,metal_moisture,metal_area,corrosion\n",
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
            if let Some(angle) = dihedrals[original.index()] {
                let _ = write!(csv, "{angle}");
            }
            write_stains(&mut csv, film, v);
        }
        base += topology.vertex_count() as u64;
    }
    csv
}

/// The columns of stains, and the end of the row.
fn write_stains(csv: &mut String, film: &FilmState, v: VertexId) {
    let (stains, i) = (&film.stains, v.index());
    let source = stains.sources.get(i).copied().unwrap_or_default();
    let (present, ever) = (u8::from(source == RustSource::Present), u8::from(source != RustSource::Never));
    let StainLayer { wet, stained, dust, moisture, areas } = &stains.film;
    let _ = write!(csv, ",{},{},{present},{ever},{},{},{}", wet[i], stained[i], dust[i], moisture[i], areas[i]);
    // Metal has one entry an original vertex.
    let StainLayer { wet, stained, dust, moisture, areas } = &stains.metal;
    let _ = match stains.corrosion.get(i) {
        Some(corrosion) => {
            writeln!(csv, ",{},{},{},{},{},{corrosion}", wet[i], stained[i], dust[i], moisture[i], areas[i])
        }
        None => writeln!(csv, ",,,,,,"),
    };
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
