//! Writes the state of the forces as words, for digests.

use super::forces::FilmForces;
use crate::film::words::Words;

impl FilmForces {
    /// Appends all that decides what becomes of the forces.
    pub(crate) fn write_state(&self, to: &mut Words) {
        // Every field is named, so that none is forgotten. Loose pieces and bend weights follow from the film at rest
        // and its cracks, and no result depends on predictions.
        let Self {
            separated_age,
            tips,
            loose: _,
            torn_edges,
            separations,
            drawn,
            adhesion_drawn,
            adhesion_by_hand,
            adhesion_lost_wet,
            adhesion_share,
            rebound,
            adhesion_lost,
            contractions,
            contraction_spared,
            contraction_gained,
            bindings,
            binding_decay,
            bend_weights: _,
            gamma,
            loose_since,
            necks,
            predictions: _,
        } = self;
        to.floats(separated_age);
        to.vectors(tips);
        to.word(*torn_edges);
        to.word(*separations);
        to.list(drawn.numbers());
        to.floats(adhesion_drawn);
        to.flags(adhesion_by_hand);
        to.floats(adhesion_lost_wet);
        to.double(*adhesion_lost);
        to.list(contractions.iter().flat_map(|c| [c.base, c.share, c.drawn].map(f32::to_bits)));
        to.double(*contraction_gained);
        to.list(bindings.iter().flat_map(|binding| binding.numbers()));
        to.double(*binding_decay);
        to.float(*gamma);
        if !loose_since.is_empty() {
            to.floats(loose_since);
        }
        if !contraction_spared.is_empty() {
            to.floats(contraction_spared);
        }
        if !adhesion_share.is_empty() {
            to.floats(adhesion_share);
        }
        if !rebound.is_empty() {
            to.flags(rebound);
        }
        if !necks.is_empty() {
            to.list(necks.iter().flat_map(|neck| [neck.at.0, neck.held_by[0].0, neck.held_by[1].0]));
        }
    }
}

#[cfg(test)]
mod tests {
    use bevy_math::Vec3;

    use super::*;
    use crate::{
        film::{FilmMesh, Geometry, Grain, HalfEdgeId, VertexId, tests::grid, words::assert_each_counts},
        fracture::{
            drawn::{Contraction, Drawn},
            forces::Neck,
        },
        settings::CoatingSettings,
    };

    #[test]
    fn every_field_of_forces_counts() {
        let (positions, triangles) = grid(2, 2);
        let mesh = FilmMesh::new(positions, &triangles).unwrap();
        let forces = FilmForces::new(&mesh, &CoatingSettings::default(), 3);
        let changes: [fn(&mut FilmForces); 27] = [
            |forces| forces.separated_age[1] = 0.5,
            |forces| forces.tips[1] = Vec3::X,
            |forces| forces.torn_edges = 1,
            |forces| forces.separations = 1,
            |forces| forces.drawn.seed = 4,
            |forces| forces.drawn.contraction = 0.5,
            |forces| {
                let mut settings = CoatingSettings::default();
                settings.adhesion.frequency = 2.0;
                forces.drawn = Drawn::new(3, &Geometry::default(), &settings);
            },
            |forces| {
                let mut settings = CoatingSettings::default();
                settings.tearing.weak_factor = 0.5;
                forces.drawn = Drawn::new(3, &Geometry::default(), &settings);
            },
            |forces| forces.adhesion_drawn[0] = 0.5,
            |forces| forces.adhesion_by_hand[0] = true,
            |forces| forces.adhesion_lost_wet[0] = 0.5,
            |forces| forces.adhesion_share = vec![0.5; 9],
            |forces| forces.rebound = vec![false; 9],
            |forces| forces.contraction_spared = vec![0.5; 8],
            |forces| forces.adhesion_lost = 0.5,
            |forces| forces.contractions[0] = Contraction { base: 0.5, ..forces.contractions[0] },
            |forces| forces.contractions[0] = Contraction { share: 0.5, ..forces.contractions[0] },
            |forces| forces.contractions[0] = Contraction { drawn: 0.5, ..forces.contractions[0] },
            |forces| forces.contraction_gained = 0.5,
            |forces| forces.bindings[0].redraw(0.5),
            |forces| forces.bindings[0].set_torn_faces(1, 0.5),
            |forces| forces.bindings[0].set_force(HalfEdgeId(0).index() as f32, 0.0),
            |forces| forces.binding_decay = 0.5,
            |forces| forces.gamma = 0.5,
            |forces| forces.drawn.grain = Some(Grain { length: 0.5 }),
            |forces| forces.loose_since = vec![0.5],
            |forces| forces.necks = vec![Neck { at: VertexId(0), held_by: [VertexId(1); 2] }],
        ];
        assert_each_counts(&forces, FilmForces::write_state, &changes);
    }
}
