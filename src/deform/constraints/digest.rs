//! Writes the state of the constraints as words, for digests.

use super::FilmConstraints;
use crate::{film::words::Words, settings::DeformSettings};

impl FilmConstraints {
    /// Appends all that decides what becomes of the constraints: which there are, their targets, their order in packs,
    /// the momentum of points, and who sleeps.
    pub(crate) fn write_state(&self, to: &mut Words) {
        // What the plain solver keeps follows from the rest.
        let Self { ledger, packed, plain: _, sleep, settings, curl } = self;
        ledger.write_state(to);
        packed.write_state(to);
        sleep.write_state(to);
        to.list(settings.iter().flat_map(|(settings, quality)| {
            let DeformSettings { narrowing_rate, bend_limit, curl_reach: _, sweeps_per_age } = settings;
            [narrowing_rate.to_bits(), bend_limit.to_bits(), sweeps_per_age.to_bits(), *quality as u32]
        }));
        if let Some(curl) = curl {
            curl.write_state(to);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        deform::SolverQuality,
        film::{FilmMesh, HalfEdgeId, VertexId, tests::grid, words::assert_each_counts},
    };

    #[test]
    fn every_field_of_constraints_counts() {
        let (positions, triangles) = grid(2, 2);
        let mesh = FilmMesh::new(positions, &triangles).unwrap();
        let with = |narrowing_rate, quality| Some((DeformSettings { narrowing_rate, ..Default::default() }, quality));
        let constraints = FilmConstraints { settings: with(0.7, SolverQuality::High), ..FilmConstraints::new(&mesh) };
        let changes: [fn(&mut FilmConstraints); 6] = [
            |constraints| constraints.ledger.add_length(HalfEdgeId(0)),
            |constraints| constraints.free(VertexId(0)),
            |constraints| constraints.packed.mark_outdated(),
            |constraints| constraints.sleep.append(VertexId(0)),
            |constraints| constraints.settings.as_mut().unwrap().0.narrowing_rate = 0.5,
            |constraints| constraints.settings.as_mut().unwrap().1 = SolverQuality::Fast,
        ];
        assert_each_counts(&constraints, FilmConstraints::write_state, &changes);
    }
}
