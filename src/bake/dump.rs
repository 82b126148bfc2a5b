//! Lists all vertices of the aged films as CSV, for plots and comparisons.

use std::fmt::Write;

use bevy_math::Vec3;

use super::coat::Prop;
use crate::{
    film::VertexId,
    sim::FilmState,
    stain::{RustSource, StainLayer},
};

/// Writes the table that is documented at [`Baked::csv`](super::baked::Baked::csv).
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
