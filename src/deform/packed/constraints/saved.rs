//! Codes the packed solver for snapshots.

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

use super::PackedConstraints;
use crate::{
    coding::{Coder, Damage},
    deform::{
        ledger::Ledger,
        pace::Narrowing,
        packed::region::{Region, saved::Targets},
    },
    film::{FilmMesh, Topology},
};

impl PackedConstraints {
    /// Codes the points. To read, begin with those of a fresh film.
    ///
    /// # Errors
    /// [`Damage`] if the points that are read do not fit the film.
    pub fn code_points<C: Coder>(
        &mut self,
        topology: &Topology,
        positions: &[Vec3],
        is_attached: impl Fn(usize) -> bool,
        coder: &mut C,
    ) -> Result<(), Damage> {
        self.outdated = coder.plain(u32::from(self.outdated), 1) != 0;
        self.points.code_state(topology, positions, is_attached, coder)
    }

    /// Codes the number of packs of lengths and of bends of each region.
    ///
    /// # Errors
    /// [`Damage`] if a film of that mesh never has so many.
    pub fn code_pack_counts<C: Coder>(&mut self, mesh: &FilmMesh, coder: &mut C) -> Result<Vec<[usize; 2]>, Damage> {
        let topology = &mesh.topology;
        let mut corners = vec![0usize; topology.original_vertex_count()];
        for h in topology.all_half_edges() {
            let original = topology.original(topology.origin(h));
            *corners.get_mut(original.index()).ok_or(Damage("a corner"))? += 1;
        }
        // A pack is begun where neighbours leave no room in others: all constraints at a vertex are neighbours.
        let most = topology.half_edge_count() / 8 + 16 * corners.into_iter().max().unwrap_or_default() + 128;
        let mut counts: Vec<[usize; 2]> = self.regions.iter().map(Region::packs).collect();
        for count in counts.as_flattened_mut() {
            *count = coder.length(*count, most, "the number of its packs")?;
        }
        Ok(counts)
    }

    /// Codes the packs, of which all but the targets of bends follows from the ledger. `packs` are their numbers, and
    /// `by` is how targets narrow.
    ///
    /// # Errors
    /// [`Damage`] if the lanes of the ledger do not fit the packs.
    pub fn code_packs<C: Coder>(
        &mut self,
        mesh: &FilmMesh,
        ledger: &Ledger,
        packs: &[[usize; 2]],
        by: Narrowing,
        coder: &mut C,
    ) -> Result<(), Damage> {
        if C::READS {
            self.regions = packs.iter().map(|&packs| Region::of_packs(packs)).collect();
            self.fill_packs(mesh, ledger)?;
        }
        let mut odds = Targets::default();
        self.regions.iter_mut().for_each(|region| region.code_targets(by, &mut odds, coder));
        Ok(())
    }

    /// Puts all constraints into the lanes that the ledger says.
    fn fill_packs(&mut self, mesh: &FilmMesh, ledger: &Ledger) -> Result<(), Damage> {
        let topology = &mesh.topology;
        for h in topology.all_half_edges() {
            let index = self.region_index(topology, h);
            let length = ledger.lengths().lane(h).map(|lane| (lane, self.length_lane(mesh, h)));
            let bend = ledger.bends().lane(h).map(|lane| (lane, self.bend_lane(ledger, mesh, h)));
            let region = self.regions.get_mut(index).ok_or(Damage("a region"))?;
            if let Some((lane, length)) = length {
                region.give_length(h.0, lane, &length, &self.points)?;
            }
            if let Some((lane, bend)) = bend {
                region.give_bend(h.0, lane, &bend, &self.points)?;
            }
        }
        Ok(())
    }
}
