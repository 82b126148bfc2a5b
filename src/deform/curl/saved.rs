//! Codes the distances from free edges for snapshots.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use bevy_math::Vec3;

use super::CurlField;
use crate::{
    coding::{Coder, Damage, Differences, Odds},
    film::{FilmMesh, Grain, Topology, VertexId},
};

/// Odds of the nearest free edges.
#[derive(Default)]
struct Lists {
    near: Odds,
    here: Odds,
    known: Odds,
    vertices: Differences,
    points: [Differences; 3],
    distances: Differences,
}

impl CurlField {
    /// Returns whether every vertex has a distance.
    pub fn covers(&self, topology: &Topology) -> bool {
        self.distances.len() == topology.vertex_count()
    }

    /// Codes the field of the film `mesh`, if it has one. `rest` is the same film at rest.
    ///
    /// # Errors
    /// [`Damage`] if a list that is read does not fit the film.
    pub fn code_state<C: Coder>(
        field: &mut Option<Box<Self>>,
        mesh: &FilmMesh,
        rest: &FilmMesh,
        coder: &mut C,
    ) -> Result<(), Damage> {
        let is_some = coder.plain(u32::from(field.is_some()), 1) != 0;
        if !is_some {
            *field = None;
            return Ok(());
        }
        let [mut length, mut reach] = field.as_ref().map_or([0.0; 2], |field| [field.grain.length, field.reach]);
        coder.plain_float(&mut length);
        coder.plain_float(&mut reach);
        if C::READS {
            // What is asked for is not known any more, only what it came to.
            let mut read = Self::new(rest, Grain { length }, 0.0);
            read.reach = reach;
            *field = Some(read);
        }
        let Some(field) = field else { return Ok(()) };
        let count =
            coder.length(field.distances.len(), mesh.topology.vertex_count(), "its distances from free edges")?;
        if C::READS {
            field.distances.resize(count, f32::INFINITY);
            field.nearest.resize(count, Vec3::ZERO);
        }
        field.code_nearest(mesh, rest, coder)
    }

    /// Codes the nearest point of a free edge of each vertex. Nearly all are vertices at rest.
    fn code_nearest<C: Coder>(&mut self, mesh: &FilmMesh, rest: &FilmMesh, coder: &mut C) -> Result<(), Damage> {
        let (topology, places) = (&mesh.topology, &rest.geometry.rest_positions);
        let bits = |p: Vec3| p.to_array().map(f32::to_bits);
        let mut known: Vec<([u32; 3], u32)> = Vec::new();
        if !C::READS {
            known.extend(places.iter().map(|&p| bits(p)).zip(0..));
            known.sort_unstable();
        }
        let vertex_at = |p: Vec3| {
            let found = known.get(known.partition_point(|&(at, _)| at < bits(p)));
            found.filter(|&&(at, _)| at == bits(p)).map(|&(_, i)| i)
        };
        let mut lists = Lists::default();
        let mut nearest_vertices: Vec<u32> = Vec::with_capacity(self.distances.len());
        for (i, (distance, nearest)) in self.distances.iter_mut().zip(&mut self.nearest).enumerate() {
            let v = VertexId::new(i);
            let far = distance.to_bits() == f32::INFINITY.to_bits() && bits(*nearest) == bits(Vec3::ZERO);
            if !coder.bit(&mut lists.near, !far) {
                (*distance, *nearest) = (f32::INFINITY, Vec3::ZERO);
                nearest_vertices.push(0);
                continue;
            }
            let own = topology.original(v).0;
            let at = |vertex: u32| places.get(vertex as usize).copied().ok_or(Damage("a free edge"));
            let is_here = *distance == 0.0 && bits(*nearest) == bits(at(own)?);
            if coder.bit(&mut lists.here, is_here) {
                (*distance, *nearest) = (0.0, at(own)?);
                nearest_vertices.push(own);
                continue;
            }
            let found = vertex_at(*nearest);
            if coder.bit(&mut lists.known, found.is_some()) {
                // Neighbours mostly have the same.
                let before = topology.fan(v).find_map(|h| nearest_vertices.get(topology.target(h).index()));
                let expected = before.copied().unwrap_or(own);
                let mut vertex = found.unwrap_or_default();
                coder.word(&mut lists.vertices, &mut vertex, expected);
                *nearest = at(vertex)?;
                nearest_vertices.push(vertex);
            } else {
                nearest_vertices.push(0);
                coder.vector(&mut lists.points, nearest, Vec3::ZERO);
            }
            let expected = (at(own)? - *nearest).length_squared().sqrt();
            coder.float(&mut lists.distances, distance, expected);
        }
        Ok(())
    }
}
