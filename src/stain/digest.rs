//! Writes what stains keep for themselves as words, for digests.

use super::fields::StainFields;
use crate::film::words::Words;

impl StainFields {
    /// Appends what decides later stains beyond the fields that anybody can see: open metal, duplicates, drains, ways
    /// of run-off and rates of dust.
    pub(crate) fn write_state(&self, to: &mut Words) {
        // The fields that anybody can see are covered by their names, and display changes nothing.
        let Self {
            film: _,
            metal: _,
            corrosion: _,
            sources: _,
            budget: _,
            exposure: _,
            streaks: _,
            revision: _,
            shown: _,
            places: _,
            openness,
            open,
            duplicates,
            catchments,
            flow,
            dust_rates,
            damp,
        } = self;
        to.floats(openness);
        to.list(open.iter().copied());
        duplicates.write_state(to);
        catchments.write_state(to);
        flow.write_state(to);
        dust_rates.write_state(to);
        to.word(u32::from(*damp));
    }
}

#[cfg(test)]
mod tests {
    use bevy_math::Vec3;

    use super::*;
    use crate::film::{FilmMesh, VertexId, words::assert_each_counts};

    #[test]
    fn every_inner_field_of_stains_counts() {
        let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]]).unwrap();
        let changes: [fn(&mut StainFields); 7] = [
            |stains| stains.openness[0] = 0.5,
            |stains| stains.open.push(1),
            |stains| stains.duplicates.append(VertexId(0)),
            |stains| stains.catchments.connect(VertexId(0), VertexId(1), 1.0),
            |stains| stains.flow.pull = Vec3::X,
            |stains| {
                let dust = crate::settings::DustSettings::default();
                super::super::settle_dust(
                    &FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]]).unwrap(),
                    stains,
                    &dust,
                    &super::super::Environment::default(),
                    0.01,
                );
            },
            |stains| stains.damp = true,
        ];
        assert_each_counts(&StainFields::new(&mesh), StainFields::write_state, &changes);
    }
}
